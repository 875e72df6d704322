#pragma once
/// A smooth (C∞) piece of a contour over its own parameter u ∈ [begin(), end()].
#include "core/geometry/curve/path_batch.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// Value and the first three derivatives by the curve's parameter.
struct Jet {
  Vec value, d1, d2, d3;
};

/// The type of a curve, for code that has a closed form for some.
enum class CurveKind { line, arc, rational };

/// Immutable; every call is thread-safe, allocation-free and O(degree).
class Curve {
 public:
  virtual ~Curve() = default;
  virtual CurveKind kind() const = 0;
  virtual double begin() const = 0;
  virtual double end() const = 0;
  /// Returns the point, mm, and its derivatives by u.
  virtual Jet at(double u) const = 0;
  /// Returns |dh/du|, mm per unit of u. Cheaper than at().
  virtual double speed(double u) const = 0;
  /// Writes the derivatives by the parameter at all points of a batch. Returns false if the curve evaluates points one
  /// by one.
  virtual bool derivatives(PathBatch&) const { return false; }
};

}  // namespace bahnwerk
