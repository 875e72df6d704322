#pragma once
/// Peaks of the coarse and fine axes on each segment of a path, for the check of a split [Bock 4.1].
#include <cstddef>
#include <vector>

#include "core/redundant/head/head_cells.hpp"
#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

/// Peaks of one axis on one segment: mm, mm/s, mm/s², mm/s³.
struct SplitPeaks {
  double offset = 0;
  double coarse_velocity = 0, coarse_acceleration = 0, coarse_jerk = 0;
  double fine_velocity = 0, fine_acceleration = 0, fine_jerk = 0;
};

/// Where cells begin: the piece of the law whose begin is their time 0, and the piece of the spline (a hint).
struct CellsBegin {
  std::size_t law = 0, coarse = 0;
};

/// Returns the peaks of one axis per segment of a range. `law` is the head's law and `cells` are cells of it;
/// `at` says where they begin and receives where they end in the spline. Peaks are upper bounds as far as the cells'
/// ranges are: between nodes the fine velocity exceeds its end values by at most w h/4 (w: range of the fine
/// acceleration in a cell of h seconds) and the offset by A h²/8. O(cells + pieces).
std::vector<SplitPeaks> split_peaks(const HeadCells& cells, const TimeLaw& law, std::size_t axis,
                                    const TimeSpline& coarse, const SegmentRange& range, CellsBegin& at);

/// The head's states at `times`, s, ascending. Peaks at these times alone, as in the source, are quicker to compute but
/// lower than the true ones.
struct HeadSamples {
  std::vector<double> times;
  std::vector<std::size_t> segments;         ///< segment at each time
  std::vector<std::vector<AxisState>> axes;  ///< [axis][time]
};
/// Returns the peaks at the head's samples, of one axis, per segment of a range.
std::vector<SplitPeaks> sampled_peaks(const HeadSamples& head, std::size_t axis, const TimeSpline& coarse,
                                      const SegmentRange& range);

}  // namespace bahnwerk
