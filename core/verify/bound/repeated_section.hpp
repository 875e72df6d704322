#pragma once
/// Recognises a section that is an earlier one at another place, and bounds the effect of the rounding of coordinates
/// on its duration, so that one bound serves both.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/rough_shape.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk::verify {

/// Segments [b, b + n) as a repetition of [a, a + n).
struct Repetition {
  std::size_t a, b, n;
};

/// Returns an η such that no motion along segments [b, b + n), from rest to rest within the limits, is shorter than 1 −
/// η times the shortest one along [a, a + n); infinite if the two do not match, or this cannot be decided. Cartesian
/// axes only. O(n); reports to `progress`.
///
/// The argument: free-form curves have to be translates of each other, to the last bit. Differences in the parameters
/// of lines and arcs bound the differences of q′, q″, q‴ at corresponding places by ε₁, ε₂, ε₃. Segments whose lengths
/// differ by D are mapped onto each other by w(s) with w′ = 1 + D · 30 x²(1 − x)²/L, x = s/L, so that w is C² at
/// joints: |w′ − 1| ≤ 2|D|/L, |w″| ≤ 6|D|/L², |w‴| ≤ 60|D|/L³. A motion s(t) along b becomes w(s(t)) along a, with
/// accelerations and jerks that differ by less than the sums computed here: |s̈| ≤ A with A² = Σ A_k², hence v² ≤ A L
/// over the section, |q″| v² ≤ A, and |s⃛| ≤ J + A |q″| v. Slowed uniformly by 1 + η it is within the limits along a if
/// no limit is exceeded by more than η of itself. The argument includes the steps of velocity and acceleration that
/// joints inside the section allow.
double repeat_margin(const AxisPath& path, const Machine& machine, const std::vector<double>& feeds,
                     const Repetition& repetition, ProgressScope& progress);

/// The bounds of previous sections, for sections that repeat them.
class RepeatedSections {
 public:
  struct Known {
    std::size_t first, last;
    double duration;
    std::size_t nodes, cells;  ///< number of nodes of the bound's grid, and of cells of the relaxation
  };
  /// The arguments have to outlive the object.
  RepeatedSections(const AxisPath& path, const Machine& machine, const std::vector<double>& feeds,
                   ProgressScope& progress)
      : path_(path), machine_(machine), feeds_(feeds), progress_(progress) {}
  /// Returns the bound of the segments [first, last) from an earlier section, less the margin; nothing for a path
  /// through kinematics.
  std::optional<Known> find(std::size_t first, std::size_t last);
  /// Adds the section of the last find().
  void add(const Known& section);

 private:
  static constexpr double largest_margin = 1e-9;

  const AxisPath& path_;
  const Machine& machine_;
  const std::vector<double>& feeds_;
  ProgressScope& progress_;
  std::uint64_t shape_ = 0;
  RoughIndex index_;
  std::vector<Known> known_;
};

}  // namespace bahnwerk::verify
