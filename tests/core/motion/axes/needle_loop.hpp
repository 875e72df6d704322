#pragma once
/// Paths of a needle for the tests of the winding machines.
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/motion/axes/orientation.hpp"

namespace bahnwerk::test {

struct NeedlePath {
  Path tool;
  std::shared_ptr<const Orientation> orientation;
};

class NeedleMaker {
 public:
  void append(std::shared_ptr<const Curve> curve, std::shared_ptr<const Curve> angles) {
    made_.tool.append(curve, made_.tool.size());
    while (angles_.size() < made_.tool.size()) angles_.push_back(angles);
  }
  NeedlePath done() {
    made_.orientation = std::make_shared<const Orientation>(made_.tool, angles_);
    return std::move(made_);
  }

 private:
  NeedlePath made_;
  std::vector<std::shared_ptr<const Curve>> angles_;
};

/// One turn about two slots of a stator, 45° apart: up the first at radius `radius`, over its winding head with the
/// needle swivelled down, down the second, and back below with the needle swivelled up. Three times continuous in all
/// five coordinates but for the third derivatives at the joints.
inline void append_stator_turn(NeedleMaker& make, double radius, double height, double part_phi) {
  const double span = std::numbers::pi / 4, head = 30, swivel = 1.2;
  const auto at = [&](double azimuth, double r, double z) {
    return Vec{r * std::cos(azimuth + part_phi), r * std::sin(azimuth + part_phi), z};
  };
  const auto angles = [&](double phi0, double phi1, double psi) {  // 10u³ − 15u⁴ + 6u⁵, and 64u³(1 − u)³
    const double d = phi1 - phi0, b = 64 * psi;
    return std::make_shared<Rational>(
        Rational::from_power_basis({{phi0 + part_phi, 0, 0, 10 * d, -15 * d, 6 * d}, {0, 0, 0, b, -3 * b, 3 * b, -b}}));
  };
  const auto slot = [&](double azimuth, double z0, double z1) {
    make.append(std::make_shared<Line>(at(azimuth, radius, z0), at(azimuth, radius, z1)), angles(azimuth, azimuth, 0));
  };
  const auto over = [&](double a0, double a1, double z, double up) {  // three points in line at both ends: curvature 0
    std::vector<Vec> points{at(a0, radius, z),
                            at(a0, radius, z + up * head / 4),
                            at(a0, radius, z + up * head / 2),
                            at(a0 + (a1 - a0) / 3, radius, z + up * head),
                            at(a1 - (a1 - a0) / 3, radius, z + up * head),
                            at(a1, radius, z + up * head / 2),
                            at(a1, radius, z + up * head / 4),
                            at(a1, radius, z)};
    make.append(std::make_shared<Rational>(Rational::bezier(points)), angles(a0, a1, up * swivel));
  };
  slot(0, 0, height);
  over(0, span, height, 1);
  slot(span, height, 0);
  over(span, 0, 0, -1);
}
inline NeedlePath stator_turn(double radius = 80, double height = 180, double part_phi = 0) {
  NeedleMaker make;
  append_stator_turn(make, radius, height, part_phi);
  return make.done();
}
/// So many one after the other: a layer of a coil.
inline NeedlePath stator_turns(int turns) {
  NeedleMaker make;
  for (int i = 0; i < turns; ++i) append_stator_turn(make, 80, 180, 0);
  return make.done();
}

/// A helix of `turns` turns about the z axis, the needle pointing at it: as about all poles of a rotor.
inline NeedlePath helix(double radius, double turns, double rise) {
  NeedleMaker make;
  const double sweep = 2 * std::numbers::pi * turns;
  make.append(std::make_shared<Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, radius, sweep, rise),
              std::make_shared<Line>(Vec{std::numbers::pi, 0, 0}, Vec{std::numbers::pi + sweep, 0, 0}));
  return make.done();
}

}  // namespace bahnwerk::test
