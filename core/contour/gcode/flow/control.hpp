#pragma once
/// The order in which the lines of a part program are carried out: subprograms, branches and loops of O words, M98 and
/// M99, within a budget of steps.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contour/gcode.hpp"
#include "core/contour/gcode/flow/outline.hpp"
#include "core/contour/gcode/words/parameters.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk::gcode {

class Control {
 public:
  static constexpr std::size_t max_calls = 64;       ///< subprograms in one another
  static constexpr std::size_t bytes_per_step = 64;  ///< a longer line takes one step more for each

  Control(std::string_view text, const GcodeOptions& options, Parameters& parameters, Lines& lines, Progress& progress)
      : text_(text), options_(options), parameters_(parameters), lines_(lines), progress_(progress) {}

  /// Takes the line from the budget if it, or one behind it, was carried out before. False: there is nothing left.
  bool spend(const Line& line, Place before) {
    if (line.number > furthest_) {
      furthest_ = line.number;
      return true;
    }
    spent_ += 1 + static_cast<std::size_t>(line.end - before.at) / bytes_per_step;
    return spent_ <= options_.steps;
  }

  /// Carries out a line with a flow: the next line is another one then. False, with fault(), where that is impossible,
  /// or where words stand behind the O word and its values.
  bool execute(const Line& line);
  /// M98: the numbered subprogram, so often.
  bool call(int program, std::size_t repeats);
  /// M99; false in the main program.
  bool back();

  /// The text is at its end inside a subprogram.
  bool inside() const { return !frames_.empty(); }
  std::size_t depth() const { return frames_.size(); }  ///< subprograms under way
  /// Whether M98 has called the subprogram that begins in this line.
  bool called(const Line& line) const {
    return std::find(called_.begin(), called_.end(), line.number) != called_.end();
  }
  bool used() const { return outline_.has_value(); }
  const std::string& fault() const { return fault_; }

 private:
  struct Frame {
    Place back;
    std::size_t head;       // in the outline
    std::size_t remaining;  // further times
    std::size_t loops;      // of those outside
    bool numbered;
  };
  struct Loop {
    std::size_t head;
    double remaining;
  };

  bool fail(std::string why);
  const Outline& outline();
  bool ends(const Line& line, const char* at);
  bool condition(const Line& line, double& value);
  bool arguments(const Line& line, std::vector<double>& values);
  bool end_of(std::size_t head, Place& place);
  bool call_sub(const Line& line);
  bool leave(const Line& line);
  bool branch(const Line& line, std::size_t index);
  bool loop(const Line& line, std::size_t index);
  bool repeat(const Line& line, std::size_t index);
  bool jump(std::size_t index, Flow flow);

  std::string_view text_;
  const GcodeOptions& options_;
  Parameters& parameters_;
  Lines& lines_;
  Progress& progress_;
  std::optional<Outline> outline_;  // made where it is first needed
  std::vector<Frame> frames_;
  std::vector<Loop> loops_;              // repeats under way
  std::vector<std::size_t> called_;      // lines of the numbered subprograms that were called
  std::size_t pending_ = Outline::none;  // the elseif or else that an if led to
  std::size_t furthest_ = 0, spent_ = 0;
  std::string fault_;
};

}  // namespace bahnwerk::gcode
