#pragma once
/// The geometric decomposition [Bock 3.2]: the coarse axes follow a smooth curve along the contour that does not depend
/// on the time law.
///
/// The curve is Schoenberg's variation-diminishing spline of degree 5 over path length: its control points are the
/// tool's positions at knots that are Δ (the pitch) apart. As |x′| ≤ 1, it stays within Δ/√2 of the tool. Candidates
/// for the pitch are the path's length divided by powers of √2, from the widest one within the stroke on, as long as
/// closer curves are quicker. The candidates do not depend on the stroke, so a machine with a larger stroke has all
/// curves of one with a smaller stroke. Degree 5 (the source takes 3 or a quadratic program) makes the curve's
/// derivatives smooth at knots, where the planner evaluates them only nearby. The knots are symmetric, so both
/// directions of the contour take equally long. At corners all axes rest, because x_c′ is finite there; therefore the
/// coarse axes' acceleration limits the speed.
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/known/split_path.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Uniform B-spline of degree 5 over path length with the tool's positions as control points.
class CoarseCurve final : public CoarsePath {
 public:
  /// Continuation of the path beyond its ends, where control points lie.
  enum class Ends {
    free,     ///< by its end points, repeated
    centred,  ///< by point reflection at its end points, so that the curve ends on the path
  };
  /// Places control points every `pitch` mm, symmetric about the middle of the path. With centred ends the distance is
  /// a whole fraction of the path's length, at most `pitch`.
  CoarseCurve(const AxisPath& path, double pitch, Ends ends = Ends::free);
  bool linear(std::size_t) const override { return false; }
  AxisJet at(std::size_t segment, double s, const AxisJet& tool) const override;
  double pitch() const { return pitch_; }

 private:
  std::size_t axes_;
  double pitch_, begin_;            ///< mm, pitch and begin of the first span (≤ 0)
  std::vector<AxisArray> control_;  ///< at s = begin − 2Δ, begin − Δ, …
};

/// Returns the coarse curve with the longest pitch that keeps the fine axes within their strokes. Its ends are centred
/// if a fine axis has to be in the middle of its stroke there.
std::shared_ptr<const CoarseCurve> coarse_curve(const AxisPath& path, const CoarseFineMachine& machine,
                                                Progress progress);

/// Plans head and coarse axes with the best curve. Usually two plans of all axes are
/// made. Returns no_curve where none is found; along paths of more than 5 000 pitches none is searched.
Expected<RedundancyResult, NoPlan> plan_geometric(const RedundancyTask& task, const RedundancyOptions& options,
                                                  Progress progress);

}  // namespace bahnwerk
