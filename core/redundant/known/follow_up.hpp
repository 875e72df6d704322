#pragma once
/// Following up [Bock 3.1]: what fits into the strokes of the fine axes they cut alone, while the coarse axes stand;
/// everything else the coarse axes cut alone; between, all axes move from point to point.
///
/// What counts is a run: all that is cut between two positioning moves. The coarse axes stand where a run that fits has
/// its middle. While positioning, what the fine axes are off goes evenly along the path from one run's to the next
/// one's, so the tool stays on its path, and in between their strokes, and all axes end together.
#include <cstddef>
#include <vector>

#include "core/redundant/known/split_path.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Along a run the fine axes cut it, or the offset x − x_c is linear in s.
class FollowUp final : public CoarsePath {
 public:
  struct Run {
    std::size_t first = 0, last = 0;  ///< segments
    bool cuts = false, fits = false;
    AxisArray centre{};           ///< where the coarse axes stand, if it fits
    AxisArray begin{}, change{};  ///< else: the offset where it begins, and by how much it changes
    double s0 = 0, length = 0;
  };
  FollowUp(const AxisPath& path, const Contour& contour, const CoarseFineMachine& machine, Progress& progress);
  bool linear(std::size_t) const override { return true; }
  AxisJet at(std::size_t segment, double s, const AxisJet& tool) const override;
  const std::vector<Run>& runs() const { return runs_; }

 private:
  std::size_t axes_;
  std::vector<Run> runs_;
  std::vector<std::size_t> run_;  ///< of each segment
};

/// Everything stops where runs meet.
RedundancyResult plan_follow_up(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                double from, double to);

}  // namespace bahnwerk
