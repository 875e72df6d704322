#pragma once
/// Plans the sections of a contour one after the other under limits of jerk (jerk_limited.hpp). This class holds the
/// state of one section. build_problem.ipp makes the grid and the rows, refine.ipp divides cells in which the law
/// switches, certify.ipp examines the law between the nodes, section.ipp sequences these steps, windows.ipp plans long
/// sections in windows.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/motion/axes/length_axis.hpp"
#include "core/motion/jerk/jerk_grid.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/motion/jerk/peaks.hpp"
#include "core/motion/jerk/solver.hpp"

namespace bahnwerk {

namespace jerk_section_detail {
/// The solver may use this part of every limit. A peak below `sure` between the nodes needs no exact evaluation.
constexpr double full_share = 1 - 2e-5, sure = 1 - 1e-5;
/// A law that has to be slowed by more than this is planned again from another start.
constexpr double good_enough = 1.01;
/// The last window of a section may be this many windows long; a section no longer than that is planned as a whole.
constexpr double last_window = 3;
}  // namespace jerk_section_detail

/// N axes and M rows; M = N + 1 when the path itself is limited.
template <int N, int M>
class JerkSectionPlanner {
 public:
  JerkSectionPlanner(const LanePath<N>& path, const Machine& machine, const JerkLimitedOptions& options,
                     const std::vector<double>& feed, const Sections& sections)
      : path_(path), machine_(machine), options_(options), feed_(feed), sections_(sections) {
    for (std::size_t k = 0; k < M; ++k) {
      const bool axis = k < N;
      const double V = axis ? machine.axes[k].velocity : options.path.velocity;
      limit_.inverse_velocity2[k] = 1 / (V * V);
      limit_.inverse_acceleration[k] = 1 / (axis ? machine.axes[k].acceleration : options.path.acceleration);
      limit_.inverse_jerk[k] = 1 / (axis ? machine.axes[k].jerk : options.path.jerk);
    }
    set_jerk_times();
  }

  void plan(std::size_t first, std::size_t last, Progress progress, JerkLimitedResult& result);
  /// Returns Newton steps times cells, summed over all sections.
  double work() const { return work_; }

 private:
  /// A start of the interior-point method: the part of the rough profile's v², the barrier parameter, the smoothing of
  /// the profile, and the largest slowing with which its result is accepted without further starts.
  struct Start {
    double part, mu;
    Smoothing smoothing = Smoothing::none;
    double enough = jerk_section_detail::good_enough;
  };
  /// Returns the starts in the order in which they are tried. Through kinematics, speeds along a path differ by a
  /// factor of a hundred within milliseconds, and only a slow start is within the jerk limits. A start nearer to the
  /// limits needs fewer steps but may end in a slower law, so its result is accepted only if it needs almost no
  /// slowing.
  std::vector<Start> starts() const {
    using enum Smoothing;
    if (path_.cartesian()) return {{0.8, 0.1, even}, {0.7, 0.3}, {0.2, 1}, {0.02, 1}};
    return {{0.2, 1, narrowing, 1 + 1e-3}, {0.2, 1, even}, {0.7, 0.3}, {0.2, 1}, {0.02, 1}};
  }
  /// Returns the index of the first start that gives a law wherever one exists.
  std::size_t usual_start() const { return path_.cartesian() ? 0 : 1; }

  /// Returns the cells of a window. Through kinematics cells are wider and divided more often, so half as many fit the
  /// cache.
  std::size_t usual_window() const { return path_.cartesian() ? options_.window : options_.window / 2; }

  void set_jerk_times() {
    constexpr double at_once = 1.0 / 64;  // part of the longest time
    std::vector<double> times;
    for (const Limits& axis : machine_.axes)
      if (std::isfinite(axis.jerk)) times.push_back(axis.acceleration / axis.jerk);
    if (std::isfinite(options_.path.jerk))
      times.push_back(largest_acceleration(options_.path, path_.length()) / options_.path.jerk);
    if (times.empty()) return;
    std::sort(times.begin(), times.end());
    shortest_jerk_time_ = times.front();
    jerk_time_ = *std::lower_bound(times.begin(), times.end(), at_once * times.back());
  }

  /// Plans a straight segment alone between two rests in closed form; returns false for any other section.
  bool alone(std::size_t segment, JerkLimitedResult& result);

  /// Builds the grid of the section of segments [first, last), with its rough profile.
  void build(std::size_t first, std::size_t last, ProgressScope& stage_progress);

  /// Plans the section of the current grid from the given start. Its pieces, slowed by `slow_`, hold all limits and are
  /// stored in `best_` if they are the fastest so far. Returns false if a much better law may exist.
  bool plan_whole(Start start, ProgressScope& stage_progress);
  void keep_if_best(double duration);  ///< stores the current pieces, by exchange
  void take_best();

  /// Last method: on an undivided grid, v² gets a ceiling wherever the law before exceeded a limit, by as much as the
  /// law had to be slowed there, until slowing the whole section costs little. Stores a law faster than `best_`.
  void plan_under_ceilings(ProgressScope& stage_progress);
  /// Lowers the ceilings of the cells that exceed a limit.
  void lower_ceilings();

  /// Plans the section in windows. Returns false if some window failed; the current
  /// grid is then the section's.
  bool plan_windows(std::size_t window, Progress progress);

  /// Makes about `cells` cells of the section from `begin` on the current grid, to be passed from `entry_` to rest;
  /// more, if the rest would slow most of them. Returns their number.
  std::size_t take_window(std::size_t begin, std::size_t cells);

  /// Returns the ratio of this window's speed to the speed of the previous window's dropped law at one place of the
  /// overlap.
  double speed_up() const;

  /// Returns the node at which the window is cut: the last of the nodes that the rest at its end does not slow, about
  /// which no limit is exceeded between the nodes, or the one with the smallest excess. O(1).
  std::size_t cut_node() const;

  /// Drops the cells that the rest at the window's end slows; the remaining law ends in motion.
  void drop_braking_tail();

  /// Replaces the beginning of the first guess by the previous window's law and blends over into the guess.
  void blend_previous_window();

  /// Solves on the current grid from the given start. Returns the duration of the law slowed by `slow_`, or infinity on
  /// failure.
  double attempt(Start start, ProgressScope& stage_progress);

  /// Solves, evaluates peaks between the nodes, reduces shares, and solves again with a smaller gap.
  void improve(double mu, ProgressScope& stage_progress);

  /// `at` is a station of the grid or a point of the path.
  template <class Point>
  JerkStation<M> rows_of(const Point& at) const {
    JerkStation<M> r;
    for (std::size_t k = 0; k < N; ++k) {
      r.d1[k] = at.d1[k];
      r.d2[k] = at.d2[k];
      r.d3[k] = at.d3[k];
    }
    if constexpr (M > N) r.d1[N] = 1;
    return r;
  }

  bool joint(std::size_t node) const {
    return node > 0 && node < grid_.cells.size() && grid_.cells[node].segment != grid_.cells[node - 1].segment;
  }

  /// Computes the largest v² per node from velocity limits, feeds and joints.
  void caps(LargeVector<double>& cap, ProgressScope& stage_progress) const;

  /// Returns the first (or last) inner Bernstein coefficient of v² that the limits φ(s) on v² allow in a cell: φ ± h/3
  /// φ′, at least the smaller of both ends' values.
  double cell_cap(std::size_t c, bool at_end) const;

  /// Returns the largest path acceleration at a place passed with at most this v², mm/s².
  double steepest(const Station<N>& at, double b) const;

  void rough(ProgressScope& stage_progress);

  /// Marks in `steady_` the cells of parts that the rough profile passes at one speed, far from every limit.
  void find_steady();

  /// Divides the grid by the rough profile, so that there are nodes where the law needs them.
  void build_grid(ProgressScope& stage_progress);

  /// Marks cells that take much longer than their neighbours, as cells of equal length do where the law accelerates
  /// from rest. Returns false if there are none.
  bool mark_long();

  /// Lowers jerk limits that the grid cannot resolve: to what takes an axis from −A to A in a quarter of a mean cell
  /// that is not steady. Without any jerk limit of some axis the law would oscillate between the nodes.
  void soften();

  /// Sets the first guess from the rough profile of the current grid. Part 0 gives v² ~ (s (L − s)/L)^(4/3) from rest
  /// to rest.
  void guess(Start start, ProgressScope& stage_progress);

  /// Returns the largest usable part of a cell's jerk limits: beside a needle point an eighth of the least one along
  /// the path. From rest v a = 3 j s and v³ = 4.5 j s², so a turn that path length does not resolve takes up to five
  /// times j.
  double needle_part(std::size_t c) const;
  void build_problem(ProgressScope& stage_progress);

  /// Builds the rows for the acceleration between nodes: in long cells, and, if a law exists (`looked`), where an axis
  /// comes near its limit.
  void build_middle_rows(bool looked, ProgressScope& stage_progress);

  void add_node(std::size_t node, const JerkStation<M>& s, const std::array<double, M>& inverse);

  /// Returns the duration of a cell in the current law, s.
  double duration(std::size_t c) const { return jerk_piece(state_[c], state_[c + 1], grid_.length(c)).duration; }

  /// Returns the part of the cell's duration that the largest allowed jerk would save, if the change of acceleration is
  /// worth a node. Where acceleration rises from rest or in a minimum of v², the law stays slower afterwards.
  double slack_ramp(std::size_t c, double change, double jerk) const;

  /// Marks cells for division in which the law switches, until the estimated loss is below the tolerance. Inside such a
  /// cell jerk ramps instead of jumping, which costs a deficit of speed for about a/j. Returns false if there is
  /// nothing to divide.
  bool mark(ProgressScope& stage_progress);

  /// Divides the grid and transfers the law to it.
  void refine(ProgressScope& stage_progress);

  double feed(std::size_t c) const { return std::min(feed_[grid_.cells[c].segment], options_.path.velocity); }

  struct Worst {
    double v = 0, a = 0, j = 0;
  };

  /// Evaluates the path at the middle and the ends of every curved cell, for measure().
  void look_half_way(ProgressScope& stage_progress);

  /// Returns the place at which the path is evaluated where a law is at `s`: no nearer to a cusp than path length
  /// resolves.
  double looked_at(std::size_t segment, double s) const {
    constexpr double nearest = 64 * std::numeric_limits<double>::epsilon();
    const Segment& on = path_[segment];
    const double length = on.length(), begin = on.cusp_begin() ? nearest * length : 0;
    if (on.cusp_end()) s = std::min(s, on.travelled(on.curve().end()) - nearest * length);
    return std::max(s, begin);
  }

  /// Returns the peaks of a cell from samples, relative to what the solver may use; with `exact` from the path itself,
  /// relative to the true limits.
  CellPeaks<M> peaks_of(std::size_t cell, bool exact) const;
  /// Computes the peaks of every cell.
  void measure(bool exact, ProgressScope& stage_progress);

  /// Computes continuous peaks on the path itself wherever samples leave a doubt, and the limits that hold at nodes
  /// only; afterwards `worst_` is the factor by which the section has to be slowed. Positions are rounded as in the
  /// finished law: on micrometres far from the path's beginning that rounding is visible, and the peaks' outer bounds
  /// contain it.
  void certify(ProgressScope& stage_progress);

  void raise(const CellPeaks<M>& peaks) {
    worst_.v = std::max(worst_.v, peaks.velocity);
    for (std::size_t k = 0; k < M; ++k) {
      worst_.a = std::max(worst_.a, peaks.acceleration[k]);
      worst_.j = std::max(worst_.j, peaks.jerk[k]);
    }
  }

  /// Marks for division the cells in which shares of the jerk limit do not help, in addition to those marked already.
  /// Returns false if there are none.
  bool mark_unresolved_cells();

  /// Reduces the shares of cells that exceed a limit between their nodes, by `times` the excess; with `acceleration`
  /// also those of acceleration limits.
  void tighten(double times, bool acceleration);

  /// Appends the law's pieces to `pieces_` and computes the slowing that the remaining excess requires. Returns the
  /// slowed duration, or infinity if the pieces are no law.
  double emit(ProgressScope& stage_progress);

  const LanePath<N>& path_;
  const Machine& machine_;
  const JerkLimitedOptions& options_;
  const std::vector<double>& feed_;
  const Sections& sections_;
  RowLimits<M> limit_, soft_;
  /// Time in which jerk brings an axis to its full acceleration, s: the shortest one, and the shortest among axes whose
  /// time is not negligible. An axis with a thousand times the jerk of another one must not determine the whole grid.
  double shortest_jerk_time_ = 0, jerk_time_ = 0;
  Grid<N> grid_, section_grid_;  // the current grid, and the section's if the current one is a window
  RoughProfile rough_, section_rough_;
  JerkNode entry_, exit_;  // states at both ends: rest, except in windows
  static constexpr std::size_t all_cells = std::numeric_limits<std::size_t>::max();
  double share_ = jerk_section_detail::full_share;
  LargeVector<double> ceiling_;   // caps of v² at each node of the current grid; empty: none
  bool divides_ = true;           // whether cells in which the law switches are divided
  std::size_t keep_ = all_cells;  // number of cells of a window that the rest at its end does not slow
  /// Whether caps of nodes let the cells beside them be faster (build_problem()), and whether that is forbidden
  /// because the solver diverged.
  bool wider_caps_ = false, strict_caps_ = false;
  double overlap_ = 1,
         sped_up_ = 1;  // factor of the windows' overlap; speed_up() of the window whose overlap was too short
  LargeVector<JerkNode> tail_, next_tail_;  // laws behind the cut of the previous window and of this one
  LargeVector<double> cap_, loss_, longest_;
  LargeVector<std::uint8_t> steady_;
  LargeVector<Division> division_;
  LargeVector<JerkNode> state_, before_;  // the solution, and the one before
  JerkProblem<M> problem_;
  JerkSolver<M> solver_;
  LargeVector<CellPath<M>> shape_;  // one entry per curved cell
  LargeVector<CellPeaks<M>> peaks_;
  bool certain_ = false;  ///< whether peaks_ are exact ones of the current states
  Worst worst_;
  LargeVector<LawPiece> pieces_, best_;
  double slow_ = 1, best_duration_ = unlimited, best_slow_ = 1, work_ = 0;
};

}  // namespace bahnwerk
