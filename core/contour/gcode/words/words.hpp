#pragma once
/// The words of a part program, line by line: letters and numbers without their meaning.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/contour/gcode/words/expression.hpp"

namespace bahnwerk::gcode {

/// Effect of an O word on the order of the lines.
enum class Flow : std::uint8_t {
  none,
  sub,
  endsub,
  call,
  leave,
  branch,
  elseif,
  otherwise,
  endif,
  loop,
  endloop,
  begin,
  repeat,
  endrepeat,
  stop,
  next
};

/// The words of a line. G and M words are lists; every other letter has at most one number.
struct Line {
  static constexpr std::size_t max_codes = 16, max_assignments = 64;

  std::size_t number = 0;  ///< number of the line in the text, from 1
  std::array<int, max_codes> g{};
  std::size_t g_count = 0;         ///< an entry of g is ten times the number: G5.1 is 51
  std::array<int, max_codes> m{};  ///< a number with a decimal is stored as −10 times itself: M862.3 is −8623
  std::size_t m_count = 0;
  std::uint32_t behind_m6 = 0;      ///< letters behind M6
  std::uint32_t foreign = 0;        ///< letters behind unknown M words, which belong to those words
  bool has_foreign = false;         ///< whether such an M word is in the line
  bool text = false;                ///< whether something other than words follows such an M word
  std::string controller;           ///< the whole text of a line for the controller, such as $H
  bool slash = false;               ///< whether the line begins with /
  bool bare = false;                ///< whether a letter has no number, as in G28 X Y of printers; it then counts as 0
  bool percent = false;             ///< whether the line begins with %
  Flow flow = Flow::none;           ///< effect of the O word; the rest of its line is not read
  const char* arguments = nullptr;  ///< text behind the O word
  const char* end = nullptr;        ///< end of the line
  std::string label;                ///< name of the O word, or its number without leading zeros
  std::string fault;                ///< first text that is not a word; may be empty

  bool has(char letter) const { return (letters_ >> (letter - 'A')) & 1U; }
  double operator[](char letter) const { return values_[static_cast<std::size_t>(letter - 'A')]; }
  bool any(std::uint32_t mask) const { return (letters_ & mask) != 0; }
  bool empty() const { return letters_ == 0 && g_count == 0 && m_count == 0; }

 private:
  friend class Lines;
  std::uint32_t letters_ = 0;
  std::array<double, 26> values_{};
};

/// Returns the bit set of letters that Line::any takes.
constexpr std::uint32_t letters(std::string_view list) {
  std::uint32_t mask = 0;
  for (char c : list) mask |= 1U << (c - 'A');
  return mask;
}

/// A place between two lines of a text.
struct Place {
  const char* at = nullptr;
  std::size_t number = 0;  ///< number of the line before the place
};

/// Reads a text line by line, O(bytes). Numbers are decimal, within ±1e9, independent of the locale; an exponent is
/// read where no other reading is possible (number_exponent.hpp) and is a fault where a word E can be. Values that a
/// line gives to parameters hold from the next line on.
///
/// Words behind an M word that no machine tool has (codes.hpp, known_m) belong to that word, unless the line has a G
/// word that takes words: then they are words of the line.
class Lines {
 public:
  /// `parameters` may be null: every use of a parameter is then a fault.
  explicit Lines(std::string_view text, Parameters* parameters = nullptr);
  /// Reads the next line; returns false at the end of the text. With `skip_slash` the words of a line that begins with
  /// / are not read.
  bool next(Line& line, bool skip_slash);

  Place place() const { return {at_, number_}; }
  void go(Place place) { at_ = place.at, number_ = place.number; }
  /// Reads the O word of the next line, if it has one: label and flow only; the rest of the line is skipped.
  bool next_label(Line& line);

 private:
  void words(Line& line);
  bool label(Line& line);
  bool assignment(Line& line);
  bool computed(Line& line, double& value);
  const char* line_end();
  void end_line();
  bool word(Line& line, char letter);
  bool code(Line& line, char letter, double value);
  bool foreign_word(Line& line);
  static void give_up_foreign(Line& line);
  bool selector(Line& line);
  bool number(Line& line, char letter, double& value);
  bool join(Line& line, char letter, const char*& first, const char*& last);
  bool exponent(Line& line, char letter, const char*& first, const char*& last);
  bool computed_number(Line& line, char letter, const char* word, double& value);
  static bool parse(Line& line, char letter, const char* first, const char* last, double& value);
  std::string no_word(const char* from) const;
  static bool bare_letters(const Line& line);
  bool axes_follow() const;
  bool comment(Line& line);
  void skip_blanks();
  void skip_line();

  const char *at_, *end_;
  const char* line_end_ = nullptr;  // end of the current line, once found
  std::array<char, 64> joined_{};   // a number with blanks in it
  bool printer_ = false;            // whether words E are alone, or words of printers occur: a program for a printer
  std::size_t number_ = 0;
  Parameters* parameters_;
  std::vector<std::pair<Expression::Reference, double>> assigned_;  // values that the current line gives to parameters
};

}  // namespace bahnwerk::gcode
