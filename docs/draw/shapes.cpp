#include "docs/draw/shapes.hpp"

#include <cmath>

#include "core/contour/builder.hpp"

namespace bahnwerk::draw {

namespace {

const std::vector<double> weights{1, 0.9, 1.2, 0.9, 1}, knots{0, 0, 0, 0, 0.5, 1, 1, 1, 1};

void hole(ContourBuilder& build, double x, double y) {
  build.block(Mode::position, unlimited);
  build.line({x + 4.5, y, 0});
  build.block(Mode::cut, unlimited);
  build.arc({x + 4.5, y, 0}, {x, y, 0}, true);
}

void window_segments(ContourBuilder& build) {
  build.line({78, 32, 0});
  build.nurbs(3, {{78, 32, 0}, {84, 32, 0}, {88, 36, 0}, {84, 42, 0}, {80, 46, 0}}, weights, knots);
  build.polynomial({{80, -18}, {46, 18, 6, -10}});
  build.line({58, 60, 0});
  build.polynomial({{58, -18}, {60, 0, -24, 10}});
  build.nurbs(3, {{40, 46, 0}, {36, 42, 0}, {32, 36, 0}, {36, 32, 0}, {42, 32, 0}}, weights, knots);
  build.line({60, 32, 0});
}

void slot(ContourBuilder& build) {
  build.line({80, 11, 0});
  build.arc({80, 19, 0}, {80, 15, 0}, true);
  build.line({40, 19, 0});
  build.arc({40, 11, 0}, {40, 15, 0}, true);
  build.line({60, 11, 0});
}

void outline(ContourBuilder& build) {
  build.line({112, 0, 0});
  build.arc({120, 8, 0}, {112, 8, 0}, true);
  build.line({120, 72, 0});
  build.arc({112, 80, 0}, {112, 72, 0}, true);
  for (const Vec to : {Vec{66, 80, 0}, Vec{66, 76, 0}, Vec{54, 76, 0}, Vec{54, 80, 0}, Vec{8, 80, 0}}) build.line(to);
  build.arc({0, 72, 0}, {8, 72, 0}, true);
  build.line({0, 8, 0});
  build.arc({8, 0, 0}, {8, 8, 0}, true);
  build.line({60, 0, 0});
}

void cut(ContourBuilder& build, Vec from, void (*segments)(ContourBuilder&)) {
  build.block(Mode::position, unlimited);
  build.line(from);
  build.block(Mode::cut, unlimited);
  segments(build);
}

}  // namespace

Machine machine() {
  Machine m;
  m.axes = {{"x", 1800, 16000, unlimited}, {"y", 1800, 16000, unlimited}};
  return m;
}

Machine smooth_machine() {
  Machine m;
  m.axes = {{"x", 300, 8000, 8e5}, {"y", 300, 8000, 8e5}};
  return m;
}

Contour circle(double radius, double run_in, double feed) {
  ContourBuilder build(2, {0, 0, 0});
  build.block(Mode::cut, feed);
  build.line({run_in, 0, 0});
  build.arc({run_in, 0, 0}, {run_in, radius, 0}, true);
  build.line({2 * run_in, 0, 0});
  return build.finish();
}

Contour window() {
  ContourBuilder build(2, {60, 32, 0});
  build.block(Mode::cut, unlimited);
  window_segments(build);
  return build.finish();
}

Contour bracket() {
  ContourBuilder build(2, {0, 0, 0});
  hole(build, 15, 15);
  hole(build, 105, 15);
  hole(build, 105, 65);
  hole(build, 15, 65);
  cut(build, {60, 11, 0}, slot);
  cut(build, {60, 32, 0}, window_segments);
  cut(build, {60, 0, 0}, outline);
  build.block(Mode::position, unlimited);
  build.line({0, 0, 0});
  return build.finish();
}

Contour plate() {
  ContourBuilder build(2, {6, 0, 0});
  build.block(Mode::cut, unlimited);
  for (const Vec to : {Vec{17, 0, 0}, Vec{20, 3, 0}, Vec{20, 12, 0}, Vec{14.5, 12, 0}, Vec{12.5, 7, 0},
                       Vec{10.5, 12, 0}, Vec{8, 12, 0}})
    build.line(to);
  constexpr int chords = 24;
  for (int i = 1; i <= chords; ++i) {
    const double t = 1.5707963267948966 * i / chords;
    build.line({8 - 8 * std::sin(t), 5 + 7 * std::cos(t), 0});
  }
  build.line({0, 2, 0});
  build.arc({2, 0, 0}, {2, 2, 0}, true);
  build.line({6, 0, 0});
  return build.finish();
}

Contour corner(double angle) {
  const double x = std::cos(0.5 * angle), y = -std::sin(0.5 * angle);
  ContourBuilder build(2, {-x, y, 0});
  build.block(Mode::cut, unlimited);
  build.line({0, 0, 0});
  build.line({x, y, 0});
  return build.finish();
}

}  // namespace bahnwerk::draw
