#pragma once
/// Geometric decomposition [Bock 3.2]: the coarse axes follow a smooth curve along the contour, whatever the time law.
///
/// The curve is the contour's variation-diminishing spline of degree 5 over arc length (Schoenberg): its control points
/// are the tool's places at knots Δ apart. Because |x′| ≤ 1, it stays within Δ/√2 of the tool. Pitches are the path's
/// length over powers of √2, whatever the stroke: from the widest that leaves 1 % of it on, as long as closer curves
/// are quicker. So a machine with more stroke has the curves of one with less. The source takes degree 3 or a QP; with
/// degree 5 what the planner looks at between knots is smooth where they are, too. Knots lie alike as seen from both
/// ends of the contour, so it takes as long backwards. At corners all axes stop, since x_c′ is finite there: that is
/// why the coarse axes' acceleration decides how long cutting takes.
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/known/split_path.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Uniform B-spline of degree 5 over path length.
class CoarseCurve final : public CoarsePath {
 public:
  /// How the path goes on beyond its ends, where control points lie.
  enum class Ends {
    free,     ///< by its end points
    centred,  ///< turned about its end points: there the curve meets the path
  };
  /// Control points every `pitch` mm, symmetric about the middle of the path; with centred ends at whole fractions of
  /// its length, `pitch` at most.
  CoarseCurve(const AxisPath& path, double pitch, Ends ends = Ends::free);
  bool linear(std::size_t) const override { return false; }
  AxisJet at(std::size_t segment, double s, const AxisJet& tool) const override;
  double pitch() const { return pitch_; }

 private:
  std::size_t axes_;
  double pitch_, begin_;            ///< mm; where the first span begins, 0 at most
  std::vector<AxisArray> control_;  ///< of s = begin − 2Δ, begin − Δ, …
};

/// Returns the coarse curve with the longest pitch that keeps the fine axes inside their strokes. Its ends are centred
/// where a fine axis has to be.
std::shared_ptr<const CoarseCurve> coarse_curve(const AxisPath& path, const CoarseFineMachine& machine,
                                                Progress& progress);

/// Throws Infeasible where no curve is found: along a path of more than 5 000 pitches none is looked for. Cost: two
/// plans of all axes along the path, mostly.
RedundancyResult plan_geometric(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                double from, double to);

}  // namespace bahnwerk
