// The number behind a letter.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/contour/gcode/words/characters.hpp"
#include "core/contour/gcode/words/codes.hpp"
#include "core/contour/gcode/words/number_exponent.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk::gcode {
namespace {

/// Statements of Fanuc's macros, by their first letter and what follows it.
bool macro_word(char first, const char* at, const char* end) {
  for (const std::string_view word : {"IF", "GOTO", "WHILE", "END", "THEN", "DO"}) {
    if (word[0] != first) continue;
    const char* c = at;
    std::size_t i = 1;
    while (i < word.size() && c != end && capital(*c) == word[i]) ++i, ++c;
    if (i == word.size() && (c == end || (!is_letter(*c) && *c != '_'))) return true;
  }
  return false;
}

std::string name_of(char letter) { return std::string(1, letter); }

}  // namespace

/// G28 X Y and M84 X Y of printers name axes.
bool Lines::bare_letters(const Line& line) {
  const auto any = [](const auto& list, std::size_t count, auto holds) {
    return std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count), holds);
  };
  return any(line.g, line.g_count, [](int g) { return g == 280 || g / 10 == 29; }) ||
         any(line.m, line.m_count, [](int m) { return printer_m(whole_m(m)); });
}

bool Lines::number(Line& line, char letter, double& value) {
  const char* word = at_ - 1;
  skip_blanks();
  bool negative = false;
  if (at_ != end_ && (*at_ == '+' || *at_ == '-')) {
    negative = *at_++ == '-';
    skip_blanks();
  }
  const char* first = at_;
  while (at_ != end_ && part_of_number(*at_)) ++at_;
  const char* last = at_;
  if (first == last) {
    if (!computed_number(line, letter, word, value)) return false;
  } else {
    skip_blanks();
    if (at_ != last && at_ != end_ && part_of_number(*at_) && !join(line, letter, first, last)) return false;
    if (at_ != end_ && capital(*at_) == 'E' && !blank(at_[-1]) && !exponent(line, letter, first, last)) return false;
    if (!parse(line, letter, first, last, value)) return false;
  }
  if (negative) value = -value;
  return true;
}

/// Rarely, blanks divide a number; its parts are then joined.
bool Lines::join(Line& line, char letter, const char*& first, const char*& last) {
  std::size_t size = 0;
  for (const char* c = first; c != end_ && (blank(*c) || part_of_number(*c)); at_ = ++c) {
    if (blank(*c)) continue;
    if (size == joined_.size()) {
      line.fault = "the number of " + name_of(letter) + " is too long";
      return false;
    }
    joined_[size++] = *c;
  }
  first = joined_.data();
  last = first + size;
  return true;
}

/// Reads e or E right behind the digits. `first`, `last` include the exponent if it is one.
bool Lines::exponent(Line& line, char letter, const char*& first, const char*& last) {
  if (std::string_view("GMNOT").find(letter) != std::string_view::npos) return true;
  const auto digits = static_cast<std::size_t>(last - first);
  const std::string_view rest(at_, static_cast<std::size_t>(line_end() - at_));
  // The letter of the word is the last one before the number.
  const char* own = at_ - 1;
  while (!is_letter(*own)) --own;
  std::size_t size = 0;
  ExponentReading reading = exponent_reading({first, digits}, rest, *own == capital(*own), size);
  if (reading == ExponentReading::unclear) {
    if (letter == 'E' || line.has('E'))
      reading = ExponentReading::exponent;
    else if (printer_)
      reading = ExponentReading::word;
  }
  if (reading == ExponentReading::word) return true;
  if (reading == ExponentReading::unclear) {
    line.fault = "E behind the number of " + name_of(letter) +
                 ": its exponent, or a word of its own? Write the number without exponent, or a blank before E";
    return false;
  }
  if (first == joined_.data()) {
    if (digits + size > joined_.size()) {
      line.fault = "the number of " + name_of(letter) + " is too long";
      return false;
    }
    std::copy(at_, at_ + size, joined_.data() + digits);
    last += size;
  } else {
    last = at_ + size;
  }
  at_ += size;
  return true;
}

/// G28 XYZ: nothing but letters of axes up to a blank.
bool Lines::axes_follow() const {
  const char* last = at_;
  while (last != end_ && std::string_view("XYZEW").find(capital(*last)) != std::string_view::npos) ++last;
  return last != at_ && (last == end_ || blank(*last) || end_of_line(*last) || *last == ';');
}

/// An expression, a parameter or a function; for printers a letter alone.
bool Lines::computed_number(Line& line, char letter, const char* word, double& value) {
  const char c = at_ == end_ ? '\n' : *at_;
  const bool name = is_letter(c) && at_ + 1 != end_ && (is_letter(at_[1]) || at_[1] == '_');
  const bool bare = letter != 'G' && letter != 'M' && bare_letters(line);
  if (macro_word(letter, at_, end_)) {
    line.fault = "statements of macros (IF, WHILE, GOTO …) are not supported: O words are (O100 IF, O100 WHILE …)";
    return false;
  }
  if (c == '=') {
    line.fault =
        name_of(letter) + "=, the form of another control, is not supported: write the number behind the letter";
    return false;
  }
  if (c != '#' && c != '[' && ((!name && c != '_') || (bare && axes_follow()))) {
    if (bare) {
      value = 0;
      return line.bare = true;
    }
    line.fault = "the letter " + name_of(letter) + " has no number";
    return false;
  }
  if (name || c == '_') {
    const char* behind = at_;
    while (behind != end_ && is_letter(*behind)) ++behind;
    while (behind != end_ && blank(*behind)) ++behind;
    if (behind == end_ || *behind != '[') {
      line.fault = no_word(word);
      return false;
    }
  }
  if (!computed(line, value)) return false;
  if (std::abs(value) <= 1e9) return true;
  line.fault = "the number of " + name_of(letter) + " is out of range (largest: 1e9)";
  return false;
}

/// Digits, without a sign.
bool Lines::parse(Line& line, char letter, const char* first, const char* last, double& value) {
  constexpr double largest = 1e9;
  const auto [stop, error] = std::from_chars(first, last, value);
  if (error == std::errc::result_out_of_range) {
    const char* exponent = std::find_if(first, last, is_letter);
    if (exponent != last && exponent[1] == '-') {
      value = 0;
      return true;
    }
  }
  if (error == std::errc::result_out_of_range || (error == std::errc{} && !(value <= largest))) {
    // Numbers of lines and programs are names.
    if (letter == 'N' || letter == 'O') {
      value = 0;
      return true;
    }
    line.fault = "the number of " + name_of(letter) + " is out of range (largest: 1e9)";
    return false;
  }
  if (error != std::errc{} || stop != last) {
    line.fault = "what follows " + name_of(letter) + " is not a number";
    return false;
  }
  return true;
}

}  // namespace bahnwerk::gcode
