#pragma once
/// Decides which cells of an acceleration-limited law are divided: cells in which it switches, and cells in which it
/// exceeds a limit by far.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/motion/acceleration/cell_law.hpp"
#include "core/motion/acceleration/speed_chain.hpp"
#include "core/motion/grid/grid.hpp"

namespace bahnwerk {

/// Marks the cells of a grid to be divided. `grid` and `chain` have to outlive the object.
template <int N>
class DivisionMarks {
 public:
  DivisionMarks(const Grid<N>& grid, const SpeedChain<N>& chain) : grid_(grid), chain_(chain) {}

  LargeVector<std::uint8_t> parts;  ///< number of parts of each cell

  /// Estimates the loss in cells in which the law switches, where the ramp differs from its neighbours', and divides
  /// such cells until the sum is below the tolerance; also divides cells that exceed a limit by far. Returns false if
  /// there is nothing to divide. O(cells).
  bool mark(const UnsetVector<Excess>& excess, double tolerance, ProgressScope& progress) {
    const std::size_t n = grid_.cells.size();
    parts.assign(n, 1);
    loss_.assign(n, 0);
    double time = 0, total = 0;
    std::size_t curved = 0;
    bool divide = false;
    double v_left = n > 0 ? std::sqrt(chain_.node(0)) : 0, before = 0, here = n > 0 ? ramp(0) : 0;
    for (std::size_t c = 0; c < n; ++c) {
      progress(c, n);
      const GridCell& cell = grid_.cells[c];
      const double v_right = std::sqrt(chain_.node(c + 1)), v = 0.5 * (v_left + v_right), h = grid_.length(c);
      const double next = c + 1 < n ? ramp(c + 1) : 0;
      if (v > 0) time += h / v;
      if (!cell.straight) {
        ++curved;
        if (std::max(excess[c].acceleration, excess[c].velocity) > divide_above) {
          parts[c] = 4;
          divide = true;
        }
        const bool follows = c > 0 && grid_.cells[c - 1].segment == cell.segment,
                   followed = c + 1 < n && grid_.cells[c + 1].segment == cell.segment;
        const double smooth = follows && followed ? 0.5 * (before + next) : follows ? before : followed ? next : 0;
        loss_[c] = v > 0 ? switching_loss(c, here - smooth, v, h) : 0;
        total += loss_[c];
      }
      v_left = v_right;
      before = here;
      here = next;
    }
    if (curved > 0 && total > tolerance * time) {
      divide = true;
      const double share = tolerance * time / static_cast<double>(curved);
      for (std::size_t c = 0; c < n; ++c)
        if (loss_[c] > share)
          parts[c] =
              std::max(parts[c], static_cast<std::uint8_t>(std::min(8.0, std::ceil(std::sqrt(loss_[c] / share)))));
    }
    return divide;
  }

  /// Marks cells that exceed an acceleration by far, or a speed by more than `bearable`, which smaller shares of
  /// accelerations cannot correct. Returns false if there are none. O(cells).
  bool mark_excess(const UnsetVector<Excess>& excess, double bearable) {
    const std::size_t n = grid_.cells.size();
    parts.assign(n, 1);
    bool divide = false;
    for (std::size_t c = 0; c < n; ++c) {
      if (grid_.cells[c].straight) continue;
      if (!(excess[c].acceleration > divide_above || excess[c].velocity > bearable)) continue;
      parts[c] = 4;
      divide = true;
    }
    return divide;
  }

 private:
  // An excess beyond this needs smaller cells, below it a smaller share of the limit.
  static constexpr double divide_above = 1e-2;

  /// Returns the change of the slope of v² inside a cell: the ramp of its acceleration over its length.
  double ramp(std::size_t c) const {
    return (chain_.node(c + 1) - 2 * chain_.middle(c) + chain_.node(c)) / (grid_.length(c) * grid_.length(c));
  }

  /// Returns the cost of a ramp of acceleration instead of a jump, s. At a maximum of v² it is the area under the ramp.
  /// At a minimum v² stays lower along the arcs that leave it until they have doubled it, which costs about an eighth
  /// of the cell's time.
  double switching_loss(std::size_t c, double second_difference, double v, double h) const {
    const double change =
        std::max(std::abs(chain_.middle(c) - chain_.node(c)),
                 std::abs(chain_.node(c + 1) - chain_.middle(c)));  // larger change of v² over one half of the cell
    const double jump = std::abs(second_difference) * h * h, area = jump * h / (16 * v * v * v);
    return second_difference > 0 && jump > 0.2 * change ? std::max(area, 0.125 * jump / change * h / v) : area;
  }

  const Grid<N>& grid_;
  const SpeedChain<N>& chain_;
  LargeVector<double> loss_;
};

}  // namespace bahnwerk
