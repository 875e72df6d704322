#pragma once
/// One cycle's step along a path by one of the interpolators.
#include <cstddef>

#include "core/geometry/path/path.hpp"
#include "core/motion/interpolation/interpolator.hpp"
#include "core/motion/interpolation/piece_series.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// A place on a path: parameter u of a segment's curve, and the arc length there, mm.
struct PathPlace {
  std::size_t segment = 0;
  double u = 0, s = 0;
};

/// Immutable; every call is O(degree) and a search in the arc length's table, without allocation. A step over several
/// segments costs as much for each of them.
class Stepper {
 public:
  /// `path` is kept by reference.
  Stepper(const Path& path, Interpolator interpolator, double cycle_time)
      : path_(path), series_(path), interpolator_(interpolator), cycle_time_(cycle_time) {}

  PathPlace begin() const { return {0, path_[0].curve().begin(), 0}; }
  PathPlace end() const { return {path_.size() - 1, path_[path_.size() - 1].curve().end(), path_.length()}; }

  /// From where the cycle begins to where it ends. `law`: the law where the cycle begins, `next`: s where it ends.
  ///
  /// What a step is off by is corrected in the next one: the length that is stepped is the interpolator's own for the
  /// cycle, v T, v T + a T²/2 or (3.106) in full, and what `from` is behind the law or ahead of it. So the errors of
  /// all steps do not add up, and no place is off by more than one step is. Nothing goes back: a step whose length
  /// comes out below 0 stays where it is.
  ///
  /// A step that leaves the segment goes on from the joint with what is left of its length, l − ‖s(joint) − s(u)‖, as
  /// in Fig. 4.28. The quartic, whose series ends with the second order, goes a long step in parts: none takes more
  /// than 1/64 of its curve's parameter, there are up to 32. Where the parametric tangent (nearly) vanishes, or the
  /// quartic has no root though the segment goes on farther, the series says nothing: such a step is exact.
  PathPlace next(const PathPlace& from, const LawState& law, double next) const;

 private:
  double aimed(const PathPlace& from, const LawState& law, double next) const;
  PathPlace exact(std::size_t segment, double s) const;
  /// Δu of a step of `length`, unlimited where the series does not come so far within `most`; `run`: the part of the
  /// length that the law's speed alone makes.
  double step(const QuotientJet& at, double length, double run, double most) const;

  const Path& path_;
  PieceSeries series_;
  Interpolator interpolator_;
  double cycle_time_;
};

}  // namespace bahnwerk
