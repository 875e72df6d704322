#pragma once
/// The order in which the lines of a part program are executed: subprograms, branches and loops of O words, M98 and
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

/// Decides which line follows: by O words, M98 and M99.
class Control {
 public:
  static constexpr std::size_t max_calls = 64;       ///< depth of nested subprograms
  static constexpr std::size_t bytes_per_step = 64;  ///< a line takes one step more for each such number of bytes

  Control(std::string_view text, const GcodeOptions& options, Parameters& parameters, Lines& lines, Progress progress)
      : text_(text), options_(options), parameters_(parameters), lines_(lines), progress_(progress) {}

  /// Takes the line from the budget if it, or a line behind it, was executed before. Returns false if the budget is
  /// used up.
  bool spend(const Line& line, Place before) {
    if (line.number > furthest_) {
      furthest_ = line.number;
      return true;
    }
    spent_ += 1 + static_cast<std::size_t>(line.end - before.at) / bytes_per_step;
    return spent_ <= options_.steps;
  }

  /// Executes a line with a flow: the next line is then another one. Returns false, with fault(), if that is impossible
  /// or if words follow the O word and its values.
  bool execute(const Line& line);
  /// Executes M98: calls the numbered subprogram `repeats` times.
  bool call(int program, std::size_t repeats);
  /// Executes M99; returns false in the main program.
  bool back();

  /// Returns whether the end of the text was reached inside a subprogram.
  bool inside() const { return !frames_.empty(); }
  std::size_t depth() const { return frames_.size(); }  ///< number of active subprograms
  /// Returns whether M98 has called the subprogram that begins in this line.
  bool called(const Line& line) const {
    return std::find(called_.begin(), called_.end(), line.number) != called_.end();
  }
  bool used() const { return outline_.has_value(); }
  const std::string& fault() const { return fault_; }

 private:
  struct Frame {
    Place back;
    std::size_t head;       // index of the subprogram's first entry in the outline
    std::size_t remaining;  // remaining repetitions
    std::size_t loops;      // number of enclosing loops
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
  Progress progress_;
  std::optional<Outline> outline_;  // outline of the program, made on first use
  std::vector<Frame> frames_;
  std::vector<Loop> loops_;              // active repeats
  std::vector<std::size_t> called_;      // lines of the numbered subprograms that were called
  std::size_t pending_ = Outline::none;  // the elseif or else to which an if has jumped
  std::size_t furthest_ = 0, spent_ = 0;
  std::string fault_;
};

}  // namespace bahnwerk::gcode
