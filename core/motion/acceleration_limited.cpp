#include "core/motion/acceleration_limited.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "core/motion/cell_law.hpp"
#include "core/motion/runs.hpp"
#include "core/motion/speed_chain.hpp"

namespace bahnwerk {

namespace {

// Memory: about 270 bytes per cell of a window, 72 for the law of each. Beyond the usual number cells get wider, up to
// the coarsest; the gap then tells what that costs.
constexpr double usual_cells = 1e6, most_cells = 8e6, coarsest_angle = 0.02;  // rad
constexpr std::size_t block = 2048;                                           // cells that stay in a cache
constexpr double divide_above =
    1e-2;  // an excess beyond this needs smaller cells, below it a smaller share of the limit

template <int N>
class RunPlanner {
 public:
  RunPlanner(const Contour& contour, const Machine& machine, const AccelerationLimitedOptions& options,
             const std::vector<double>& feed, const Runs& runs, Progress& progress)
      : path_(contour.path),
        machine_(machine),
        options_(options),
        feed_(feed),
        progress_(progress),
        limit_(machine),
        chain_(grid_, feed, runs, machine,
               options.keep_reserve ? std::optional(options.braking_reserve) : std::nullopt) {}

  /// The run over the segments [first, last); `from` … `to` is its share of progress.
  void plan(std::size_t first, std::size_t last, double from, double to, AccelerationLimitedResult& result) {
    if (reach(first, last, static_cast<double>(options_.window)) < last)
      return plan_long(first, last, from, to, result);
    PlanningPulse pulse(progress_, from, to);
    solve_window(first, last, 0, pulse, result);
    slow_ = slowing(excess(grid_.cells.size()));
    emit(grid_.cells.size(), result, pulse);
  }

 private:
  /// The end of the segments from `first` on that have about so many cells; one at least.
  std::size_t reach(std::size_t first, std::size_t last, double cells) const {
    std::size_t end = first;
    for (; end < last && cells > 0; ++end) cells -= 1 + total_turn(path_, end, end + 1) / options_.grid.angle;
    return end;
  }

  /// Window by window, each to a stop at its end. Kept is what lies before the last segment border which that stop does
  /// not reach and where the speed is given by what came before; the next window begins there. Where there is none, or
  /// the next window cannot go on from it, windows grow.
  void plan_long(std::size_t first, std::size_t last, double from, double to, AccelerationLimitedResult& result) {
    struct Place {
      std::size_t segment, pieces, cells;
      double entry, most;
    };
    const std::size_t first_piece = result.law.pieces().size();
    Place at{first, first_piece, result.cells, 0, 0}, before = at;
    double window = static_cast<double>(options_.window);
    const auto fraction = [&](std::size_t segment) {
      const double begin = path_[first].s0(), end = path_[last - 1].s1();
      return from + (to - from) * ((segment < last ? path_[segment].s0() : end) - begin) / (end - begin);
    };
    slow_ = 1;
    while (at.segment < last) {
      const std::size_t end = reach(at.segment, last, window);
      PlanningPulse pulse(progress_, fraction(at.segment), fraction(end));
      solve_window(at.segment, end, at.entry, pulse, result);
      const std::size_t keep = end == last ? grid_.cells.size() : border();
      if (!chain_.enters() || keep == 0) {
        if (!chain_.enters()) at = before;
        result.law.truncate(at.pieces);
        window *= 2;
        continue;
      }
      before = at;
      emit(keep, result, pulse);
      at = {end == last ? last : grid_.cells[keep].segment, result.law.pieces().size(), result.cells, chain_.node(keep),
            std::max(at.most, excess(keep))};
    }
    if (const double slow = slowing(at.most); slow > 1) result.law.slow_from(first_piece, slow);
  }

  std::size_t border() const {
    for (std::size_t c = chain_.unaffected(share_); c > 0; --c)
      if (grid_.cells[c].segment != grid_.cells[c - 1].segment && chain_.slack(c)) return c;
    return 0;
  }

  void solve_window(std::size_t first, std::size_t last, double entry, PlanningPulse& pulse,
                    AccelerationLimitedResult& result) {
    pulse.part(0, 0.2);
    grid_.build(path_, first, last, feed_, machine_, options_.grid, pulse);
    std::size_t rounds = 0;
    for (int division = 0;; ++division) {  // first the grid …
      pulse.half_of_rest();
      solve(entry, pulse);
      ++rounds;
      if (division == options_.max_divisions || !mark_divisions(pulse)) break;
      grid_.divide(path_, parts_, pulse);
    }
    for (int round = 0; round < options_.max_rounds && shrink_shares();
         ++round, ++rounds) {  // … then the limits in its cells
      pulse.half_of_rest();
      chain_.update(share_, dirty_, pulse);
      for (std::size_t c = 0; c < grid_.cells.size(); c += block) shape(c, pulse);
    }
    pulse.half_of_rest();
    result.rounds = std::max(result.rounds, rounds);
  }

  double excess(std::size_t cells) const {
    double acceleration = 0, velocity = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      acceleration = std::max(acceleration, excess_[c].acceleration);
      velocity = std::max(velocity, excess_[c].velocity);
    }
    return std::max(acceleration, velocity);
  }
  static double slowing(double excess) { return excess > 0 ? std::sqrt(1 + excess) * (1 + 1e-12) : 1; }

  /// Smooth cells leave what the law may bulge between their ends: the acceleration of an axis along a saturated law is
  /// a parabola of height ≈ turn²/8 there.
  void share(std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      double square = 0;
      for (std::size_t k = 0; k < N; ++k) {
        const double d = grid_.right(c).d1[k] - grid_.left(c).d1[k];
        square += d * d;
      }
      share_[c] = 1 - 0.15 * square;
    }
  }

  /// Speeds of all cells and their laws, block by block: reading the cells once more costs as much as the work on them.
  void solve(double entry, PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size();
    dirty_.assign(n, 1);
    laws_.resize(n);
    excess_.assign(n, {});
    share_.resize(n);
    chain_.start(entry);
    for (std::size_t end = n; end > 0;) {
      const std::size_t begin = (end - 1) / block * block;
      pulse(begin, n);
      share(begin, end);
      chain_.backward(begin, end, share_);
      end = begin;
    }
    for (std::size_t c = 0; c < n; c += block) {
      chain_.forward(c, std::min(n, c + block), share_);
      shape(c, pulse);
    }
  }

  /// Laws of the curved cells of a block that changed, and where they exceed a limit between their stations.
  void shape(std::size_t first, PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size(), last = std::min(n, first + block);
    std::size_t after = n;
    double v2 = 0;
    pulse(first, n);
    for (std::size_t c = first; c < last; ++c) {
      const GridCell& cell = grid_.cells[c];
      const double h = grid_.length(c);
      if (!dirty_[c] || cell.straight || !(h > 0)) continue;
      const double b1 = chain_.node(c), g = chain_.middle(c), b2 = chain_.node(c + 1);
      const Station<N>&l = grid_.left(c), &r = grid_.right(c);
      // Cells come in order: the left speed is the right one of the cell before, unless that was skipped.
      if (after != c) v2 = std::sqrt(b1);
      const double v1 = v2;
      v2 = std::sqrt(b2);
      after = c + 1;
      laws_[c] = cell_law(b1, v1, g, b2, v2, h);
      if (cell.cusp_left || cell.cusp_right || !smooth_excess<N>(l, r, h, laws_[c], b1, b2, limit_, excess_[c]))
        excess_[c] = cell_excess<N>(l, r, h, laws_[c], cell, limit_, feed_[cell.segment]);
    }
  }

  /// How far v² bends inside a cell: the ramp of its acceleration over its length.
  double ramp(std::size_t c) const {
    return (chain_.node(c + 1) - 2 * chain_.middle(c) + chain_.node(c)) / (grid_.length(c) * grid_.length(c));
  }

  /// What a ramp of acceleration instead of a jump costs, s. At a peak of v² only the area under the ramp. At a trough
  /// v² stays lower all along the arcs that leave it, until they have doubled it: about an eighth of the cell's own
  /// time.
  double switching_loss(std::size_t c, double bend, double v, double h) const {
    const double left = std::abs(chain_.middle(c) - chain_.node(c)) / h,
                 right = std::abs(chain_.node(c + 1) - chain_.middle(c)) / h;
    const double jump = std::abs(bend) * h, scale = std::max(left, right), area = jump * h * h / (16 * v * v * v);
    return bend > 0 && jump > 0.2 * scale ? std::max(area, 0.125 * jump / scale * h / v) : area;
  }

  /// Where a law switches inside a cell the ramp is far from its neighbours': estimates what that costs and divides
  /// such cells until the whole stays below the tolerance; also cells that exceed a limit by far. False = nothing to
  /// divide.
  bool mark_divisions(PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size();
    parts_.assign(n, 1);
    loss_.assign(n, 0);
    double time = 0, total = 0;
    std::size_t curved = 0;
    bool divide = false;
    for (std::size_t c = 0; c < n; ++c) {
      pulse(c, n);
      const GridCell& cell = grid_.cells[c];
      const double v = 0.5 * (std::sqrt(chain_.node(c)) + std::sqrt(chain_.node(c + 1))), h = grid_.length(c);
      if (v > 0) time += h / v;
      if (cell.straight) continue;
      ++curved;
      if (std::max(excess_[c].acceleration, excess_[c].velocity) > divide_above) {
        parts_[c] = 4;
        divide = true;
      }
      const bool before = c > 0 && grid_.cells[c - 1].segment == cell.segment,
                 after = c + 1 < n && grid_.cells[c + 1].segment == cell.segment;
      double smooth = 0;
      if (before && after)
        smooth = 0.5 * (ramp(c - 1) + ramp(c + 1));
      else if (before)
        smooth = ramp(c - 1);
      else if (after)
        smooth = ramp(c + 1);
      loss_[c] = v > 0 ? switching_loss(c, ramp(c) - smooth, v, h) : 0;
      total += loss_[c];
    }
    if (curved > 0 && total > options_.tolerance * time) {
      divide = true;
      const double share = options_.tolerance * time / static_cast<double>(curved);
      for (std::size_t c = 0; c < n; ++c)
        if (loss_[c] > share)
          parts_[c] =
              std::max(parts_[c], static_cast<std::uint8_t>(std::min(8.0, std::ceil(std::sqrt(loss_[c] / share)))));
    }
    return divide;
  }

  /// Cells that exceed a limit a little get a smaller share of it. False = none does.
  bool shrink_shares() {
    bool any = false;
    for (std::size_t c = 0; c < grid_.cells.size(); ++c) {
      dirty_[c] = excess_[c].acceleration > options_.excess;
      if (!dirty_[c]) continue;
      share_[c] /= 1 + 1.2 * excess_[c].acceleration;
      any = true;
    }
    return any;
  }

  /// `s` and `s_end` count from the begin of the segment.
  void piece(MotionLaw& law, std::size_t segment, double s, double s_end, double v1, double v2, double a) {
    append(law, {2 * (s_end - s) / (v1 + v2), v1, a, 0}, segment, s, s_end);
  }

  void append(MotionLaw& law, const CellLaw& cell, std::size_t segment, double s, double s_end) {
    LawPiece& p = law.next();
    p.duration = cell.duration * slow_;
    p.v = cell.v * faster_;
    p.a = cell.a * (faster_ * faster_);
    p.j = cell.j * (faster_ * faster_ * faster_);
    p.segment = segment;
    p.s = path_[segment].s0() + s;
    p.s_end = path_[segment].s0() + s_end;
  }

  /// The law of the first cells.
  void emit(std::size_t cells, AccelerationLimitedResult& result, PlanningPulse& pulse) {
    MotionLaw& law = result.law;
    law.reserve(cells + 2);
    result.cells += cells;
    faster_ = 1 / slow_;
    for (std::size_t c = 0; c < cells; ++c) {
      pulse(c, cells);
      const std::size_t segment = grid_.cells[c].segment;
      const double s1 = grid_.left(c).s, s2 = grid_.right(c).s, b1 = chain_.node(c), b2 = chain_.node(c + 1);
      if (grid_.cells[c].straight) {
        straight(law, segment, s1, s2, b1, b2, chain_.acceleration(c), chain_.cap(c));
      } else if (s2 > s1) {
        if (cruise(c) && c > 0 && grid_.cells[c - 1].segment == segment && cruise(c - 1))
          law.extend(path_[segment].s0() + s2, laws_[c].duration * slow_);
        else
          append(law, laws_[c], segment, s1, s2);
      }
    }
  }

  /// Constant speed through the whole cell: such cells of one segment become one piece.
  bool cruise(std::size_t c) const {
    return !grid_.cells[c].straight && chain_.node(c) == chain_.middle(c) && chain_.middle(c) == chain_.node(c + 1);
  }

  /// Accelerate, hold, brake: exact on a straight line.
  void straight(MotionLaw& law, std::size_t segment, double s1, double s2, double b1, double b2, double a, double cap) {
    const double peak = std::min(cap, 0.5 * (b1 + b2) + a * (s2 - s1));
    const double v1 = std::sqrt(b1), v2 = std::sqrt(b2), v = std::sqrt(std::max({peak, b1, b2}));
    const double up = (peak - b1) / (2 * a), down = (peak - b2) / (2 * a), hair = 1e-13 * (s2 - s1);
    double s = s1;
    const bool rises = up > hair, falls = down > hair;
    double end = falls ? std::min(s2, std::max(s1, s2 - down)) : s2;
    if (rises) {
      const double to = std::min(end, s1 + up);
      // Without a plateau both ramps meet in one point.
      const bool plateau = end - to > hair;
      const double meet = plateau ? to : end;
      piece(law, segment, s, meet, v1, v, a);
      s = meet;
    }
    if (end - s > hair || (!rises && !falls)) {
      piece(law, segment, s, end, v, v, 0);
      s = end;
    }
    if (falls) piece(law, segment, s, s2, v, v2, -a);
  }

  const Path& path_;
  const Machine& machine_;
  const AccelerationLimitedOptions& options_;
  const std::vector<double>& feed_;
  Progress& progress_;
  AxisBounds<N> limit_;
  double slow_ = 1, faster_ = 1;  // by what the law is slowed; its inverse
  Grid<N> grid_;
  SpeedChain<N> chain_;
  LargeVector<double> share_, loss_;
  LargeVector<Excess> excess_;
  LargeVector<CellLaw> laws_;  // of curved cells, before slowing
  LargeVector<std::uint8_t> dirty_, parts_;
};

template <int N>
AccelerationLimitedResult plan(const Contour& contour, const Machine& machine,
                               const AccelerationLimitedOptions& options, Progress& progress, double from, double to) {
  const std::vector<double> feed = contour.feeds();
  const Runs runs = find_runs(contour, machine, options.corner_angle);
  AccelerationLimitedResult result;
  RunPlanner<N> planner(contour, machine, options, feed, runs, progress);
  for_each_run(contour.path, runs, from, to, [&](std::size_t first, std::size_t last, double begin, double end) {
    planner.plan(first, last, begin, end, result);
  });
  return result;
}

}  // namespace

AccelerationLimitedResult plan_acceleration_limited(const Contour& contour, const Machine& machine,
                                                    const AccelerationLimitedOptions& options, Progress& progress,
                                                    double from, double to) {
  for (const AxisLimits& axis : machine.axes)
    if (!(axis.velocity > 0) || !(axis.acceleration > 0) || !std::isfinite(axis.acceleration))
      throw InvalidInput(
          {{{"machine", "axes", axis.name}, "velocity and acceleration must be positive, acceleration finite"}});
  AccelerationLimitedOptions fitted = options;
  const double turn = total_turn(contour.path, 0, contour.path.size());
  fitted.grid.angle = std::max(options.grid.angle, std::min(coarsest_angle, turn / usual_cells));
  if (turn / fitted.grid.angle > most_cells)
    throw InvalidInput(
        {{{"contour"},
          "the contour turns by " + std::to_string(static_cast<long>(turn)) + " rad in all, more than the " +
              std::to_string(static_cast<long>(most_cells * coarsest_angle)) + " that fit into memory"}});
  return machine.dimension() == 2 ? plan<2>(contour, machine, fitted, progress, from, to)
                                  : plan<3>(contour, machine, fitted, progress, from, to);
}

}  // namespace bahnwerk
