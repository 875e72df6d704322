/// Random short contours under random limits: whatever comes, the verifier finds every limit held, and the law is no
/// faster than the bound says any can be.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/plan/random_contour.hpp"
#include "tests/source.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t shards = 20;

/// Problems per shard.
std::size_t problems() { return testing::cases(4000 / shards); }

struct Problem {
  testing::Outline outline;
  Machine machine;
  JerkLimitedOptions options;
};

Problem random_problem(std::uint64_t seed) {
  Random random(seed);
  Problem p;
  const std::size_t dimension = random.chance(0.5) ? 2 : 3;
  p.outline = testing::random_outline(random, 1 + random.below(4), dimension);
  p.machine = testing::random_machine(random, dimension);
  const double time = std::pow(10, random.uniform(-4, 0));  // of the ramps, A/J
  for (AxisLimits& a : p.machine.axes)
    a.jerk = random.chance(0.1) ? unlimited : a.acceleration / (time * std::pow(10, random.uniform(-0.5, 0.5)));
  if (random.chance(0.2)) {
    p.options.path.acceleration = std::pow(10, random.uniform(2, 4.5));
    p.options.path.jerk = p.options.path.acceleration / time;
  }
  if (random.chance(0.1)) p.options.path.velocity = std::pow(10, random.uniform(1, 3));
  return p;
}

/// What README.md says of the gap: median, nine tenths, 99 of 100, per cent.
std::vector<double> gaps_in_readme() {
  std::ifstream file(test::source("README.md"));
  std::string line;
  while (std::getline(file, line) && line.find("| gap of `jerk_limited` on") == line.npos) {
  }
  std::istringstream words(line.substr(std::min(line.size(), line.find(" % | ") + 5)));
  std::vector<double> list;
  char slash = 0;
  for (double value = 0; words >> value; words >> slash) list.push_back(value);
  return list;
}

class JerkProperty : public ::testing::TestWithParam<std::size_t> {};

TEST_P(JerkProperty, NoLimitIsViolated) {
  Progress progress;
  std::vector<double> gaps;
  for (std::size_t i = 0; i < problems(); ++i) {
    const std::uint64_t seed = 1 + i * shards + GetParam();
    const Problem p = random_problem(seed);
    const Contour contour = testing::build(p.outline);
    const TimeLaw law = plan_jerk_limited(contour, p.machine, p.options, progress).law;
    ContourVerifierInput input{contour, p.machine, law, p.options.corner_angle, 3};
    input.path = p.options.path;
    for (const Check& check : verify_motion(input, progress).checks)
      ASSERT_TRUE(check.passed) << "seed " << seed << ": " << check_name(check) << ' ' << check.value << " > "
                                << check.limit;
    const Bound bound = lower_bound(contour, p.machine, p.options.corner_angle, progress);
    ASSERT_TRUE(bound_check(bound, law.duration()).passed)
        << "seed " << seed << ": " << law.duration() << " < " << bound.value;
    // The bound knows nothing of limits along the path.
    if (p.options.path.velocity == unlimited && p.options.path.acceleration == unlimited)
      gaps.push_back(law.duration() / bound.value - 1);
  }
  std::sort(gaps.begin(), gaps.end());
  const std::vector<double> printed = gaps_in_readme();
  ASSERT_EQ(printed.size(), 3U);
  const bool many = gaps.size() >= 50;  // few say nothing
  // Shards differ: the median little, the others threefold.
  const double parts[] = {0.5, 0.9, 0.99}, spread[] = {1.6, 3, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap = 100 * gaps[static_cast<std::size_t>(parts[i] * static_cast<double>(gaps.size() - 1))];
    RecordProperty("gap_" + std::to_string(parts[i]), std::to_string(gap));
    if (!many) continue;
    EXPECT_LE(gap, spread[i] * printed[i]) << "per cent, README.md, at " << parts[i];
    EXPECT_GE(gap, printed[i] / spread[i]) << "per cent, README.md, at " << parts[i];
  }
}

/// An axis without a limit of jerk beside one with a small limit, of which the solver once made laws five times as
/// long: first a long cell at a small feed behind short ones, then a turn of the limited axis next to which the other
/// one may brake at once.
TEST(JerkHard, AxesWithoutALimitOfJerk) {
  Progress progress;
  for (const auto& [seed, most] : {std::pair{82, 1.001}, std::pair{288, 1.6}}) {
    const Problem p = random_problem(static_cast<std::uint64_t>(seed));
    const Contour contour = testing::build(p.outline);
    const double duration = plan_jerk_limited(contour, p.machine, p.options, progress).law.duration();
    EXPECT_LE(duration, most * lower_bound(contour, p.machine, p.options.corner_angle, progress).value) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, JerkProperty, ::testing::Range(std::size_t{0}, shards));

}  // namespace
}  // namespace bahnwerk
