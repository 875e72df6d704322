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

/// What a character that begins no word stands for, if that is known.
std::string strange(char c) {
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
    default:
      return "unexpected " + shown(c);
  }
}

/// Statements of Fanuc's macros, by their first letter and what follows it.
bool macro_word(char first, const char* at, const char* end) {
  for (const std::string_view word : {"IF", "GOTO", "WHILE", "END", "THEN", "DO"}) {
    if (word[0] != first) continue;
    std::size_t i = 1;
    while (i < word.size() && at != end && capital(*at) == word[i]) ++i, ++at;
    if (i == word.size()) return true;
  }
  return false;
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
  line.slash = line.percent = line.bare = false;
  line.flow = Flow::none;
  line.fault.clear();
  skip_blanks();
  if (at_ != end_ && *at_ == '%') {
    line.percent = true;
    skip_line();
  } else if (at_ != end_ && *at_ == '/') {
    line.slash = true;
    ++at_;
    skip_blanks();
    if (at_ != end_ && *at_ >= '1' && *at_ <= '9') ++at_;  // /2: one of several switches
    if (skip_slash) skip_line();
  }
  words(line);
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
    const char letter = c == ':' ? 'O' : capital(c);
    if (letter < 'A' || letter > 'Z') {
      line.fault = strange(c);
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
  while (++at_ != end_ && !end_of_line(*at_)) {
    if (*at_ == ')') {
      ++at_;
      return true;
    }
  }
  line.fault = "the comment does not end";
  return false;
}

bool Lines::word(Line& line, char letter) {
  double value = 0;
  if (!number(line, letter, value)) return false;
  if (letter == 'G' || letter == 'M') {
    const double scaled = letter == 'G' ? 10 * value : value, code = std::round(scaled);
    if (!(value >= 0 && value < 10'000 && std::abs(scaled - code) < 1e-6)) {
      line.fault = std::string("there is no such ") + letter + " word";
      return false;
    }
    auto& list = letter == 'G' ? line.g : line.m;
    auto& count = letter == 'G' ? line.g_count : line.m_count;
    if (count == Line::max_codes) {
      line.fault = std::string("too many ") + letter + " words";
      return false;
    }
    list[count++] = static_cast<int>(code);
    return letter == 'G' || (code != 117 && code != 118);  // a printer's message: text follows
  }
  if (line.has(letter)) {
    line.fault = std::string("the letter ") + letter + " stands twice";
    return false;
  }
  line.letters_ |= 1U << (letter - 'A');
  line.values_[static_cast<std::size_t>(letter - 'A')] = value;
  return true;
}

/// G28 X Y and M84 X Y of printers name axes.
bool Lines::bare_letters(const Line& line) {
  const auto any = [](const auto& list, std::size_t count, auto holds) {
    return std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count), holds);
  };
  return any(line.g, line.g_count, [](int g) { return g == 280 || g == 290; }) || any(line.m, line.m_count, printer_m);
}

bool Lines::number(Line& line, char letter, double& value) {
  constexpr double largest = 1e9;
  skip_blanks();
  bool negative = false;
  if (at_ != end_ && (*at_ == '+' || *at_ == '-')) {
    negative = *at_++ == '-';
    skip_blanks();
  }
  const char* first = at_;
  while (at_ != end_ && part_of_number(*at_)) ++at_;
  const char* last = at_;

  // Rarely, blanks divide a number; its parts are then joined here.
  std::array<char, 64> joined;
  skip_blanks();
  if (at_ != last && last != first && at_ != end_ && part_of_number(*at_)) {
    std::size_t size = 0;
    for (const char* c = first; c != end_ && (blank(*c) || part_of_number(*c)); at_ = ++c) {
      if (blank(*c)) continue;
      if (size == joined.size()) {
        line.fault = std::string("the number of ") + letter + " is too long";
        return false;
      }
      joined[size++] = *c;
    }
    first = joined.data();
    last = first + size;
  }
  if (first == last) {
    const char c = at_ == end_ ? '\n' : *at_;
    const bool function = is_letter(c) && at_ + 1 != end_ && is_letter(at_[1]);
    if (c != '#' && c != '[' && !function) {
      if (letter != 'G' && letter != 'M' && letter != 'O' && bare_letters(line)) {
        value = 0;
        return line.bare = true;
      }
      line.fault = std::string("the letter ") + letter + " has no number";
      return false;
    }
    if (macro_word(letter, at_, end_)) {
      line.fault = "statements of macros (IF, WHILE, GOTO …) are not supported: O words are (O100 IF, O100 WHILE …)";
      return false;
    }
    if (!computed(line, value)) return false;
    if (negative) value = -value;
    if (std::abs(value) <= largest) return true;
    line.fault = std::string("the number of ") + letter + " is out of range (largest: 1e9)";
    return false;
  }
  const auto [stop, error] = std::from_chars(first, last, value, std::chars_format::fixed);
  if (error == std::errc::result_out_of_range || (error == std::errc{} && !(value <= largest))) {
    // Numbers of lines and programs are names.
    if (letter == 'N' || letter == 'O') {
      value = 0;
      return true;
    }
    line.fault = std::string("the number of ") + letter + " is out of range (largest: 1e9)";
    return false;
  }
  if (error != std::errc{} || stop != last) {
    line.fault = std::string("what follows ") + letter + " is not a number";
    return false;
  }
  if (negative) value = -value;
  return true;
}

}  // namespace bahnwerk::gcode
