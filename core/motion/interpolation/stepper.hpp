#pragma once
/// Steps along a path, one per cycle, by one of the interpolators.
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

/// Immutable. Every call is O(degree) and a search in the arc length's table, without allocation. A step over several
/// segments costs this for each of them.
class Stepper {
 public:
  /// `path` is stored by reference.
  Stepper(const Path& path, Interpolator interpolator, double cycle_time)
      : path_(path), series_(path), interpolator_(interpolator), cycle_time_(cycle_time) {}

  PathPlace begin() const { return {0, path_[0].curve().begin(), 0}; }
  PathPlace end() const { return {path_.size() - 1, path_[path_.size() - 1].curve().end(), path_.length()}; }

  /// Returns the place at the end of a cycle that begins at `from`. `law` is the state of the law at the beginning of
  /// the cycle, `next` its s at the end.
  ///
  /// Each step corrects the error of the one before: the length to cover is the interpolator's own for the cycle, v T,
  /// v T + a T²/2 or (3.106) in full, plus the distance by which `from` is behind the law. Errors therefore do not add
  /// up, and no place is off by more than the error of one step. A step never moves backwards: one with a length below
  /// 0 stays in place.
  ///
  /// A step that leaves the segment continues from the joint with the rest of its length, l − ‖s(joint) − s(u)‖, as in
  /// Fig. 4.28. The quartic, whose series ends with the second order, divides a long step into at most 32 parts of at
  /// most 1/64 of its curve's parameter. Where the parametric tangent (nearly) vanishes, or the quartic has no root
  /// although the segment is long enough, the series is useless and the step is exact.
  PathPlace next(const PathPlace& from, const LawState& law, double next) const;

 private:
  double aimed(const PathPlace& from, const LawState& law, double next) const;
  PathPlace exact(std::size_t segment, double s) const;
  /// Returns Δu of a step of `length`, or `unlimited` if the series does not reach that length within `most`; `run` is
  /// the part of the length that the law's speed alone covers.
  double step(const QuotientJet& at, double length, double run, double most) const;

  const Path& path_;
  PieceSeries series_;
  Interpolator interpolator_;
  double cycle_time_;
};

}  // namespace bahnwerk
