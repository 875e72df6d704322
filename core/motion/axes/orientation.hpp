#pragma once
/// Where a tool points along its path: per segment of the path a curve over the parameter of the segment's own.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/geometry/path/path.hpp"
#include "core/machine/tool.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk {

/// Immutable and thread-safe. A path of five coordinates (x, y, z, φ, ψ) is a Path of the first three and this of the
/// other two; a rational curve of five is a Rational each, of the same weights.
class Orientation {
 public:
  /// `angles[i]`: its coordinates x, y are φ and ψ, rad, over the parameters of `tool[i]`; a Line or a Rational.
  /// Several segments may share one (Path::append cuts curves and leaves their parameters as they are). `tool` is read,
  /// not kept. Throws InvalidInput at {"orientation", i} for angles that jump between segments by more than 1e-9 rad,
  /// or that turn on a segment whose parametric tangent vanishes at an end; std::invalid_argument for another count,
  /// another kind of curve, or one that does not reach over its segment.
  Orientation(const Path& tool, std::vector<std::shared_ptr<const Curve>> angles);

  /// Tool at parameter u of a segment of that path: derivatives by arc length, one-sided at its ends.
  ToolJet tool(const Segment& segment, std::size_t index, double u) const;
  ToolPose pose(const Segment& segment, std::size_t index, double u) const;
  /// Upper bound of |(φ, ψ) − (φ, ψ)(u)|, rad (norm of a complex vector), over all complex parameters within `radius`
  /// of u; infinite where there is none. O(degree²).
  double turn_within(std::size_t index, double u, double radius) const;
  /// Both angles with their derivatives by the parameter, for all complex ones within `radius` of u. O(degree).
  void enclose(std::size_t index, double u, double radius, DiscJet& phi, DiscJet& psi) const;

 private:
  /// origin + N(t)/w(t), t = (u − pivot)/reach; the weight of polynomials is {1}.
  struct Quotient {
    Polynomial phi, psi, weight;
    double pivot = 0, reach = 1;
    Vec origin;
  };
  std::vector<std::shared_ptr<const Curve>> angles_;
  std::vector<Quotient> quotients_;
};

}  // namespace bahnwerk
