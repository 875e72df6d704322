// Words behind an unknown M word, and characters that begin no word.
#include <algorithm>

#include "core/contour/gcode/words/characters.hpp"
#include "core/contour/gcode/words/codes.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk::gcode {

/// A word, or text up to the next blank; in quotes with blanks. False: the rest of the line is text.
bool Lines::foreign_word(Line& line) {
  const char* first = at_;
  const std::uint32_t before = line.letters_;
  const auto counts = std::pair(line.g_count, line.m_count);
  if (is_letter(*at_)) {
    const char letter = capital(*at_++);
    const bool more = word(line, letter);
    if (line.fault.empty()) {
      line.foreign |= line.letters_ & ~before;
      return more;
    }
  }
  line.fault.clear();
  line.letters_ = before;
  std::tie(line.g_count, line.m_count) = counts;
  line.text = true;
  bool quoted = false;
  for (at_ = first; at_ != end_ && !end_of_line(*at_) && (quoted || !blank(*at_)); ++at_)
    if (*at_ == '"') quoted = !quoted;
  return true;
}

/// The words of such a code are not those of a move.
void Lines::give_up_foreign(Line& line) {
  const auto last = line.g.begin() + static_cast<std::ptrdiff_t>(line.g_count);
  if (std::any_of(line.g.begin(), last, takes_words))
    line.foreign = 0;
  else
    line.letters_ &= ~line.foreign;
}

/// $0 behind M3 … M5 or a speed: LinuxCNC's number of a spindle, of which there is one.
bool Lines::selector(Line& line) {
  ++at_;
  double number = 0;
  const char* first = at_;
  if (at_ != end_ && *at_ == '-') ++at_;
  while (at_ != end_ && part_of_number(*at_)) ++at_;
  if (first == at_)
    line.fault = "a command of the controller ($), not of the program: it stands in a line of its own";
  else if (!parse(line, '$', *first == '-' ? first + 1 : first, at_, number) || number > (*first == '-' ? 1 : 0))
    line.fault = "only one spindle is known, $0";
  return line.fault.empty();
}

/// "PRINT_START is no word of a part program …", for what begins at `from`.
std::string Lines::no_word(const char* from) const {
  constexpr std::ptrdiff_t longest = 40;
  const char* last = from;
  while (last != end_ && last - from < longest && (is_letter(*last) || part_of_number(*last) || *last == '_')) ++last;
  return std::string(from, last) +
         " is no word of a part program: a macro of a host, or a statement of another control";
}

}  // namespace bahnwerk::gcode
