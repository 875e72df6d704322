#pragma once
/// Plans the sections of a contour one after the other under limits of jerk (jerk_limited.hpp): the state of one
/// section and the steps on it. pose.cpp lays the grid and states the problem, refine.cpp divides cells in
/// which the law switches, certify.cpp looks between the nodes, section.cpp puts them in order,
/// windows.cpp for long sections window by window.
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
/// The solver may use this part of every limit; what lies below `sure` between the nodes needs no closer look.
constexpr double full_share = 1 - 2e-5, sure = 1 - 1e-5;
/// A law that had to be slowed by more than this may have a better start.
constexpr double good_enough = 1.01;
/// The last window of a section is up to so many windows long; what is no longer than that is planned whole.
constexpr double last_window = 1.5;
}  // namespace jerk_section_detail

/// N axes, M rows: one more when the path itself is limited.
template <int N, int M>
class JerkSectionPlanner {
 public:
  JerkSectionPlanner(const LanePath<N>& path, const Machine& machine, const JerkLimitedOptions& options,
                     const std::vector<double>& feed, const Sections& sections, Progress& progress)
      : path_(path), machine_(machine), options_(options), feed_(feed), sections_(sections), progress_(progress) {
    for (std::size_t k = 0; k < M; ++k) {
      const bool axis = k < N;
      const double V = axis ? machine.axes[k].velocity : options.path.velocity;
      limit_.inverse_velocity2[k] = 1 / (V * V);
      limit_.inverse_acceleration[k] = 1 / (axis ? machine.axes[k].acceleration : options.path.acceleration);
      limit_.inverse_jerk[k] = 1 / (axis ? machine.axes[k].jerk : options.path.jerk);
    }
    set_jerk_times();
  }

  void plan(std::size_t first, std::size_t last, double from, double to, JerkLimitedResult& result);
  /// Newton steps times cells, of all sections.
  double work() const { return work_; }

 private:
  /// Where the interior-point method starts: which part of the rough profile's v², the barrier, how the profile is
  /// smoothed before; and by how much what comes of it may have to be slowed if others are not to be tried.
  struct Start {
    double part, mu;
    Smoothing smoothing = Smoothing::none;
    double enough = jerk_section_detail::good_enough;
  };
  /// In the order in which they are tried. Through kinematics a path is passed at speeds that differ by a factor of a
  /// hundred within milliseconds: there the profile lies far beyond the limits of jerk, but for a slow one. Nearer to
  /// them the solver needs fewer steps, but where it fails in the end laws are often a little slower than from further
  /// below, so that only what is as good as certain is taken.
  std::vector<Start> starts() const {
    using enum Smoothing;
    if (path_.cartesian()) return {{0.8, 0.1, even}, {0.7, 0.3}, {0.2, 1}, {0.02, 1}};
    return {{0.2, 1, narrowing, 1 + 1e-3}, {0.2, 1, even}, {0.7, 0.3}, {0.2, 1}, {0.02, 1}};
  }
  /// The first of them that gives a law wherever there is one.
  std::size_t usual_start() const { return path_.cartesian() ? 0 : 1; }

  /// Cells of a window. Through kinematics they are wider, and more of them divided: half as many fit the cache.
  std::size_t usual_window() const { return path_.cartesian() ? options_.window : options_.window / 2; }

  void set_jerk_times() {
    constexpr double at_once = 1.0 / 64;  // of the longest time
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

  /// A straight segment alone between two rests has a closed form.
  bool alone(std::size_t segment, JerkLimitedResult& result);

  /// Lays the grid of a section, with its rough profile.
  void build(std::size_t first, std::size_t last, ProgressScope& pulse);

  /// Plans the section whose grid is at hand from the given start. Its pieces, slowed by `slow_`, then hold all limits;
  /// kept in `best_` if they are the quickest so far. False: there may be something much better.
  bool plan_whole(Start start, ProgressScope& pulse);
  void keep_if_best(double duration);  ///< the pieces at hand; they are others then
  void take_best();

  /// After all else came to nothing: on an undivided grid v² gets a ceiling wherever the law before exceeded a limit,
  /// by as much as the law had to be slowed there, until slowing the whole section costs little. Keeps what is quicker
  /// than `best_`.
  void plan_under_ceilings(ProgressScope& pulse);
  /// Lowers the ceilings of the cells that exceed a limit.
  void lower_ceilings();

  /// The same window by window; `from` … `to` is the share of progress. False: some window came to nothing, and the
  /// grid at hand is the section's again.
  bool plan_windows(std::size_t window, double from, double to);

  /// Makes about so many cells of the section's from `begin` on the grid at hand, to be passed from `entry_` to rest;
  /// more, if the rest would slow most of them. Returns how many.
  std::size_t take_window(std::size_t begin, std::size_t cells);

  /// How much faster than the law that the window before threw away this one passes the same place.
  double speed_up() const;

  /// Of the last nodes before which the rest at the window's end slows nothing, one about which no limit is exceeded
  /// between the nodes, or as little as anywhere. O(1).
  std::size_t calm_node() const;

  /// Throws away what the rest at the window's end slows: what is left ends in motion.
  void leave();

  /// Lets a first guess follow what the window before found, and blend over into its own.
  void follow();

  /// Solves the grid at hand from the given start. Returns the duration of the law slowed by `slow_`, infinite if it
  /// came to nothing.
  double attempt(Start start, ProgressScope& pulse);

  /// Solves, looks between the nodes, and solves again with a smaller gap.
  void improve(double mu, ProgressScope& pulse);

  /// `at`: a station of the grid or a point of the path.
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

  /// Largest v² per node: velocity limits, feeds, joints.
  void caps(LargeVector<double>& cap, ProgressScope& pulse) const;

  /// The first (or last) inner Bernstein coefficient that the limits on v² leave a cell: of φ(s) it is φ ± h/3 φ′, and
  /// never needs to be below both ends' values.
  double cell_cap(std::size_t c, bool at_end) const;

  /// The largest path acceleration at a place passed with at most this v².
  double steepest(const Station<N>& at, double b) const;

  void rough(ProgressScope& pulse);

  /// Cells in the midst of a stretch that the rough profile passes at one speed, far from every limit: `steady_`.
  void find_steady();

  /// Nodes where the law needs them, by a rough profile.
  void lay(ProgressScope& pulse);

  /// Parts of equal length take unequal times where the law gathers speed: marks those that take much longer than they
  /// should. False = there are none.
  bool mark_long();

  /// What the solver may do with jerk: no more than takes an axis from one limit of its acceleration to the other in a
  /// quarter of a mean cell that is not steady. A larger jerk gains nothing that the grid could show, and without any
  /// limit along some axis the law would swing between the nodes.
  void soften();

  /// From the rough profile of the grid as it is; part 0: rest to rest by one bow, v² ~ (s (L − s)/L)^(4/3).
  void guess(Start start, ProgressScope& pulse);

  /// The part of the jerk limits that a cell may use at most: beside a needle point an eighth of the least one along
  /// the path. From rest v a = 3 j s and v³ = 4.5 j s², so what turns there unseen takes up to five times j.
  double needle_part(std::size_t c) const;
  void pose(ProgressScope& pulse);

  /// Rows for the acceleration between nodes: in long cells, and, once there is a law to look at, where an axis comes
  /// near its limit.
  void pose_middles(bool looked, ProgressScope& pulse);

  void add_node(std::size_t node, const JerkStation<M>& s, const std::array<double, M>& inverse);

  /// How long the law at hand takes for a cell, s.
  double duration(std::size_t c) const { return jerk_piece(state_[c], state_[c + 1], grid_.length(c)).duration; }

  /// Where acceleration rises from rest or in a trough of v² the law stays slower for all that follows: the part of the
  /// cell's duration that a jerk as large as allowed would save, if the change of acceleration is one worth a node.
  double slack_ramp(std::size_t c, double change, double jerk) const;

  /// Where the law switches inside a cell its jerk ramps instead of jumping: a deficit of speed that lasts for about
  /// a/j. Estimates what that costs and marks cells for division until the sum stays below the tolerance. False =
  /// nothing to divide.
  bool mark(ProgressScope& pulse);

  /// Divides the grid and carries the law over.
  void refine(ProgressScope& pulse);

  double feed(std::size_t c) const { return std::min(feed_[grid_.cells[c].segment], options_.path.velocity); }

  struct Worst {
    double v = 0, a = 0, j = 0;
  };

  /// The path within every curved cell, from its middle and ends, for measure().
  void look_half_way(ProgressScope& pulse);

  /// The place of a segment at which the path is looked at where a law is at `s`: no nearer to a cusp than path length
  /// resolves.
  double looked_at(std::size_t segment, double s) const {
    constexpr double nearest = 64 * std::numeric_limits<double>::epsilon();
    const Segment& on = path_[segment];
    const double length = on.length(), begin = on.cusp_begin() ? nearest * length : 0;
    if (on.cusp_end()) s = std::min(s, on.travelled(on.curve().end()) - nearest * length);
    return std::max(s, begin);
  }

  /// Peaks of a cell, from samples and against what the solver may use; `exact`: of the path itself, against the true
  /// limits.
  CellPeaks<M> peaks_of(std::size_t cell, bool exact) const;
  /// Of every cell.
  void measure(bool exact, ProgressScope& pulse);

  /// Continuous peaks on the path itself wherever samples leave a doubt, and what holds at nodes alone: afterwards
  /// `worst_` is what the section has to be slowed by. Positions are rounded as those of the finished law are: on
  /// micrometres far from the path's begin that noise shows, and the peaks' outer bounds contain it.
  void certify(ProgressScope& pulse);

  void raise(const CellPeaks<M>& peaks) {
    worst_.v = std::max(worst_.v, peaks.velocity);
    for (std::size_t k = 0; k < M; ++k) {
      worst_.a = std::max(worst_.a, peaks.acceleration[k]);
      worst_.j = std::max(worst_.j, peaks.jerk[k]);
    }
  }

  /// Marks cells for division, besides those that are marked, in which shares of the limit of jerk do not help. False =
  /// there are none.
  bool stubborn();

  /// Cells that exceed a limit between their nodes get a smaller share of it, by so many times the excess; of
  /// accelerations, if these are looked at.
  void tighten(double times, bool acceleration);

  /// Appends the law's pieces to `pieces_`, and finds by how much they have to be slowed for what still exceeds a
  /// limit. Returns their duration then, infinite if they are no law.
  double emit(ProgressScope& pulse);

  const LanePath<N>& path_;
  const Machine& machine_;
  const JerkLimitedOptions& options_;
  const std::vector<double>& feed_;
  const Sections& sections_;
  Progress& progress_;
  RowLimits<M> limit_, soft_;
  /// In which jerk brings an axis to its full acceleration, s: the shortest, and that of those axes next to whose time
  /// others are no time at all. An axis whose jerk is limited by a thousand times as much as another's would have the
  /// whole grid follow it, for nothing.
  double shortest_jerk_time_ = 0, jerk_time_ = 0;
  Grid<N> grid_, section_grid_;  // at hand, and the section's when that is a window of it
  RoughProfile rough_, section_rough_;
  JerkNode entry_, exit_;  // states at both ends: rest but in windows
  static constexpr std::size_t all_cells = std::numeric_limits<std::size_t>::max();
  double share_ = jerk_section_detail::full_share;
  LargeVector<double> ceiling_;   // of v² per node of the grid at hand; empty: none
  bool divides_ = true;           // cells in which the law switches
  std::size_t keep_ = all_cells;  // cells of a window that the rest at its end does not slow
  /// Whether caps of nodes leave the cells beside them more room (pose()), and whether they may not: the solver
  /// diverged.
  bool wider_caps_ = false, strict_caps_ = false;
  double overlap_ = 1, sped_up_ = 1;        // of windows, in what is hoped for; what it was too short for
  LargeVector<JerkNode> tail_, next_tail_;  // what the window before, and this one, found behind these
  LargeVector<double> cap_, loss_, longest_;
  LargeVector<std::uint8_t> steady_;
  LargeVector<Division> division_;
  LargeVector<JerkNode> state_, before_;  // as solved, and before
  JerkProblem<M> problem_;
  JerkSolver<M> solver_;
  LargeVector<CellPath<M>> shape_;  // of curved cells
  LargeVector<CellPeaks<M>> peaks_;
  bool certain_ = false;  ///< whether these are the path's own, of the states at hand, against the true limits
  Worst worst_;
  LargeVector<LawPiece> pieces_, best_;
  double slow_ = 1, best_duration_ = unlimited, best_slow_ = 1, work_ = 0;
};

}  // namespace bahnwerk
