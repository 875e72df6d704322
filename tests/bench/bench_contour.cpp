// MB/s and lines per second of the readers.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "core/contour/gcode.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk {
namespace {

/// A part program of so many lines: short chords, or arcs and cubic splines.
std::string program(std::size_t lines, bool curves) {
  std::string text = "G21 G90 G94\nG0 X0 Y0\nG1 F6000\n";
  char line[128];
  double x = 0, y = 0;
  for (std::size_t i = 1; i <= lines; ++i) {
    const double angle = 0.003 * static_cast<double>(i), to_x = 200 * std::sin(angle),
                 to_y = 150 * std::sin(1.37 * angle);
    const double dx = to_x - x, dy = to_y - y;
    if (!curves)
      std::snprintf(line, sizeof line, "N%zu G1 X%.4f Y%.4f\n", i, to_x, to_y);
    else if (i % 2 == 0)
      std::snprintf(line, sizeof line, "G3 X%.4f Y%.4f R%.4f\n", to_x, to_y, std::hypot(dx, dy) + 1);
    else
      std::snprintf(line, sizeof line, "G5 X%.4f Y%.4f I%.4f J%.4f P%.4f Q%.4f\n", to_x, to_y, dx / 3 - dy / 9,
                    dy / 3 + dx / 9, -dx / 3 - dy / 9, -dy / 3 + dx / 9);
    text += line;
    x = to_x;
    y = to_y;
  }
  return text;
}

void rates(benchmark::State& state, const std::string& text, std::size_t lines) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * lines));
}

void gcode_words(benchmark::State& state) {
  const auto lines = static_cast<std::size_t>(state.range(0));
  const std::string text = program(lines, false);
  for (auto _ : state) {
    gcode::Lines reader(text);
    gcode::Line line;
    double sum = 0;
    while (reader.next(line, true)) sum += line['X'];
    benchmark::DoNotOptimize(sum);
  }
  rates(state, text, lines);
}

void read_program(benchmark::State& state, bool curves) {
  const auto lines = static_cast<std::size_t>(state.range(0));
  const std::string text = program(lines, curves);
  for (auto _ : state) benchmark::DoNotOptimize(read_gcode(text).path.length());
  rates(state, text, lines);
}
void gcode_lines(benchmark::State& state) { read_program(state, false); }
void gcode_curves(benchmark::State& state) { read_program(state, true); }

BENCHMARK(gcode_words)->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(gcode_lines)->Arg(1'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(gcode_curves)->Arg(1'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk
