#pragma once
/// What coarse and fine axes reach at most on each segment of a path: the check of a split [Bock 4.1].
#include <cstddef>
#include <vector>

#include "core/redundant/head_cells.hpp"
#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

/// The peaks of one axis on one segment: mm, mm/s, mm/s², mm/s³.
struct SplitPeaks {
  double offset = 0;
  double coarse_velocity = 0, coarse_acceleration = 0, coarse_jerk = 0;
  double fine_velocity = 0, fine_acceleration = 0, fine_jerk = 0;
};

/// Where cells begin: piece of a law, whose begin is their time 0, and of a spline (a hint).
struct CellsBegin {
  std::size_t law = 0, coarse = 0;
};

/// Returns the peaks of one axis per segment of [first, last) of the path; `law` is the head's and `cells` are cells of
/// it, from `at` on, which becomes where they end in the spline. Bounds, not samples, as far as the cells' ranges are:
/// between nodes the fine velocity is at most w h/4 beyond those at both ends (w: range of the fine acceleration in a
/// cell of h seconds), the offset A h²/8. O(cells + pieces).
std::vector<SplitPeaks> split_peaks(const HeadCells& cells, const TimeLaw& law, std::size_t axis,
                                    const TimeSpline& coarse, std::size_t first, std::size_t last, CellsBegin& at);

/// The head's states at `times`, ascending: the source looks at peaks there, which is quicker and below the truth.
struct HeadSamples {
  std::vector<double> times;
  std::vector<std::size_t> segments;         ///< in which the head is at each
  std::vector<std::vector<AxisState>> axes;  ///< [axis][time]
};
std::vector<SplitPeaks> sampled_peaks(const HeadSamples& head, std::size_t axis, const TimeSpline& coarse,
                                      std::size_t first, std::size_t last);

}  // namespace bahnwerk
