#pragma once
/// The words of a part program, line by line: letters and numbers, not their meaning.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace bahnwerk::gcode {

/// One line of a program. G and M words are lists, every other letter has at most one number.
struct Line {
  static constexpr std::size_t max_codes = 16;

  std::size_t number = 0;  ///< in the text, from 1
  std::array<int, max_codes> g{};
  std::size_t g_count = 0;  ///< g holds tenfold numbers: G5.1 is 51
  std::array<int, max_codes> m{};
  std::size_t m_count = 0;
  bool slash = false;    ///< begins with /
  bool percent = false;  ///< begins with %
  std::string fault;     ///< the first thing that is not a word; empty = none

  bool has(char letter) const { return (letters_ >> (letter - 'A')) & 1U; }
  double operator[](char letter) const { return values_[static_cast<std::size_t>(letter - 'A')]; }
  bool any(std::uint32_t mask) const { return (letters_ & mask) != 0; }
  bool empty() const { return letters_ == 0 && g_count == 0 && m_count == 0; }

 private:
  friend class Lines;
  std::uint32_t letters_ = 0;
  std::array<double, 26> values_{};
};

/// Bit set of letters, for Line::any.
constexpr std::uint32_t letters(std::string_view list) {
  std::uint32_t mask = 0;
  for (char c : list) mask |= 1U << (c - 'A');
  return mask;
}

/// Walks through a text, O(bytes). Numbers are decimal, without exponent, within ±1e9, whatever the locale.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// False at the end of the text. With `skip_slash` the words of a line that begins with / are not read.
  bool next(Line& line, bool skip_slash);

 private:
  void words(Line& line);
  bool word(Line& line, char letter);
  bool number(Line& line, char letter, double& value);
  bool comment(Line& line);
  void skip_blanks();
  void skip_line();

  const char *at_, *end_;
  std::size_t number_ = 0;
};

}  // namespace bahnwerk::gcode
