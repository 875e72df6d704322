#include "core/contour/gcode/words/words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/contour/gcode/words/characters.hpp"
#include "core/contour/gcode/words/codes.hpp"

namespace bahnwerk::gcode {
namespace {

std::string shown(char c) {
  if (c > ' ' && c < 127) return std::string("'") + c + "'";
  char text[16];
  std::snprintf(text, sizeof text, "byte 0x%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
  return text;
}

/// Returns the meaning of a character that begins no word, if it is known.
std::string strange(char c, char next) {
  switch (c) {
    case '=':
      return "= stands only behind a parameter";
    case '[':
    case ']':
      return "an expression stands behind a letter, as its value";
    case ')':
      return "a comment ends that did not begin";
    case '/':
      return "/ may stand only at the begin of a line";
    case '?':
    case '!':
    case '~':
    case '{':
      return std::string("a command of the controller (") + c + "), not of the program";
    case '@':
    case '^':
      return "polar coordinates (@, ^) are not supported";
    case ',':
      if (part_of_number(next)) return "a number has a point, no comma";
      return "chamfers and roundings (,C ,R) are not supported";
    case '*':
      return "a checksum (*), as printers are sent, is no word of a part program";
    case '"':
      return "a text in quotes is no word of a part program";
    default:
      return "unexpected " + shown(c);
  }
}

}  // namespace

Lines::Lines(std::string_view text, Parameters* parameters)
    : at_(text.data()), end_(text.data() + text.size()), parameters_(parameters) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;  // byte order mark
}

void Lines::skip_blanks() {
  while (at_ != end_ && blank(*at_)) ++at_;
}

void Lines::skip_line() {
  while (at_ != end_ && !end_of_line(*at_)) ++at_;
}

bool Lines::next(Line& line, bool skip_slash) {
  if (at_ == end_) return false;
  line.number = ++number_;
  line_end_ = nullptr;
  line.letters_ = 0;
  line.g_count = line.m_count = 0;
  line.slash = line.percent = line.bare = line.text = false;
  line.behind_m6 = line.foreign = 0;
  line.has_foreign = false;
  line.controller.clear();
  line.flow = Flow::none;
  line.fault.clear();
  skip_blanks();
  if (at_ != end_ && *at_ == '%') {
    line.percent = true;
    skip_line();
  } else if (at_ != end_ && *at_ == '$') {
    const char* first = at_;
    skip_line();
    line.controller.assign(first, at_);
  } else if (at_ != end_ && *at_ == '/') {
    line.slash = true;
    ++at_;
    skip_blanks();
    if (at_ != end_ && *at_ >= '1' && *at_ <= '9') ++at_;  // /2: one of several switches
    if (skip_slash) skip_line();
  }
  words(line);
  if (line.foreign != 0) give_up_foreign(line);
  if (!assigned_.empty()) {
    for (const auto& [to, value] : assigned_)
      if (to.name.empty())
        parameters_->set(to.number, value);
      else if (!parameters_->set(to.name, value))
        line.fault = "more than 10000 names of parameters at a time";
    assigned_.clear();
  }
  skip_line();
  line.end = at_;
  end_line();
  return true;
}

void Lines::end_line() {
  skip_line();
  if (at_ != end_ && *at_++ == '\r' && at_ != end_ && *at_ == '\n') ++at_;
}

void Lines::words(Line& line) {
  for (;;) {
    skip_blanks();
    if (at_ == end_ || end_of_line(*at_)) return;
    const char c = *at_;
    if (c == ';') return;
    if (c == '(') {
      if (!comment(line)) return;
      continue;
    }
    if (c == '#') {
      ++at_;
      if (!assignment(line)) return;
      continue;
    }
    if (c == '$') {
      if (!selector(line)) return;
      continue;
    }
    if (line.has_foreign) {
      if (!foreign_word(line)) return;
      continue;
    }
    const char letter = c == ':' ? 'O' : capital(c);
    if (letter < 'A' || letter > 'Z') {
      line.fault = c == '_' ? no_word(at_) : strange(c, at_ + 1 == end_ ? '\n' : at_[1]);
      return;
    }
    ++at_;
    if (letter == 'O' && !line.has('O') && line.g_count + line.m_count == 0) {
      if (!label(line)) return;
    } else if (!word(line, letter)) {
      return;
    }
  }
}

bool Lines::comment(Line& line) {
  bool inner = false;
  while (++at_ != end_ && !end_of_line(*at_)) {
    inner = inner || *at_ == '(';
    if (*at_ == ')') {
      ++at_;
      if (!inner) return true;
      // What follows decides: (a (b) is one comment.
      const char* next = std::find_if(at_, end_, [](char c) { return c == '(' || c == ')' || end_of_line(c); });
      if (next == end_ || *next != ')') return true;
      line.fault = "a comment stands within a comment: RS274NGC ends both at the first )";
      return false;
    }
  }
  line.fault = "the comment does not end";
  return false;
}

bool Lines::word(Line& line, char letter) {
  double value = 0;
  if (!number(line, letter, value)) return false;
  if (letter == 'G' || letter == 'M') return code(line, letter, value);
  if (letter == 'O' && line.bare) return true;  // G28 O of printers
  if (line.has(letter)) {
    line.fault = std::string("the letter ") + letter + " stands twice";
    return false;
  }
  const std::uint32_t bit = 1U << (letter - 'A');
  line.letters_ |= bit;
  line.values_[static_cast<std::size_t>(letter - 'A')] = value;
  const auto codes = [&](auto holds) {
    return std::any_of(line.m.begin(), line.m.begin() + static_cast<std::ptrdiff_t>(line.m_count), holds);
  };
  if (codes([](int m) { return m == 6; })) line.behind_m6 |= bit;
  if (letter == 'E' && !codes([](int m) { return m >= 66 && m <= 68; })) printer_ = true;
  return true;
}

/// Reads a G or M code after its number. M words with a decimal are only printers'.
bool Lines::code(Line& line, char letter, double value) {
  const bool m = letter == 'M';
  const double scaled = 10 * value, tenfold = std::round(scaled);
  const bool sound = value >= 0 && value < 10'000 && std::abs(scaled - tenfold) < 1e-6;
  const int number = sound ? static_cast<int>(tenfold) : 0;
  // M73.2 of a printer reports its progress.
  const bool known = m && known_m(number / 10) && (number % 10 == 0 || number / 10 != 73);
  if (!sound || (known && number % 10 != 0)) {
    line.fault = std::string("there is no such ") + letter + " word";
    return false;
  }
  auto& list = m ? line.m : line.g;
  auto& count = m ? line.m_count : line.g_count;
  if (count == Line::max_codes) {
    line.fault = std::string("too many ") + letter + " words";
    return false;
  }
  list[count++] = !m ? number : number % 10 != 0 ? -number : number / 10;
  if (!m || known) return true;
  line.has_foreign = true;
  printer_ = printer_ || printer_m(number / 10);
  return number != 1170 && number != 1180;  // a printer's message: text follows
}

}  // namespace bahnwerk::gcode
