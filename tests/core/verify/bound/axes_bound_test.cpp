// The bound on axes through kinematics: below what a planner reaches on them, equal to the Cartesian one where they are
// coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "tests/core/machine/winders.hpp"
#include "tests/core/motion/axes/coordinate_axes.hpp"
#include "tests/core/motion/axes/five_axes.hpp"
#include "tests/core/motion/axes/needle_loop.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::Maker;

constexpr double corner_angle = 2e-3;

double bound(const AxisPath& path, const Contour& contour, const Machine& machine) {
  Progress silent;
  return lower_bound(contour_task(path, contour, machine), corner_angle, silent).value;
}

double planned(const AxisPath& path, const Contour& contour, const Machine& machine) {
  Progress silent;
  AccelerationLimitedOptions options;
  options.corner_angle = corner_angle;
  return plan_acceleration_limited(contour_task(path, contour, machine), options, silent).law.duration();
}

std::vector<Contour> contours() {
  std::vector<Contour> list;
  list.push_back(Maker().line({40, 0}).arc({60, 20}, {40, 20}, true).line({60, 45}).done());
  list.push_back(Maker().line({-30, 35}).line({50, 10}).done());  // with a corner
  list.push_back(Maker().block(300).bezier({{30, 40}, {60, -40}, {80, 20}}).done());
  list.push_back(Maker().bezier({{10, 30}, {40, 30}, {60, 0}}, {1, 2, 0.5, 1}).line({75, -22.5}).done());
  list.push_back(Maker(3).bezier({{20, 0, 10}, {40, 30, 30}, {60, 40, 10}}).done());
  return list;
}

Machine without_jerk(const test::FiveAxes& kinematics) {
  Machine machine{kinematics.axes(), 0.001};
  for (AxisLimits& axis : machine.axes) axis.jerk = unlimited;
  return machine;
}

TEST(AxesBound, FiveAxesStayBelowTheTimeOptimalPlan) {
  const test::FiveAxes kinematics;
  const Machine machine = without_jerk(kinematics);
  for (const Contour& contour : contours()) {
    const KinematicAxisPath path(contour.path, kinematics);
    const double low = bound(path, contour, machine), plan = planned(path, contour, machine);
    RecordProperty("gap", std::to_string(plan / low - 1));
    EXPECT_LE(low, plan * (1 + 1e-9));
    EXPECT_GE(low, plan * (1 - 1e-4));
  }
}

TEST(AxesBound, LooserLimitsNeverRaiseIt) {
  const test::FiveAxes kinematics;
  const Machine machine = without_jerk(kinematics);
  for (const Contour& contour : contours()) {
    const KinematicAxisPath path(contour.path, kinematics);
    const double base = bound(path, contour, machine);
    for (std::size_t k = 0; k < 5; ++k)
      for (const double factor : {1.1, 3.0, 100.0}) {
        Machine looser = machine;
        looser.axes[k].velocity *= factor;
        EXPECT_LE(bound(path, contour, looser), base * (1 + 1e-7)) << k << " " << factor;
        looser = machine;
        looser.axes[k].acceleration *= factor;
        EXPECT_LE(bound(path, contour, looser), base * (1 + 1e-7)) << k << " " << factor;
      }
  }
}

constexpr Limits along_x{900, 9000}, along_y{400, 5000};

TEST(AxesBound, UnitsAndRepeatedAxesChangeNothing) {
  Machine two;
  two.axes = {{"x", 900, 9000}, {"y", 400, 5000}};
  for (const Contour& contour : contours()) {
    if (contour.dimension == 3) continue;
    const double cartesian = bound(CartesianAxisPath(contour.path, 2), contour, two);
    for (std::size_t axes = 2; axes <= max_axes; ++axes) {
      const test::CoordinateAxes kinematics(axes, along_x, along_y, 2);
      const Machine machine{kinematics.axes(), 0.001};
      EXPECT_NEAR(bound(KinematicAxisPath(contour.path, kinematics), contour, machine), cartesian, 1e-6 * cartesian)
          << axes;
    }
  }
}

/// Where one axis turns back the other is not there to limit the speed: the bound may be weak, but holds.
TEST(AxesBound, OneAxisAlone) {
  const Contour line = Maker().line({40, 30}).done();
  const test::CoordinateAxes one(1, along_x, along_y, 2);
  const Machine machine{one.axes(), 0.001};
  const double x = 2 * std::sqrt(40.0 / 9000);  // 40 mm at 9000 mm/s²
  EXPECT_NEAR(bound(KinematicAxisPath(line.path, one), line, machine), x, 1e-9);
  EXPECT_LE(bound(KinematicAxisPath(line.path, one), line, machine), x);
  Machine cartesian;
  cartesian.axes = {{"x", 900, 9000}};
  EXPECT_NEAR(bound(CartesianAxisPath(line.path, 1), line, cartesian), x, 1e-9);
  const Contour there_and_back = Maker().line({40, 0}).arc({40, 20}, {40, 10}, true).line({0, 20}).done();
  const double both = bound(KinematicAxisPath(there_and_back.path, one), there_and_back, machine);
  EXPECT_LE(both, 2 * 2 * std::sqrt(50.0 / 9000) + 1e-9);  // it may turn back at once, with all its acceleration
  EXPECT_GE(both, 0.9 * 2 * std::sqrt(2) * std::sqrt(50.0 / 9000));
}

/// x, and a screw with an error that repeats exactly from sample to sample of an even grid: each of them sees a
/// straight line.
class RippledScrew final : public Kinematics {
 public:
  explicit RippledScrew(double steepness) : steepness_(steepness) {
    axes_ = {{"x", 2000, 20000}, {"screw", 1500, 4000 * (1 + 20 * steepness)}};
  }
  static constexpr double wave = 2 * 3.14159265358979323846 / 0.625;  // rad/mm: eight periods in an eighth of 40 mm
  const std::vector<AxisLimits>& axes() const override { return axes_; }
  AxisJet inverse(const ToolJet& tool) const override {
    using T = Taylor<3>;
    const Jet& p = tool.position;
    const T x = T::from(p.value.x, p.d1.x, p.d2.x, p.d3.x), q = x + T(steepness_ / wave) * sin(x * T(wave));
    AxisJet jet;
    jet.value[0] = p.value.x, jet.d1[0] = p.d1.x, jet.d2[0] = p.d2.x, jet.d3[0] = p.d3.x;
    jet.value[1] = q.value(), jet.d1[1] = q.derivative(1), jet.d2[1] = q.derivative(2), jet.d3[1] = q.derivative(3);
    return jet;
  }
  ToolPose forward(const AxisArray& q) const override { return {{q[0], 0, 0}}; }
  MapBounds bounds(const ToolPose&, double) const override {
    const double e = std::abs(steepness_);
    MapBounds b;
    b.order[0] = {1, 1 + e}, b.order[1] = {0, e * wave}, b.order[2] = {0, e * wave * wave};
    b.order[3] = {0, e * wave * wave * wave};
    return b;
  }

 private:
  double steepness_;
  std::vector<AxisLimits> axes_;
};

TEST(AxesBound, ARippleThatSamplesDoNotSee) {
  const Contour contour = Maker().line({40, 0}).done();
  for (const double steepness : {0.01, 0.3, 0.9, 3.0}) {
    const RippledScrew kinematics(steepness);
    const Machine machine{kinematics.axes(), 0.001};
    const KinematicAxisPath path(contour.path, kinematics);
    const double low = bound(path, contour, machine), plan = planned(path, contour, machine);
    EXPECT_LE(low, plan * (1 + 1e-9)) << steepness;
    EXPECT_GE(low, plan * (1 - 5e-3)) << steepness << " " << plan / low - 1;
  }
}

/// A coil of so many turns on the vertical winder.
Bound of_turns(int turns) {
  const std::shared_ptr<const Kinematics> winder = test::vertical();
  const Machine machine{winder->axes(), 0.002};
  const test::NeedlePath needle = test::stator_turns(turns);
  const KinematicAxisPath path(needle.tool, *winder, needle.orientation);
  PathTask task{path, machine, std::vector<double>(path.size(), unlimited), std::vector<bool>(path.size() + 1, false)};
  task.rests.front() = task.rests.back() = true;
  Progress silent;
  return lower_bound(task, corner_angle, silent);
}

/// Beyond the ends of a coil each turn takes as long as any other.
double extrapolated(double of_4, double of_8, int turns) { return of_8 + (of_8 - of_4) / 4 * (turns - 8); }

/// What rounding takes from a turn is no more far along the path than at its begin. Where windows part the path, a
/// turn's bound differs by up to 3e-5 from that of others, without a trend.
TEST(AxesBound, TheSameFarAlongThePath) {
  const double whole = extrapolated(of_turns(4).value, of_turns(8).value, 60), found = of_turns(60).value;
  RecordProperty("loss", std::to_string(1 - found / whole));
  EXPECT_GT(found, whole * (1 - 2e-5));
  EXPECT_LT(found, whole * (1 + 1e-4));
}

/// Where a path is parted nothing is known of jerk: each window loses some of the bound, and gains none. A path that is
/// not parted tells what one that is should take.
TEST(AxesBound, LongNeedlePathsInWindowsLoseLittle) {
  const Bound few = of_turns(4), more = of_turns(8), found = of_turns(400);
  const auto of_400 = [](double of_4, double of_8) { return extrapolated(of_4, of_8, 400); };
  const double whole = of_400(few.value, more.value);
  RecordProperty("loss", std::to_string(whole - found.value));
  EXPECT_LT(found.value, whole * (1 + 1e-6));
  EXPECT_GT(found.value, whole * (1 - 1e-3));
  // The node at which two windows meet counts for both.
  const auto nodes = [](const Bound& b) { return std::stod(b.basis.substr(b.basis.find_first_of("0123456789"))); };
  EXPECT_GT(nodes(found), of_400(nodes(few), nodes(more))) << "not parted";
}

/// Central differences of the map along random directions at random places.
TEST(FiveAxesMap, KeepsTheBoundsThatItStates) {
  const test::FiveAxes kinematics;
  const MapBounds bounds = kinematics.bounds({{20, 10, 0}}, 50);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  AxisArray most[4] = {};
  for (int i = 0; i < 20000; ++i) {
    Vec e{uniform(random), uniform(random), uniform(random)};
    const double length = norm(e);
    if (!(length > 0.01)) continue;
    e = e / length;
    const Vec p{20 + 60 * uniform(random), 10 + 60 * uniform(random), 20 * uniform(random)};
    const AxisJet here = kinematics.inverse({{p, e, {}, {}}, {}, {}});
    constexpr double step = 1e-3;
    const AxisJet after = kinematics.inverse({{p + step * e, e, {}, {}}, {}, {}}),
                  before = kinematics.inverse({{p - step * e, e, {}, {}}, {}, {}});
    for (std::size_t k = 0; k < 5; ++k) {
      const double fourth = (after.d3[k] - before.d3[k]) / (2 * step);
      const double size[] = {here.d1[k], here.d2[k], here.d3[k], fourth};
      for (std::size_t n = 0; n < 4; ++n) most[n][k] = std::max(most[n][k], std::abs(size[n]));
    }
  }
  for (std::size_t n = 0; n < 4; ++n)
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_LE(most[n][k], bounds.order[n][k] * (1 + 1e-6) + 1e-10) << "order " << n + 1 << " axis " << k;
    }
}

}  // namespace
}  // namespace bahnwerk
