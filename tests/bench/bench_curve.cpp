// ns per evaluation of curves, path points and the arc-length table.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/nurbs.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/geometry/path/path.hpp"

namespace bahnwerk {
namespace {

enum Which { line, arc, helix, cubic_plane, cubic_space, quintic_plane, rational_quadratic, rational_cubic };

std::shared_ptr<const Curve> make(int which) {
  const std::vector<Vec> plane{{0, 0, 0}, {10, 20, 0}, {30, -5, 0}, {40, 10, 0}};
  const std::vector<Vec> space{{0, 0, 0}, {10, 20, 5}, {30, -5, -3}, {40, 10, 8}};
  switch (which) {
    case line:
      return std::make_shared<Line>(Vec{0, 0, 0}, Vec{40, 10, 0});
    case arc:
      return std::make_shared<Arc>(Vec{0, 0, 0}, Vec{1, 0, 0}, Vec{0, 1, 0}, 10, 2);
    case helix:
      return std::make_shared<Arc>(Vec{0, 0, 0}, Vec{1, 0, 0}, Vec{0, 1, 0}, 10, 2, 5);
    case cubic_plane:
      return std::make_shared<Rational>(Rational::bezier(plane));
    case cubic_space:
      return std::make_shared<Rational>(Rational::bezier(space));
    case quintic_plane:
      return std::make_shared<Rational>(
          Rational::bezier({{0, 0, 0}, {5, 10, 0}, {15, 20, 0}, {25, 0, 0}, {35, -5, 0}, {40, 10, 0}}));
    case rational_quadratic:
      return std::make_shared<Rational>(
          Rational::bezier({{10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {1, 0.7071067811865476, 1}));
    default:
      return std::make_shared<Rational>(Rational::bezier(plane, {1, 0.5, 2, 1}));
  }
}

std::vector<double> parameters(double begin, double end) {
  std::vector<double> u;
  for (int i = 0; i < 1024; ++i) u.push_back(begin + (end - begin) * ((i * 613) % 1024 + 0.5) / 1024);
  return u;
}

template <class F>
void over(benchmark::State& state, const std::vector<double>& x, F&& f) {
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(f(x[i++ & 1023]));
}

void jet(benchmark::State& state) {
  const auto curve = make(static_cast<int>(state.range(0)));
  over(state, parameters(0, 1), [&](double u) { return curve->at(u); });
}
void speed(benchmark::State& state) {
  const auto curve = make(static_cast<int>(state.range(0)));
  over(state, parameters(0, 1), [&](double u) { return curve->speed(u); });
}
void s_of_u(benchmark::State& state) {
  const Segment segment(make(static_cast<int>(state.range(0))), 0, 0);
  over(state, parameters(0, 1), [&](double u) { return segment.arc_length(u); });
}
void u_of_s(benchmark::State& state) {
  const Segment segment(make(static_cast<int>(state.range(0))), 0, 0);
  state.counters["panels"] = static_cast<double>(segment.panel_parameters().size() - 1);
  over(state, parameters(0, segment.length()), [&](double s) { return segment.parameter(s); });
}
void point_at_parameter(benchmark::State& state) {
  const Segment segment(make(static_cast<int>(state.range(0))), 0, 0);
  over(state, parameters(0, 1), [&](double u) { return segment.at_parameter(u); });
}
void point_at_s(benchmark::State& state) {
  const Segment segment(make(static_cast<int>(state.range(0))), 0, 0);
  over(state, parameters(0, segment.length()), [&](double s) { return segment.at(s); });
}
void build_segment(benchmark::State& state) {
  const auto curve = make(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    Path path;
    path.append(curve, 0);
    benchmark::DoNotOptimize(path.length());
  }
}

void names(benchmark::internal::Benchmark* b) {
  for (int which : {line, arc, helix, cubic_plane, cubic_space, quintic_plane, rational_quadratic, rational_cubic})
    b->Arg(which);
}
BENCHMARK(jet)->Apply(names);
BENCHMARK(speed)->Apply(names);
BENCHMARK(s_of_u)->Apply(names);
BENCHMARK(u_of_s)->Apply(names);
BENCHMARK(point_at_parameter)->Apply(names);
BENCHMARK(point_at_s)->Apply(names);
BENCHMARK(build_segment)->Apply(names);

void nurbs_at(benchmark::State& state) {
  const Nurbs curve{3,
                    {{0, 0, 0}, {10, 20, 0}, {20, -5, 0}, {30, 5, 0}, {35, 15, 0}, {40, 10, 0}},
                    {1, 2, 1, 0.5, 1, 1},
                    {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}};
  over(state, parameters(0, 3), [&](double u) { return curve.at(u); });
}
BENCHMARK(nurbs_at);

}  // namespace
}  // namespace bahnwerk
