#include "core/base/progress.hpp"
#include "core/contour/gcode.hpp"
#include "core/contour/gcode/flow/control.hpp"
#include "core/contour/gcode/interpreter.hpp"
#include "core/contour/gcode/words/parameters.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t lines_per_report = 256;  // a spline takes up to 0.1 ms
constexpr char end_of_text = '\x1A';
constexpr std::string_view filling("\x1A\0 \t\r\n", 6);
constexpr std::size_t segments_per_report = 4096;  // reports within a line, which may have a thousand turns

/// Reads the program's lines in their order, up to its end or to where further reading is useless.
class Reading {
 public:
  Reading(std::string_view text, bool cut_off, const GcodeOptions& options, gcode::Interpreter& interpreter,
          Progress progress)
      : options_(options),
        cut_off_(cut_off),
        interpreter_(interpreter),
        progress_(progress),
        parameters_(interpreter),
        lines_(text, &parameters_),
        control_(text, options, parameters_, lines_, progress) {}

  void read() {
    if (program()) rest();
    interpreter_.close(parameters_.unset());
  }

 private:
  /// Reads the program; returns false if nothing behind it matters.
  bool program() {
    gcode::Line line;
    bool began = false;
    for (gcode::Place before = lines_.place(); lines_.next(line, options_.block_delete); before = lines_.place()) {
      if (++carried_out_ % lines_per_report == 0 || interpreter_.segments() > reported_ + segments_per_report) {
        progress_.report("reading", 0);
        reported_ = interpreter_.segments();
      }
      if (!control_.spend(line, before)) {
        interpreter_.refuse(line, "the budget of " + std::to_string(options_.steps) +
                                      " steps for loops and subprograms is used up: a loop without end, or steps have "
                                      "to be raised");
        return false;
      }
      if (line.percent) {
        if (began) return true;
        continue;
      }
      began = began || !line.empty();
      if (line.flow != gcode::Flow::none && line.fault.empty()) {
        if (flow(line)) continue;
        interpreter_.refuse(line, control_.fault());
        return false;
      }
      if (line.has('O') && !control_.inside() && control_.called(line)) {
        interpreter_.end_before_subprogram(line);
        return false;
      }
      if (!interpreter_.execute(line)) return interpreter_.ended();
      if (interpreter_.request().any() && !carry_out(line)) return interpreter_.ended();
    }
    if (control_.inside()) interpreter_.refuse(line, "the subprogram has no end (M99)");
    if (cut_off_) interpreter_.end_of_text(line.number);
    return false;
  }

  /// Executes an O word, with what its calls and returns mean for the modes.
  bool flow(const gcode::Line& line) {
    const std::size_t depth = control_.depth();
    if (!control_.execute(line)) return false;
    if (control_.depth() > depth) interpreter_.enter_subprogram();
    if (control_.depth() < depth) interpreter_.leave_subprogram(line);
    return true;
  }

  /// Executes M98 and M99.
  bool carry_out(const gcode::Line& line) {
    const gcode::Request request = interpreter_.request();
    const std::size_t depth = control_.depth();
    if (request.back ? control_.back() : control_.call(request.program, request.repeats)) {
      if (request.back) interpreter_.leave_subprogram(line);
      if (control_.depth() > depth || (request.back && control_.depth() == depth)) interpreter_.enter_subprogram();
      return true;
    }
    if (request.back && !control_.inside())
      interpreter_.end(line);
    else
      interpreter_.refuse(line, control_.fault());
    return false;
  }

  /// Only subprograms may follow the end of the program.
  void rest() {
    gcode::Line line;
    while (!control_.used() && lines_.next(line, options_.block_delete)) {
      if (++carried_out_ % lines_per_report == 0) progress_.report("reading", 0);
      if (!line.empty() || !line.fault.empty() || !line.controller.empty()) return interpreter_.rest(line);
    }
  }

  const GcodeOptions& options_;
  bool cut_off_;
  gcode::Interpreter& interpreter_;
  Progress progress_;
  gcode::Parameters parameters_;
  gcode::Lines lines_;
  gcode::Control control_;
  std::size_t carried_out_ = 0, reported_ = 0;
};

}  // namespace

Contour read_gcode(std::string_view whole, const GcodeOptions& options, Progress progress) {
  // The DOS mark of the end of a text; what fills up a block behind it, or without it, is nothing.
  const std::string_view text = whole.substr(0, whole.find(end_of_text)), behind = whole.substr(text.size());
  const bool cut_off = behind.find_first_not_of(filling) != std::string_view::npos;
  const std::string_view program = text.substr(0, text.find_last_not_of('\0') + 1);
  gcode::Interpreter interpreter(options, false, progress);
  Reading(program, cut_off, options, interpreter, progress).read();
  if (!interpreter.lifted()) return interpreter.finish();
  // The contour has one height throughout, which is known only now: it is read again at height 0.
  gcode::Interpreter flat(options, true, progress);
  Reading(program, cut_off, options, flat, progress).read();
  Contour contour = flat.finish();
  contour.height = interpreter.height();
  return contour;
}

Contour read_gcode(std::string_view text, const GcodeOptions& options) {
  Progress silent;
  return read_gcode(text, options, silent);
}

}  // namespace bahnwerk
