#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/contour/blend.hpp"
#include "core/motion/profile/profile.hpp"
#include "docs/draw/colours.hpp"
#include "docs/draw/map.hpp"
#include "docs/draw/pictures.hpp"
#include "docs/draw/plans.hpp"
#include "docs/draw/shapes.hpp"

namespace bahnwerk::draw {

namespace {

constexpr double plate_tolerance = 0.2, corner_tolerance = 0.05;  // mm
constexpr double corner_turn = 1.5707963267948966;

/// Curvature over path length, from `from` to `to`, zero in the middle of them.
Line curvature(const Contour& contour, double from, double to) {
  constexpr int steps = 2000;
  Line line;
  for (int i = 0; i <= steps; ++i) {
    const double s = from + (to - from) * i / steps;
    line.push_back({s - 0.5 * (from + to), norm(contour.path.at(s).d2)});
  }
  return line;
}

/// Acceleration of a straight move over time.
Line acceleration(const Profile& move) {
  Line line;
  for (const ProfilePiece& p : move.pieces())
    for (int i = 0; i <= 40; ++i) line.push_back({p.t0 + p.duration * i / 40, p.at(p.duration * i / 40).a});
  return line;
}

Line speed(const Profile& move) {
  Line line;
  for (const ProfilePiece& p : move.pieces())
    for (int i = 0; i <= 40; ++i) line.push_back({p.t0 + p.duration * i / 40, p.at(p.duration * i / 40).v});
  return line;
}

}  // namespace

void straight_moves(const std::string& file) {
  constexpr double length = 20, from = 0, to = 60;  // mm, mm/s
  const Profile trapezoid = straight_profile(length, from, to, {300, 8000, unlimited, unlimited}),
                double_s = straight_profile(length, from, to, {300, 8000, 8e5, unlimited}),
                snap = straight_profile(length, from, to, {300, 8000, 8e5, 1.2e8});
  const Range time{0, snap.duration * 1.02};
  Chart v({"20 mm from rest to 60 mm/s: speed", "", "v, mm/s", time, {0, 340}, 800, 250});
  v.line(speed(trapezoid), grey, milliseconds("trapezoid", trapezoid.duration));
  v.line(speed(double_s), orange, milliseconds("double-S", double_s.duration));
  v.line(speed(snap), blue, milliseconds("snap-limited", snap.duration));
  Chart a({"Acceleration", "time t, s", "a, mm/s²", time, {-9000, 9000}, 800, 250, false, 24, "lower", false});
  a.line(acceleration(trapezoid), grey);
  a.line(acceleration(double_s), orange);
  a.line(acceleration(snap), blue);
  Chart::save(file, {v, a});
}

void plate_in_colour(const std::string& file) {
  constexpr double fastest = 350;
  const Machine m = smooth_machine();
  const Contour given = plate(), round = rounded(given, plate_tolerance, m);
  const TimeLaw law = plan_smooth(round, m);
  Chart chart({milliseconds("A plate rounded within 0.2 mm, jerk_limited:", law.duration()),
               "x, mm",
               "y, mm",
               {-1, 21},
               {-1, 13},
               800,
               0,
               true,
               96});
  coloured_cuts(chart, round, law, fastest, 5);
  plain(chart, given, {"#111111", 1, "", 1, false},
        milliseconds("as given; resting at each corner", plan_smooth(given, m).duration()));
  chart.colour_bar({0, fastest}, "v, mm/s");
  chart.save(file);
  for (const std::string& note : round.notes) std::printf("%s: %s\n", file.c_str(), note.c_str());
}

void use_on_plate(const std::string& file) {
  const Machine m = smooth_machine();
  const Contour round = rounded(plate(), plate_tolerance, m);
  const TimeLaw sharp = plan(round, m, false).law, smooth = plan_smooth(round, m);
  const Range time{0, std::max(sharp.duration(), smooth.duration())};
  std::vector<Chart> charts;
  const auto panel = [&](const std::string& title, const std::string& label, Quantity quantity, double most,
                         const std::string& id) {
    const bool first = charts.empty(), last = quantity == Quantity::jerk;
    Chart& chart = charts.emplace_back(Chart::Frame{
        title, last ? "time t, s" : "", label, time, {0, most}, 800, last ? 230.0 : 200.0, false, 24, id, first});
    chart.line({{time.from, 1}, {time.to, 1}}, {"#444444", 1, "4 3", 1, false});
    chart.line(largest_use(motion(round, sharp), m, quantity), {orange.colour, 1.4, "", 0.9, false},
               first ? milliseconds("time_optimal", sharp.duration()) : "");
    chart.line(largest_use(motion(round, smooth), m, quantity), {blue.colour, 1.8, "", 1, false},
               first ? milliseconds("jerk_limited", smooth.duration()) : "");
  };
  panel("How much of its limits the busiest axis uses: velocity", "|v_k| / V_k", Quantity::velocity, 1.2, "velocity");
  panel("Acceleration", "|a_k| / A_k", Quantity::acceleration, 1.2, "acceleration");
  panel("Jerk", "|j_k| / J_k", Quantity::jerk, 2, "jerk");
  Chart::save(file, charts);
  double most = 0;
  for (const Point& p : largest_use(motion(round, sharp), m, Quantity::jerk)) most = std::max(most, p.y);
  std::printf("%s: time_optimal uses up to %.0f times the jerk limit\n", file.c_str(), most);
}

void corner_enlarged(const std::string& file) {
  const Contour given = corner(corner_turn), round = rounded(given, corner_tolerance, machine());
  const double length = round.path.length(), off = -round.path.at(0.5 * length).value.y;
  // The circle that passes as near to the corner as the blend does.
  const double radius = off / (1 / std::cos(0.5 * corner_turn) - 1), half_arc = 0.5 * corner_turn * radius;
  Line arc;
  for (int i = -60; i <= 60; ++i) {
    const double angle = 0.5 * corner_turn * i / 60;
    arc.push_back({radius * std::sin(angle), radius * std::cos(angle) - off - radius});
  }
  Chart map({"A right angle rounded within 0.05 mm", "x, mm", "y, mm", {-0.28, 0.28}, {-0.25, 0.09}, 800, 0, true});
  const Vec begin = given.path.at(0).value, end = given.path.at(given.path.length()).value;
  map.tube({{begin.x, begin.y}, {0, 0}, {end.x, end.y}}, corner_tolerance, "#d3e0f4", "tolerance");
  plain(map, given, {"#111111", 1, "", 1, false}, "as given");
  map.line(arc, orange, "circle");
  plain(map, round, blue, "blend");
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {  // where the blend begins and ends
    const PathPoint at = round.path.at(round.path[i].s0());
    const Vec tick = 0.008 * Vec{-at.d1.y, at.d1.x, 0}, a = at.value - tick, b = at.value + tick;
    map.line({{a.x, a.y}, {b.x, b.y}}, {blue.colour, 1.4, "", 1, false});
  }
  map.note({0.15, -0.136}, "end of the blend", "start");
  const Line bend = curvature(round, 0, length);
  Chart chart({"Curvature along both",
               "path length from the middle, mm",
               "|h″|, 1/mm",
               {-0.28, 0.28},
               {0, 13},
               800,
               250,
               false,
               24,
               "lower",
               false});
  chart.line({{-0.28, 0}, {-half_arc, 0}, {-half_arc, 1 / radius}, {half_arc, 1 / radius}, {half_arc, 0}, {0.28, 0}},
             orange);
  chart.line(bend, blue);
  Chart::save(file, {map, chart});
  double most = 0;
  for (const Point& p : bend) most = std::max(most, p.y);
  std::printf("%s: %.4f mm off the corner, blend of %.4f mm, peak curvature %.2f, circle %.2f per mm\n", file.c_str(),
              off, round.path[1].length(), most, 1 / radius);
}

}  // namespace bahnwerk::draw
