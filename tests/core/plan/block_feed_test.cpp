/// Feeds of short blocks and rounding of free-form curves, on random contours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/blend.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/numeric/random.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string failures(const Verification& verification) {
  std::string text;
  for (const Check& c : verification.checks)
    if (!c.passed)
      text += check_name(c) + ": " + std::to_string(c.value) + " > " + std::to_string(c.limit) + " at " +
              std::to_string(c.at) + "; ";
  return text;
}

Vec ahead(double heading) { return {std::cos(heading), std::sin(heading), 0}; }

/// A curve of about `length` from where the builder stands. Changes the heading.
void add_curve(ContourBuilder& b, Random& random, double length, double& heading, bool free_form) {
  const Vec at = b.position();
  const double kind = random.uniform();
  if (kind < (free_form ? 0.25 : 0.7)) {
    b.line(at + length * ahead(heading));
  } else if (kind < (free_form ? 0.4 : 0.85)) {
    const double side = random.chance(0.5) ? 1 : -1, sweep = random.uniform(0.05, 4), radius = length / sweep;
    const Vec centre = at + radius * side * Vec{-ahead(heading).y, ahead(heading).x, 0}, d = at - centre;
    const double c = std::cos(side * sweep), s = std::sin(side * sweep);
    b.arc(centre + Vec{c * d.x - s * d.y, s * d.x + c * d.y, 0}, centre, side > 0);
    heading += side * sweep;
  } else {
    const bool weighted = random.chance(0.6);
    const std::size_t degree = 2 + random.below(free_form ? 4 : 2), inner = weighted ? random.below(3) : 0;
    const double wild = free_form ? random.uniform(0, 2.5) : 0.6;
    std::vector<Vec> points{at};
    std::vector<double> weights{1}, knots(degree + 1, 0.0);
    for (std::size_t j = 1; j <= degree + inner; ++j) {
      points.push_back(points.back() +
                       random.uniform(0.3, 1.5) * length / static_cast<double>(degree) * ahead(heading));
      weights.push_back(std::pow(10, random.uniform(-1, 1)));
      heading += random.uniform(-wild, wild);
    }
    weights[0] = std::pow(10, random.uniform(-1, 1));
    if (weighted) {
      for (std::size_t j = 0; j < inner; ++j) knots.push_back(random.uniform(0.1, 0.9));
      std::sort(knots.begin(), knots.end());
      knots.insert(knots.end(), degree + 1, 1.0);
      b.nurbs(static_cast<int>(degree), points, weights, knots);
    } else {
      b.nurbs(static_cast<int>(degree), points, {}, [&] {
        knots.insert(knots.end(), degree + 1, 1.0);
        return knots;
      }());
    }
  }
}

/// Blocks of 0.05 to 5 mm with feeds of 1 to 500 mm/s, of few or of many segments.
Contour short_blocks(Random& random) {
  ContourBuilder b(2, {random.uniform(-50, 50), random.uniform(-50, 50), 0});
  double heading = random.uniform(-pi, pi);
  const std::size_t blocks = 3 + random.below(20);
  const double turn = std::pow(10, random.uniform(-3, 0.4));
  const bool free_form = random.chance(0.3);
  for (std::size_t k = 0; k < blocks; ++k) {
    b.block(random.chance(0.1) ? Mode::position : Mode::cut, std::pow(10, random.uniform(0, 2.7)));
    const double length = 0.05 * std::pow(10, random.uniform(0, 2));
    const std::size_t segments = random.chance(0.6) ? 1 : 1 + random.below(30);
    for (std::size_t i = 0; i < segments; ++i) {
      heading += random.uniform(-turn, turn);
      if (random.chance(0.02)) heading += pi;
      add_curve(b, random, length / static_cast<double>(segments), heading, free_form);
    }
  }
  return b.finish();
}

Contour free_form(Random& random) {
  ContourBuilder b(2, {random.uniform(-1, 1), random.uniform(-1, 1), 0});
  double heading = random.uniform(-pi, pi);
  const double size = std::pow(10, random.uniform(-1.5, 1.5));
  b.block(random.chance(0.5) ? Mode::position : Mode::cut, random.chance(0.5) ? unlimited : random.uniform(5, 500));
  const std::size_t segments = 2 + random.below(random.chance(0.1) ? 40 : 6);
  for (std::size_t i = 0; i < segments; ++i) {
    if (i > 0 && random.chance(0.2)) b.block(Mode::cut, random.uniform(5, 500));
    if (random.chance(0.8)) heading += random.uniform(-pi, pi);
    add_curve(b, random, size * std::pow(10, random.uniform(-0.7, 0.7)), heading, true);
  }
  return b.finish();
}

Machine machine_of(Random& random) {
  Machine m;
  const double acceleration = std::pow(10, random.uniform(3, 4.3));
  m.axes = {{"x", std::pow(10, random.uniform(2, 3.3)), acceleration, 50 * acceleration},
            {"y", std::pow(10, random.uniform(2, 3.3)), acceleration, 50 * acceleration}};
  return m;
}

/// Points along a contour, ends of blocks included, and the block that each belongs to.
struct Samples {
  Samples(const Contour& c, double step) {
    for (std::size_t b = 0; b < c.blocks.size(); ++b)
      for (std::size_t i = c.blocks[b].first; i < c.blocks[b].last; ++i) {
        const int n = std::max(2, static_cast<int>(std::ceil(c.path[i].length() / step)));
        for (int k = 0; k <= n; ++k) {
          points.push_back(c.path[i].at(c.path[i].s0() + c.path[i].length() * k / n).value);
          block.push_back(b);
        }
      }
    for (const Block& b : c.blocks) {
      if (b.first == b.last) {
        ends.push_back({});
        continue;
      }
      ends.push_back(
          {c.path[b.first].at(c.path[b.first].s0()).value, c.path[b.last - 1].at(c.path[b.last - 1].s1()).value});
    }
  }
  std::vector<Vec> points;
  std::vector<std::size_t> block;
  std::vector<std::pair<Vec, Vec>> ends;
};

/// Assigns each setpoint the earliest place of the given contour, not before the place of the setpoint before it, that
/// is within the tolerance and in whose block it may be so fast; if that fails so does every assignment in order. Near
/// the ends of a block it may have any speed.
void expect_feeds_hold(const Contour& given, const SetpointSource& rows, double tolerance) {
  const double step = std::max(5e-4, 0.1 * tolerance), near = tolerance + step;
  const Samples samples(given, step);
  const std::size_t width = rows.columns().size();
  std::vector<double> row(width);
  std::size_t at = 0, column = 0;
  while (rows.columns()[column].name != "vx") ++column;
  for (std::size_t k = 0; k < rows.count(); ++k) {
    rows.read(k, 1, row.data());
    const Vec p{row[0], row[1], 0};
    const double v = std::hypot(row[column], row[column + 1]);
    const auto allowed = [&](std::size_t i) {
      if (!(norm(samples.points[i] - p) <= near)) return false;
      const std::size_t b = samples.block[i];
      return v <= given.blocks[b].feed * (1 + 1e-9) || norm(samples.ends[b].first - p) <= near ||
             norm(samples.ends[b].second - p) <= near;
    };
    while (at < samples.points.size() && !allowed(at)) ++at;
    ASSERT_LT(at, samples.points.size()) << "row " << k << " at " << p.x << ", " << p.y << " has " << v << " mm/s";
  }
}

class BlockFeeds : public ::testing::TestWithParam<int> {};

TEST_P(BlockFeeds, HoldInEveryRow) {
  const std::size_t shards = 4, shard = static_cast<std::size_t>(GetParam());
  for (std::size_t seed = shard; seed < testing::cases(std::size_t{16}); seed += shards) {
    Random random(7000 + seed);
    const Contour given = short_blocks(random);
    const Machine machine = machine_of(random);
    const double tolerance = std::pow(10, random.uniform(-2.5, -0.7));
    for (const CornerMode corner : {CornerMode::stop, CornerMode::blend})
      for (const auto method :
           {PlanningMethod::time_optimal, PlanningMethod::braking_reserve, PlanningMethod::jerk_limited}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " method " + std::to_string(static_cast<int>(method)) +
                     (corner == CornerMode::blend ? " blended within " + std::to_string(tolerance) : ""));
        ContourPlanning planning;
        planning.method = method;
        planning.corner_mode = corner;
        planning.blend_tolerance = corner == CornerMode::blend ? tolerance : 0;
        Progress progress;
        const ContourPlan plan = plan_contour(given, machine, planning, progress);
        EXPECT_TRUE(plan.verification.passed) << failures(plan.verification);
        if (method != PlanningMethod::braking_reserve) {
          EXPECT_LE(plan.bound.gap, method == PlanningMethod::time_optimal ? 1e-5 : 0.02);
        }
        expect_feeds_hold(given, *plan.setpoints, corner == CornerMode::blend ? tolerance : 0);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, BlockFeeds, ::testing::Range(0, 4));

class FreeForm : public ::testing::TestWithParam<int> {};

TEST_P(FreeForm, RoundedContoursAreVerified) {
  const std::size_t shards = 4, shard = static_cast<std::size_t>(GetParam());
  for (std::size_t seed = shard; seed < testing::cases(std::size_t{80}); seed += shards) {
    Random random(9000 + seed);
    const Contour given = free_form(random);
    ContourPlanning planning;
    planning.method = seed % 5 ? PlanningMethod::time_optimal : PlanningMethod::braking_reserve;
    planning.corner_mode = CornerMode::blend;
    planning.blend_tolerance = std::pow(10, random.uniform(-3, -0.5));
    Progress progress;
    const ContourPlan plan = plan_contour(given, machine_of(random), planning, progress);
    EXPECT_TRUE(plan.verification.passed)
        << "seed " << seed << " tolerance " << planning.blend_tolerance << ": " << failures(plan.verification);
    EXPECT_LE(plan.bound.gap, planning.method == PlanningMethod::time_optimal ? 1e-5 : 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, FreeForm, ::testing::Range(0, 4));

/// 100 lines that zigzag by 2 µm at feed 200, one of 0.2 mm at feed 5, and 100 more.
Contour slow_between_fast() {
  ContourBuilder b(2, {});
  double x = 0;
  const auto fast = [&] {
    b.block(Mode::cut, 200);
    for (int i = 0; i < 100; ++i) b.line({x += 0.2, 0.002 * (i % 2), 0});
  };
  fast();
  b.block(Mode::cut, 5);
  b.line({x += 0.2, 0, 0});
  fast();
  return b.finish();
}

Machine quick_machine() {
  Machine m;
  m.axes = {{"x", 1800, 16000, unlimited}, {"y", 1800, 16000, unlimited}};
  return m;
}

TEST(BlockFeed, AShortSlowBlockInASectionStaysSlow) {
  const Contour given = slow_between_fast();
  ContourPlanning planning;
  planning.method = PlanningMethod::time_optimal;
  planning.corner_mode = CornerMode::blend;
  planning.blend_tolerance = 0.02;
  Progress progress;
  const ContourPlan plan = plan_contour(given, quick_machine(), planning, progress);
  EXPECT_TRUE(plan.verification.passed) << failures(plan.verification);
  EXPECT_NEAR(plan.blocks[1].length, 0.2, 0.04);
  EXPECT_GE(plan.blocks[1].end_time - plan.blocks[1].start_time, 0.16 / 5);
  expect_feeds_hold(given, *plan.setpoints, 0.02);
}

/// A planner that believes in `driven` is verified against `given`.
Verification verify(const Contour& given, const Contour& driven) {
  Progress progress;
  const Machine machine = quick_machine();
  const TimeLaw law = plan_acceleration_limited(driven, machine, {}, progress).law;
  ContourVerifierInput input{driven, machine, law, 0.1 * pi / 180};
  input.given = &given;
  return verify_motion(input, progress);
}

TEST(BlockFeed, TheGivenFeedsCount) {
  const Contour given = slow_between_fast();
  Progress progress;
  const Contour rounded = blend(given, {0.02}, quick_machine(), progress);
  EXPECT_TRUE(verify(given, rounded).passed) << failures(verify(given, rounded));
  Contour hasty = rounded;
  hasty.blocks[1].feed = 6;
  EXPECT_FALSE(verify(given, hasty).passed);
  hasty = rounded;
  for (Block& b : hasty.blocks) b.feed = 200;
  EXPECT_FALSE(verify(given, hasty).passed);
  hasty = rounded;  // one block too few: what is of no given block may not be driven
  hasty.blocks[0].last = hasty.blocks[2].last;
  hasty.blocks.resize(1);
  Contour fewer = given;
  fewer.blocks.resize(0);
  EXPECT_FALSE(verify(fewer, hasty).passed);
}

}  // namespace
}  // namespace bahnwerk
