#pragma once
/// The direction of a tool along its path: one curve per segment over the segment's parameter.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/geometry/path/path.hpp"
#include "core/machine/tool.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk {

/// Immutable and thread-safe. A path of five coordinates (x, y, z, φ, ψ) is a Path of the first three and an
/// Orientation of the other two; a rational curve of five coordinates is one Rational in each, with equal weights.
class Orientation {
 public:
  /// The coordinates x, y of `angles[i]` are φ and ψ, rad, over the parameters of `tool[i]`; it is a Line or a
  /// Rational. Several segments may share one (Path::append cuts curves and leaves their parameters unchanged). `tool`
  /// is read, not stored. Throws InvalidInput at {"orientation", i} for angles that jump between segments by more than
  /// 1e-9 rad, or that turn on a segment whose parametric tangent vanishes at an end; std::invalid_argument for a wrong
  /// count, another type of curve, or one that does not cover its segment.
  Orientation(const Path& tool, std::vector<std::shared_ptr<const Curve>> angles);

  /// Returns the tool at parameter u of a segment: derivatives by arc length, one-sided at its ends.
  ToolJet tool(const Segment& segment, std::size_t index, double u) const;
  /// Returns the pose at parameter u of a segment.
  ToolPose pose(const Segment& segment, std::size_t index, double u) const;
  /// Returns an upper bound of |(φ, ψ) − (φ, ψ)(u)|, rad (norm of a complex vector), over all complex parameters within
  /// `radius` of u; infinite where there is none. O(degree²).
  double turn_within(std::size_t index, double u, double radius) const;
  /// Encloses both angles with their derivatives by the parameter for all complex parameters within `radius` of u.
  /// O(degree).
  void enclose(std::size_t index, double u, double radius, DiscJet& phi, DiscJet& psi) const;

 private:
  /// The quotient origin + N(t)/w(t) with t = (u − pivot)/reach; the weight of polynomials is {1}.
  struct Quotient {
    Polynomial phi, psi, weight;
    double pivot = 0, reach = 1;
    Vec origin;
  };
  std::vector<std::shared_ptr<const Curve>> angles_;
  std::vector<Quotient> quotients_;
};

}  // namespace bahnwerk
