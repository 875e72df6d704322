// ns per inverse of a needle's pose with three derivatives, and per place of a path in five coordinates, on each
// winding machine; ns per bounds of the map.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/motion/axes/machine_path.hpp"
#include "tests/core/machine/winders.hpp"
#include "tests/core/motion/axes/needle_loop.hpp"

namespace bahnwerk {
namespace {

std::shared_ptr<const Kinematics> machine(benchmark::State& state) {
  const test::Winder winder = test::winders()[static_cast<std::size_t>(state.range(0))];
  state.SetLabel(winder.name);
  return winder.configurations.front();
}

std::vector<ToolJet> tools(const test::NeedlePath& path) {
  std::vector<ToolJet> list;
  for (int i = 0; i < 1024; ++i) {
    const double s = path.tool.length() * ((i * 613) % 1024 + 0.5) / 1024;
    const std::size_t segment = path.tool.find(s);
    list.push_back(path.orientation->tool(path.tool[segment], segment, path.tool[segment].parameter(s)));
  }
  return list;
}

void inverse(benchmark::State& state) {
  const auto kinematics = machine(state);
  const std::vector<ToolJet> list = tools(test::stator_turn());
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(kinematics->inverse(list[i++ & 1023]));
}
BENCHMARK(inverse)->DenseRange(0, 2);

void along_path(benchmark::State& state) {
  const auto kinematics = machine(state);
  const test::NeedlePath path = test::stator_turn();
  const KinematicAxisPath axes(path.tool, *kinematics, path.orientation);
  int i = 0;
  for (auto _ : state) {
    const double u = ((i * 613) % 1024 + 0.5) / 1024;
    benchmark::DoNotOptimize(axes.at_parameter(static_cast<std::size_t>(i++ & 3), u));
  }
}
BENCHMARK(along_path)->DenseRange(0, 2);

void bounds(benchmark::State& state) {
  const auto kinematics = machine(state);
  const std::vector<ToolJet> list = tools(test::stator_turn());
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(kinematics->bounds(list[i++ & 1023].pose(), 2));
}
BENCHMARK(bounds)->DenseRange(0, 2);

void made_path(benchmark::State& state) {
  const test::Winder winder = test::winders()[static_cast<std::size_t>(state.range(0))];
  state.SetLabel(winder.name);
  const test::NeedlePath path = test::stator_turn();
  for (auto _ : state)
    benchmark::DoNotOptimize(machine_path(path.tool, path.orientation, winder.configurations).travel);
}
BENCHMARK(made_path)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace bahnwerk
