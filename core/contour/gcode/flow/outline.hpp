#pragma once
/// Places of the O words of a part program, and their chains.
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk::gcode {

/// The O words of a text, in the order of lines.
class Outline {
 public:
  static constexpr std::size_t none = ~std::size_t{0}, most = 100'000;

  /// A line with an O word. The words of one label from sub to endsub, from if to endif, from while, do or repeat to
  /// the end of the loop form a chain; the label may be used again behind it.
  struct Entry {
    Place before, after;      ///< places before and after the line
    Flow flow = Flow::none;   ///< none: a number alone, with which subprograms of M98 begin
    std::size_t head = none;  ///< first entry of the chain; for break and continue: of their loop's
    std::size_t next = none;  ///< next entry of the chain
    std::size_t last = none;  ///< last entry of the chain, set at its head; none: the chain has no end
  };

  /// Finds the O words. O(bytes + O words · log labels).
  Outline(std::string_view text, bool skip_slash, Progress progress);

  bool full() const { return full_; }  ///< whether there are more than `most`; the others are unknown
  const Entry& operator[](std::size_t index) const { return entries_[index]; }
  /// Returns the entry of a line; none if it has no O word.
  std::size_t of_line(std::size_t number) const;
  /// Returns the head of the first subprogram of a label: O… sub, or with `numbered` a number alone.
  std::size_t subprogram(const std::string& label, bool numbered) const;

 private:
  void link(const std::string& label, std::size_t index, std::map<std::string, std::size_t>& open);

  std::vector<Entry> entries_;  // ordered by line
  bool full_ = false;
  std::map<std::string, std::size_t> subs_, numbers_;
};

}  // namespace bahnwerk::gcode
