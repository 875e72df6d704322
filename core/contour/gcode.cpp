#include "core/contour/gcode.hpp"

#include "core/contour/gcode/interpreter.hpp"
#include "core/contour/gcode/words.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t lines_per_report = 256;  // a spline takes up to 0.1 ms

void read(std::string_view text, bool block_delete, gcode::Interpreter& interpreter, Progress& progress) {
  gcode::Lines lines(text);
  gcode::Line line;
  bool began = false, ended = false;
  while (lines.next(line, block_delete)) {
    if (line.number % lines_per_report == 0) progress.report("reading", 0);
    if (ended) {
      if (line.empty() && line.fault.empty()) continue;
      return interpreter.rest(line);
    }
    if (line.percent) {
      ended = began;
      continue;
    }
    began = began || !line.empty();
    if (!interpreter.execute(line)) {
      if (!interpreter.ended()) return;
      ended = true;
    }
  }
}

}  // namespace

Contour read_gcode(std::string_view text, const GcodeOptions& options, Progress& progress) {
  gcode::Interpreter interpreter(options, false, progress);
  read(text, options.block_delete, interpreter, progress);
  if (!interpreter.lifted()) return interpreter.finish();
  // One height throughout, known only now: the same again at height 0.
  gcode::Interpreter flat(options, true, progress);
  read(text, options.block_delete, flat, progress);
  Contour contour = flat.finish();
  contour.height = interpreter.height();
  return contour;
}

Contour read_gcode(std::string_view text, const GcodeOptions& options) {
  SilentProgress silent;
  return read_gcode(text, options, silent);
}

}  // namespace bahnwerk
