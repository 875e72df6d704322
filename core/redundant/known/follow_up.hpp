#pragma once
/// The follow-up method (Nachführung) [Bock 3.1]: whatever fits into the strokes of the fine axes is cut by them alone
/// while the coarse axes stand; everything else is cut by the coarse axes alone; all axes move during positioning.
///
/// The contour is divided into runs. A run is everything that is cut between two positioning moves. For a run that
/// fits, the coarse axes stand where the run has its middle. During a positioning move the offset of the fine axes
/// changes linearly with path length from that of one run to that of the next, so the tool stays on its path, the fine
/// axes stay within their strokes, and all axes arrive together.
#include <cstddef>
#include <vector>

#include "core/redundant/known/split_path.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Positions of the coarse axes over path length: constant on a run that fits, else the tool's position less an offset
/// that is linear in s.
class FollowUp final : public CoarsePath {
 public:
  struct Run {
    std::size_t first = 0, last = 0;  ///< segments
    bool cuts = false, fits = false;
    AxisArray centre{};           ///< mm, where the coarse axes stand, if the run fits
    AxisArray begin{}, change{};  ///< mm, else: offset x − x_c at the run's begin, and its change along the run
    double s0 = 0, length = 0;
  };
  /// Divides `path`, the path of `contour`, into runs.
  FollowUp(const AxisPath& path, const Contour& contour, const CoarseFineMachine& machine, Progress progress);
  bool linear(std::size_t) const override { return true; }
  AxisJet at(std::size_t segment, double s, const AxisJet& tool) const override;
  const std::vector<Run>& runs() const { return runs_; }

 private:
  std::size_t axes_;
  std::vector<Run> runs_;
  std::vector<std::size_t> run_;  ///< index of the run of each segment
};

/// Plans with rests at all borders between runs. Throws as plan_split() does.
Expected<RedundancyResult, NoPlan> plan_follow_up(const RedundancyTask& task, const RedundancyOptions& options,
                                                  Progress progress);

}  // namespace bahnwerk
