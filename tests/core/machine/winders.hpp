#pragma once
/// The winding machines of examples/machines, which tests/api/machine_examples_test.cpp compares with these.
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/machine/horizontal_winder.hpp"
#include "core/machine/robot_winder.hpp"
#include "core/machine/vertical_winder.hpp"

namespace bahnwerk::test {

inline Limits linear(double velocity, double acceleration, double jerk, double lowest, double highest) {
  return {velocity, acceleration, jerk, unlimited, lowest, highest};
}
/// From degrees.
inline Limits rotary(double velocity, double acceleration, double jerk, double lowest = -unlimited,
                     double highest = unlimited) {
  const double d = std::numbers::pi / 180;
  return {velocity * d, acceleration * d, jerk * d, unlimited, lowest * d, highest * d};
}

inline RobotWinderSizes robot_sizes() {
  RobotWinderSizes sizes;
  sizes.least_bend = 0.5 * std::numbers::pi / 180;
  return sizes;
}
inline std::vector<Limits> robot_limits() {
  return {rotary(350, 3000, 60000, -140, 140), rotary(450, 4500, 90000, -150, 150),
          linear(2000, 20000, 500000, -100, 300), rotary(1000, 10000, 250000, -400, 400),
          rotary(720, 7000, 180000, -100, 100)};
}
inline std::vector<Limits> vertical_limits() {
  return {linear(2500, 25000, 800000, 250, 700), linear(1500, 15000, 500000, 430, 770),
          rotary(720, 7000, 180000, -100, 100), rotary(720, 6000, 150000), linear(1000, 10000, 300000, 400, 600)};
}
inline std::vector<Limits> horizontal_limits() {
  return {linear(1000, 10000, 300000, -100, 100), linear(1500, 12000, 400000, -250, 250),
          linear(2000, 18000, 600000, -100, 350), rotary(720, 6000, 150000), rotary(720, 7000, 180000, -100, 100)};
}

inline std::shared_ptr<const Kinematics> robot(RobotArm arm) {
  return std::make_shared<const RobotWinder>(robot_sizes(), arm, robot_limits());
}
inline std::shared_ptr<const Kinematics> vertical() {
  return std::make_shared<const VerticalWinder>(VerticalWinderSizes{}, vertical_limits());
}
inline std::shared_ptr<const Kinematics> horizontal() {
  return std::make_shared<const HorizontalWinder>(HorizontalWinderSizes{}, horizontal_limits());
}

/// One machine, in all its configurations.
struct Winder {
  std::string name;
  std::vector<std::shared_ptr<const Kinematics>> configurations;
};
inline std::vector<Winder> winders() {
  return {{"robot", {robot(RobotArm::lefty), robot(RobotArm::righty)}},
          {"vertical", {vertical()}},
          {"horizontal", {horizontal()}}};
}

}  // namespace bahnwerk::test
