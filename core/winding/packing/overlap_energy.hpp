#pragma once
/// Elastic repulsion of overlapping wires: E = Σ ½ (d − |pᵢ − pⱼ|)² over pairs nearer than d, and Σ ½ |depth|² over
/// centres outside their usable area, with one stiffness. The force vanishes at contact, so touching wires are at rest;
/// the Coulomb force of [Herrmann (4.5)] jumps there and has no rest. E = 0 if and only if the layout is allowed.
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/winding/packing/centre_area.hpp"

namespace bahnwerk::winding {

class OverlapEnergy {
 public:
  /// `distance` is the least distance of centres, mm.
  OverlapEnergy(const CentreArea& usable_area, double distance) : usable_area_(usable_area), distance_(distance) {}

  const CentreArea& usable_area() const { return usable_area_; }
  double distance() const { return distance_; }
  /// Sets the distance, for the growth of wires at the beginning of a search.
  void set_distance(double distance) {
    distance_ = distance;
    listed_.clear();
  }

  /// Returns the energy and sets `gradient` to its derivative; `deepest` is the largest overlap, mm.
  double energy(std::span<const Point> wires, std::span<Point> gradient, double& deepest);
  /// Computes the energy of each wire in its overlaps.
  void share(std::span<const Point> wires, std::vector<double>& of_each);
  /// Returns the work done so far, in units of about a nanosecond; unlike a clock it is reproducible.
  std::uint64_t work() const { return work_; }
  void add_work(std::uint64_t more) { work_ += more; }

 private:
  void list(std::span<const Point> wires);

  const CentreArea& usable_area_;
  double distance_;
  std::vector<Point> listed_;  ///< places of the wires when the pairs were listed
  struct Pair {
    std::uint32_t a, b;
  };
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> start_, member_, cell_of_;
  std::uint64_t work_ = 0;
};

struct Rest {
  double energy = 0;
  bool allowed = false;  ///< overlaps at most `resolution`
};
constexpr double resolution = 4e-10;  ///< mm; smaller overlaps count as contact

/// Moves the wires to a local minimum of the energy by L-BFGS with limited steps [Nocedal, Wright: Numerical
/// Optimization, 7.2]. Stops where forces balance or nothing overlaps, after `most` steps, or when the energy will
/// hardly fall below `goal`.
class Minimiser {
 public:
  Rest minimise(OverlapEnergy& overlap, std::vector<Point>& wires, double goal, int most, Progress progress);

 private:
  static constexpr std::size_t memory = 5;
  std::vector<Point> gradient_, trial_, trial_gradient_, direction_;
  std::vector<Point> step_[memory], change_[memory];
  double weight_[memory] = {};
};

}  // namespace bahnwerk::winding
