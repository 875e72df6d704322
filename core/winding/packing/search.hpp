#pragma once
/// The search for one number of wires: starts, then basin hopping from the best of them [Wales, Doye: Global
/// optimization by basin-hopping, 1997; Grosso et al.: Solving the problem of packing equal and unequal circles in a
/// circular container, 2010].
#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/packing/overlap_energy.hpp"
#include "core/winding/packing/starts.hpp"

namespace bahnwerk::winding {

class PackingSearch {
 public:
  /// `distance` between centres, mm.
  PackingSearch(const CentreArea& usable_area, double distance, std::uint64_t seed, Progress progress);

  /// Returns `count` wires, or nothing after `work` (OverlapEnergy::work) or `tries` minimisations. `likely` are
  /// layouts of any number of wires for the start.
  std::optional<std::vector<Point>> find(std::size_t count, std::span<const std::vector<Point>> likely,
                                         std::uint64_t work, std::size_t tries);
  /// Adds wires to an allowed layout as long as one fits into its holes.
  void fill(std::vector<Point>& wires);

  /// Sets the fraction of the progress that the next tries reach.
  void set_reach(double fraction) { reach_ = fraction; }
  Random& random() { return random_; }
  const std::vector<Side>& sides() const { return sides_; }

 private:
  struct State {
    std::vector<Point> wires;
    double energy = 0;
    bool allowed = false;
    std::size_t idle = 0;  ///< hops since the last improvement
  };
  /// Reports the progress of the longest try in every stage.
  class Steady final : public ProgressSink {
   public:
    explicit Steady(Progress to) : to_(to) {}
    void report(std::string_view stage, double = 0, std::string_view message = {}) override {
      to_.report(stage, fraction_, message);
    }
    void reach(double fraction) { fraction_ = std::clamp(fraction, fraction_, 1.0); }

   private:
    Progress to_;
    double fraction_ = 0;
  };
  /// Removes the wires with the largest overlap, or fills holes, until there are `count`.
  void adjust(std::vector<Point>& wires, std::size_t count);
  State settled(std::vector<Point> wires, double goal);
  std::vector<Point> start(std::size_t count);
  std::vector<Point> hop(const State& from);
  /// Returns points of the usable area by their distance from the nearest wire, widest first, at most `most`, not near
  /// each other.
  std::vector<Point> holes(std::span<const Point> wires, std::size_t most);

  const CentreArea& usable_area_;
  OverlapEnergy energy_;
  Minimiser minimiser_;
  Random random_;
  Steady progress_;
  std::vector<Side> sides_;
  std::vector<Point> pool_;
  Point low_;
  double side_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> first_;  ///< first of the pool's points in each cell
  std::size_t settled_ = 0;
  double reach_ = 1;
  std::vector<double> clearance_, share_;
};

}  // namespace bahnwerk::winding
