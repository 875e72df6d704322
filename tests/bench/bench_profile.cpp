/// Time per straight move, over moves of all cases.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/motion/profile/profile.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

struct Move {
  double length, v0, v1;
  Limits limits;
};

enum Kind { trapezoid, double_s, snap_limited };
enum Ends { at_rest, moving };

std::vector<Move> moves(Kind kind, Ends ends) {
  Random random(1);
  std::vector<Move> list;
  while (list.size() < 1024) {
    Move m{0, 0, 0, {100, 1000 * random.uniform(0.5, 2), unlimited, unlimited}};
    if (kind != trapezoid) m.limits.jerk = 20000 * random.uniform(0.5, 2);
    if (kind == snap_limited) m.limits.snap = 1e6 * random.uniform(0.5, 2);
    if (ends == moving) {
      m.v0 = random.uniform(0, 100);
      m.v1 = random.uniform(0, 100);
    }
    m.length = direct_distance(m.v0, m.v1, m.limits) + 20 * random.uniform() * random.uniform();
    list.push_back(m);
  }
  return list;
}

void plan(benchmark::State& state, Kind kind, Ends ends) {
  const std::vector<Move> list = moves(kind, ends);
  std::size_t i = 0;
  for (auto _ : state) {
    const Move& m = list[i++ % list.size()];
    Profile p = straight_profile(m.length, m.v0, m.v1, m.limits);
    benchmark::DoNotOptimize(p);
  }
}

void sample(benchmark::State& state, Kind kind) {
  const std::vector<Move> list = moves(kind, moving);
  const Profile p = straight_profile(list[0].length, list[0].v0, list[0].v1, list[0].limits);
  double t = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(p.sample(t));
    t += 0.37 * p.duration;
    if (t > p.duration) t -= p.duration;
  }
}

BENCHMARK_CAPTURE(plan, trapezoid_at_rest, trapezoid, at_rest);
BENCHMARK_CAPTURE(plan, trapezoid_moving, trapezoid, moving);
BENCHMARK_CAPTURE(plan, double_s_at_rest, double_s, at_rest);
BENCHMARK_CAPTURE(plan, double_s_moving, double_s, moving);
BENCHMARK_CAPTURE(plan, snap_limited_at_rest, snap_limited, at_rest);
BENCHMARK_CAPTURE(plan, snap_limited_moving, snap_limited, moving);
BENCHMARK_CAPTURE(sample, double_s, double_s);
BENCHMARK_CAPTURE(sample, snap_limited, snap_limited);

}  // namespace
}  // namespace bahnwerk
