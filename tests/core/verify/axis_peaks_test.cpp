// The verifier on axes that are not the tool's coordinates, and on peaks that samples do not show.
#include "core/verify/law/axis_peaks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/motion/axes/bow.hpp"
#include "tests/core/motion/axes/five_axes.hpp"
#include "tests/core/verify/law/random_rational.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::law_through;
using reference::Maker;
using test::bow;

enum class Method { time_optimal, braking_reserve, jerk_limited };

TimeLaw planned(const PathTask& task, Method method) {
  Progress progress;
  if (method == Method::jerk_limited) return plan_jerk_limited(task, {}, progress).law;
  AccelerationLimitedOptions options;
  options.keep_reserve = method == Method::braking_reserve;
  return plan_acceleration_limited(task, options, progress).law;
}

Verification verdict(const AxisPath& path, const Contour& contour, const Machine& machine, const TimeLaw& law,
                     int order) {
  Progress progress;
  return verify_motion({path, machine, law, contour.feeds(), contour.rest_places(), 1e-3, order}, progress);
}

std::string failed(const Verification& v) {
  std::string text;
  for (const Check& c : v.checks)
    if (!c.passed) text += check_name(c) + ' ' + std::to_string(c.value) + " > " + std::to_string(c.limit) + "; ";
  return text;
}

/// The limit that a check of an axis is about.
double& limit_of(Machine& machine, const Check& check) {
  for (AxisLimits& axis : machine.axes)
    if (axis.name == check.subject) return axis.of(check.order);
  throw std::logic_error("no axis of that name");
}

/// A planned law, slowed by what its planner's own tolerance leaves, passes; with the limit that it uses most a
/// millionth below its peak it fails in that check alone.
void passes_and_fails(const AxisPath& path, const Contour& contour, Machine machine, Method method) {
  const int order = method == Method::jerk_limited ? 3 : 2;
  TimeLaw law = planned(contour_task(path, contour, machine), method);
  const auto largest_use = [&](const Verification& v) {
    const auto axes = static_cast<std::ptrdiff_t>(order) * static_cast<std::ptrdiff_t>(machine.axes.size());
    return *std::max_element(v.checks.begin(), v.checks.begin() + axes,
                             [](const Check& a, const Check& b) { return a.value / a.limit < b.value / b.limit; });
  };
  const Check before = largest_use(verdict(path, contour, machine, law, order));
  EXPECT_LE(before.value / before.limit, 1 + 1e-8) << check_name(before);
  law = law.slowed(std::max(1.0, before.value / before.limit));
  const Verification v = verdict(path, contour, machine, law, order);
  EXPECT_TRUE(v.passed) << failed(v);
  const Check most = largest_use(v);
  EXPECT_GE(most.value / most.limit, 1 - 1e-3) << check_name(most);
  limit_of(machine, most) = most.value * (1 - 1e-6);
  const Verification w = verdict(path, contour, machine, law, order);
  EXPECT_FALSE(w.passed);
  for (const Check& c : w.checks) EXPECT_EQ(c.passed, check_name(c) != check_name(most)) << check_name(c);
}

TEST(VerifierAxes, FiveAxesByEveryPlanner) {
  const Contour contour = bow();
  const test::FiveAxes kinematics;
  const KinematicAxisPath path(contour.path, kinematics);
  for (const Method method : {Method::time_optimal, Method::braking_reserve, Method::jerk_limited}) {
    SCOPED_TRACE(static_cast<int>(method));
    passes_and_fails(path, contour, {kinematics.axes(), 0.001}, method);
  }
}

/// x alone, along a curve on which it never stands still.
TEST(VerifierAxes, OneAxisByEveryPlanner) {
  ContourBuilder b(2, {});
  b.polynomial({{0, 60, 10, -5}, {0, 5, 40, -25}});
  const Contour contour = b.finish();
  const CartesianAxisPath path(contour.path, 1);
  Machine machine;
  machine.axes = {{"x", 900, 9000, 600000}};
  for (const Method method : {Method::time_optimal, Method::braking_reserve, Method::jerk_limited}) {
    SCOPED_TRACE(static_cast<int>(method));
    passes_and_fails(path, contour, machine, method);
  }
}

std::size_t estimated(const AxisPath& path, const Contour& contour, const Machine& machine, const TimeLaw& law) {
  Progress progress;
  ProgressScope stage_progress(progress, "verify");
  return verify::axis_peaks({path, machine, law, contour.feeds(), contour.rest_places(), 1e-3, 3}, stage_progress)
      .estimated;
}

/// Where curve and machine state how they grow, nothing is left to estimates; a machine that does not is served, too.
TEST(VerifierAxes, PeaksOfFiveAxesAreProvenOrToldFrom) {
  struct Silent final : test::FiveAxes {
    MapBounds complex_bounds(const ToolPose& c, double r) const override { return Kinematics::complex_bounds(c, r); }
  };
  const Contour contour = bow();
  const test::FiveAxes five;
  const Silent silent;
  const KinematicAxisPath path(contour.path, five), same(contour.path, silent);
  const Machine machine{five.axes(), 0.001};
  for (const Method method : {Method::time_optimal, Method::jerk_limited}) {
    const TimeLaw law = planned(contour_task(path, contour, machine), method);
    EXPECT_EQ(estimated(path, contour, machine, law), 0u);
    EXPECT_GT(estimated(same, contour, machine, law), 0u);
    const Verification proven = verdict(path, contour, machine, law, 3),
                       guessed = verdict(same, contour, machine, law, 3);
    for (std::size_t i = 0; i < proven.checks.size(); ++i)
      // Peaks are resolved to 2e-11 of themselves where they exceed the limit, as jerk does that is not limited.
      EXPECT_NEAR(proven.checks[i].value, guessed.checks[i].value,
                  1e-9 * proven.checks[i].limit + 2e-11 * proven.checks[i].value + 1e-12);
  }
}

/// What the made-up machine states of complex tool positions holds: derivatives along random complex directions, by
/// Cauchy's formula on a small circle.
TEST(VerifierAxes, TheMadeUpMachinesComplexBoundsHold) {
  using Complex = std::complex<double>;
  using F = test::FiveAxes;
  const auto inverse = [](const std::array<Complex, 3>& tool) {
    const Complex x = tool[0] - F::base_x, y = tool[1] - F::base_y, z = tool[2];
    const Complex bend = std::acos((x * x + y * y) / (2 * F::arm * F::arm) - 1.0);
    return std::array<Complex, 5>{M_PI / 2 - std::atan(x / y) - 0.5 * bend, bend, 0.6 * x + 0.8 * y + z,
                                  std::atan((z + 60.0) / (80.0 + 0.2 * x)),
                                  x + F::error * std::sin(x * (2 * M_PI / F::period))};
  };
  const F machine;
  const Contour contour = bow();
  const AxisJet real = KinematicAxisPath(contour.path, machine).at(1, contour.path[1].s0() + 3);
  const Vec there = contour.path[1].at(contour.path[1].s0() + 3).value;
  const auto again = inverse({there.x, there.y, there.z});
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(again[k].real(), real.value[k], 1e-12) << k;

  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 2000; ++round) {
    const Vec centre = contour.path.at(contour.path.length() * uniform(random)).value;
    const double radius = 15 * uniform(random);
    std::array<Complex, 3> off, e;
    double n0 = 0, n1 = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      off[i] = {normal(random), normal(random)}, e[i] = {normal(random), normal(random)};
      n0 += std::norm(off[i]), n1 += std::norm(e[i]);
    }
    const double h = 0.5;
    std::array<std::array<Complex, 5>, 4> d{};  // ∂ⁿq/∂eⁿ = n!/(m hⁿ) Σ q(x + h ωʲ e) ω⁻ʲⁿ
    for (int j = 0; j < 32; ++j) {
      const Complex turn = std::polar(1.0, 2 * M_PI * j / 32);
      std::array<Complex, 3> tool;
      for (std::size_t i = 0; i < 3; ++i)
        tool[i] = centre[i] + off[i] * (radius / std::sqrt(n0)) + h * turn * e[i] / std::sqrt(n1);
      const auto q = inverse(tool);
      double factorial = 1;
      for (int n = 1; n <= 3; ++n) {
        factorial *= n;
        for (std::size_t k = 0; k < 5; ++k) d[n][k] += q[k] * factorial / (32 * std::pow(h, n)) * std::pow(turn, -n);
      }
    }
    const MapBounds stated = machine.complex_bounds({centre}, radius);
    for (int n = 1; n <= 3; ++n)
      for (std::size_t k = 0; k < 5; ++k)
        EXPECT_LE(std::abs(d[n][k]), stated.order[n - 1][k] + 1e-10) << n << " of " << k;
    if (HasFailure()) FAIL() << round;
  }
}

/// Where the parametric tangent vanishes the curvature has a pole and the motion rests: proven all the same.
TEST(VerifierAxes, PeaksNextToAVanishingTangentAreProven) {
  for (const bool at_end : {false, true}) {
    Maker make;
    at_end ? make.bezier({{20, 9}, {40, 0}, {40, 0}}) : make.bezier({{0, 0}, {20, 9}, {40, 0}});
    const Contour contour = make.done();
    const Segment& segment = contour.path[0];
    ASSERT_EQ(contour.path.size(), 1u);
    ASSERT_TRUE(at_end ? segment.cusp_end() : segment.cusp_begin());
    const double length = contour.path.length();
    const TimeLaw law = law_through(contour.path, {{0, 0}, {0.5 * length, 70}, {length, 0}});
    std::array<double, 6> dense{};
    std::vector<double> places{segment.parameter_at(0.5 * length * (1 - 1e-12)),
                               segment.parameter_at(0.5 * length * (1 + 1e-12))};
    for (int i = 0; i <= 40000; ++i)
      places.push_back(at_end ? 1 - std::pow(10, -i / 4000.0) : std::pow(10, -i / 4000.0));
    for (const double u : places) {
      const double s = segment.travelled(u);
      const LawPiece& p = law.pieces()[s > 0.5 * length];
      const double b = p.v * p.v + 2 * p.a * (s - p.s), v = std::sqrt(std::max(b, 0.0));
      const PathPoint h = segment.at_parameter(u);
      for (std::size_t k = 0; k < 2; ++k) {
        dense[k] = std::max(dense[k], std::abs(h.d1[k]) * v);
        dense[2 + k] = std::max(dense[2 + k], std::abs(h.d2[k] * b + h.d1[k] * p.a));
        if (b > 1e-6)  // beside, b is a difference of larger numbers
          dense[4 + k] = std::max(dense[4 + k], v * std::abs(h.d3[k] * b + 3 * h.d2[k] * p.a));
      }
    }
    Machine machine;
    machine.axes = {{"x", dense[0], dense[2], dense[4]}, {"y", dense[1], dense[3], dense[5]}};
    const CartesianAxisPath path(contour.path, 2);
    EXPECT_EQ(estimated(path, contour, machine, law), 0u);
    const Verification v = verdict(path, contour, machine, law, 3);
    for (std::size_t c = 0; c < 6; ++c) {
      EXPECT_GE(v.checks[c].value, dense[c] * (1 - 1e-9)) << check_name(v.checks[c]);
      EXPECT_LE(v.checks[c].value, dense[c] * (1 + 1e-6)) << check_name(v.checks[c]);
    }
  }
}

/// The fifth axis counts as the first does, with its own unit and name.
TEST(VerifierAxes, NoAxisIsLeftOut) {
  const Contour contour = bow();
  const test::FiveAxes kinematics;
  const KinematicAxisPath path(contour.path, kinematics);
  const Machine machine{kinematics.axes(), 0.001};
  const TimeLaw law = planned(contour_task(path, contour, machine), Method::jerk_limited).slowed(1.001);
  for (std::size_t k = 0; k < 5; ++k)
    for (int order = 1; order <= 3; ++order) {
      Machine less = machine;
      AxisLimits& axis = less.axes[k];
      axis.of(order) *= 1e-3;
      const Verification v = verdict(path, contour, less, law, 3);
      const Check* check = v.find(quantity::axis, order, axis.name);
      ASSERT_NE(check, nullptr) << order << k;
      EXPECT_FALSE(check->passed) << check_name(*check);
      EXPECT_EQ(check->unit, k == 0 || k == 1 || k == 3 ? "rad" : "mm") << check_name(*check);
    }
}

TEST(VerifierAxes, MismatchedInputsAreRefused) {
  const Contour contour = bow();
  const CartesianAxisPath path(contour.path, 2);
  const Machine three = reference::machine(3, 1, 1);
  const Machine two = reference::machine(2, 1, 1);
  Progress progress;
  const TimeLaw law;
  EXPECT_THROW(verify_motion({path, three, law, contour.feeds(), contour.rest_places()}, progress),
               std::invalid_argument);
  EXPECT_THROW(verify_motion({path, two, law, {}, contour.rest_places()}, progress), std::invalid_argument);
  EXPECT_THROW(verify_motion({path, two, law, contour.feeds(), {}}, progress), std::invalid_argument);
  Machine four = three;
  four.axes.push_back({"a", 1, 1});
  EXPECT_THROW(verify_motion({contour, four, law}, progress), std::invalid_argument);
}

/// y′ ∝ 1 − T₁₆ vanishes at all of 5 and of 9 Chebyshev points, and is so faint that the arc length does not show it.
TEST(VerifierAxes, APeakThatAliasesOnTheSamplesIsSeen) {
  const double length = 100, faint = 3e-6;
  const int n = 16;
  const auto binomial = [](int a, int b) {
    double r = 1;
    for (int i = 1; i <= b; ++i) r = r * (a - b + i) / i;
    return r;
  };
  std::vector<Vec> points;
  double y = 0;
  for (int i = 0; i <= n; ++i) {  // T₁₆ in Bernstein form, then integrated
    y += faint * length * (1 - (i % 2 ? -1 : 1) * binomial(2 * n, 2 * i) / binomial(n, i)) / (n + 1);
    points.push_back({10 + length * (i + 1) / (n + 1), y, 0});
  }
  const double end = points.back().y;
  const Contour contour = Maker().line({10, 0}).bezier(points).line({20 + length, end}).done();
  const double s1 = contour.path[1].s0(), s2 = contour.path[1].s1(), v = 1000;
  const TimeLaw law = law_through(contour.path, {{0, 0}, {s1, v}, {s2, v}, {contour.path.length(), 0}});
  Machine machine;
  machine.axes = {{"x", 2000}, {"y", 1.9 * faint * v}};
  Progress progress;
  const Verification verification = verify_motion({contour, machine, law, 1e-3}, progress);
  EXPECT_NEAR(verification.checks[1].value, 2 * faint * v, 1e-6 * faint * v);
  EXPECT_FALSE(verification.passed);
}

/// Peaks are never below a dense search, and above it by rounding and resolution alone.
TEST(VerifierAxes, PeaksOnRandomRationalsEncloseTheDenseOnes) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 60; ++round) {
    Contour contour;
    contour.path.append(std::make_shared<Rational>(test::random_rational(random, round)), 0);
    contour.blocks.push_back({Mode::cut, unlimited, 0, contour.path.size()});
    if (contour.path.size() != 1 || contour.path[0].cusp_begin() || contour.path[0].cusp_end()) continue;
    const double length = contour.path.length();
    std::vector<reference::Stop> stops{{0, 0}};
    for (int k = 1; k < 6; ++k) stops.push_back({length * k / 6, 20 + 80 * uniform(random)});
    stops.push_back({length, 0});
    TimeLaw law = law_through(contour.path, stops);
    const bool jerk = round % 2;
    if (jerk) {  // the same with jerk and snap; joints need not be smooth
      TimeLaw other;
      for (LawPiece p : law.pieces()) {
        const double v1 = p.v + p.a * p.duration, h = p.duration, dv = v1 - p.v;
        p.a = 0, p.j = 6 * dv / (h * h), p.snap = -2 * p.j / h;
        other.append(p);
      }
      law = other;
    }
    const Segment& segment = contour.path[0];
    const auto channels = [&](double u) {
      const double s = segment.travelled(u);
      std::size_t i = 0;
      while (i + 1 < law.pieces().size() && law.pieces()[i].s_end < s) ++i;
      const LawPiece& p = law.pieces()[i];
      double low = 0, high = p.duration;
      for (int k = 0; k < 60; ++k) (p.at(0.5 * (low + high)).s < s ? low : high) = 0.5 * (low + high);
      const LawState x = p.at(s >= p.s_end ? p.duration : low);  // at rest s hardly tells the time
      const PathPoint h = segment.at_parameter(u);
      std::array<double, 6> f;
      for (std::size_t k = 0; k < 2; ++k) {
        f[k] = std::abs(h.d1[k] * x.v);
        f[2 + k] = std::abs(h.d2[k] * x.v * x.v + h.d1[k] * x.a);
        f[4 + k] = std::abs(h.d3[k] * x.v * x.v * x.v + 3 * h.d2[k] * x.v * x.a + h.d1[k] * x.j);
      }
      return f;
    };
    // Even in the parameter, and ever denser about the place where the curve is slowest.
    const auto narrowed = [](double low, double high, const auto& f) {  // f is largest there
      for (int i = 0; i < 80; ++i) {
        const double p = low + (high - low) * 0.382, q = low + (high - low) * 0.618;
        (f(p) > f(q) ? high : low) = f(p) > f(q) ? q : p;
      }
      return 0.5 * (low + high);
    };
    std::vector<double> places;
    double slowest = 0;
    for (int i = 0; i <= 3000; ++i) {
      places.push_back(i / 3000.0);
      if (segment.curve().speed(places.back()) < segment.curve().speed(slowest)) slowest = places.back();
    }
    slowest = narrowed(std::max(0.0, slowest - 1 / 3000.0), std::min(1.0, slowest + 1 / 3000.0),
                       [&](double u) { return -segment.curve().speed(u); });
    for (int i = -1200; i <= 1200; ++i)
      places.push_back(std::clamp(slowest + (i < 0 ? -1 : 1) * 0.1 * std::pow(10, -std::abs(i) / 150.0), 0.0, 1.0));
    for (const LawPiece& p : law.pieces())  // where acceleration jumps
      for (const double part : {-1e-12, 1e-12}) places.push_back(segment.parameter_at(p.s_end * (1 + part)));
    std::sort(places.begin(), places.end());
    std::vector<std::array<double, 6>> at;
    for (const double u : places) at.push_back(channels(u));
    std::array<double, 6> dense{};
    for (std::size_t c = 0; c < 6; ++c) {
      const auto best =
          std::max_element(at.begin(), at.end(), [c](const auto& f, const auto& g) { return f[c] < g[c]; });
      const auto i = static_cast<std::size_t>(best - at.begin());
      const double u = narrowed(places[i > 0 ? i - 1 : 0], places[std::min(i + 1, places.size() - 1)],
                                [&](double x) { return channels(x)[c]; });
      dense[c] = std::max((*best)[c], channels(u)[c]);
    }
    // Limits as large as what there is: the resolution is a part of them.
    Machine machine;
    machine.axes = {{"x", dense[0], dense[2], dense[4]}, {"y", dense[1], dense[3], dense[5]}};
    Progress progress;
    const Verification v = verify_motion({contour, machine, law, 1e-3, 3}, progress);
    const CartesianAxisPath path(contour.path, 2);
    EXPECT_EQ(estimated(path, contour, machine, law), 0u) << round;
    for (std::size_t c = 0; c < 6; ++c) {
      EXPECT_GE(v.checks[c].value, dense[c] * (1 - 1e-12))
          << round << ' ' << check_name(v.checks[c]) << ' ' << v.checks[c].value / dense[c] - 1;
      EXPECT_LE(v.checks[c].value, dense[c] * (1 + 1e-9))
          << round << ' ' << check_name(v.checks[c]) << ' ' << v.checks[c].value / dense[c] - 1;
    }
  }
}

}  // namespace
}  // namespace bahnwerk
