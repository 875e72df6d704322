#include "core/motion/jerk_limited.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/motion/jerk_grid.hpp"
#include "core/motion/jerk_peaks.hpp"
#include "core/motion/jerk_solver.hpp"
#include "core/motion/profile.hpp"
#include "core/numeric/peak.hpp"

namespace bahnwerk {

namespace {

/// A cell that lasts this part of A/J gets rows for the acceleration half-way.
constexpr double middle_from = 0.15, near_limit = 0.8;

/// The solver may use this part of every limit; what lies below `sure` between the nodes needs no closer look.
constexpr double full_share = 1 - 2e-5, sure = 1 - 1e-5;
/// A law that had to be slowed by more than this may have a better start.
constexpr double good_enough = 1.01;

/// N axes, M rows: one more when the path itself is limited.
template <int N, int M>
class JerkRunPlanner {
 public:
  JerkRunPlanner(const Contour& contour, const Machine& machine, const JerkLimitedOptions& options,
                 const std::vector<double>& feed, const Runs& runs, Progress& progress)
      : path_(contour.path), machine_(machine), options_(options), feed_(feed), runs_(runs), progress_(progress) {
    for (std::size_t k = 0; k < M; ++k) {
      const bool axis = k < N;
      const double V = axis ? machine.axes[k].velocity : options.path.velocity;
      limit_.inverse_velocity2[k] = 1 / (V * V);
      limit_.inverse_acceleration[k] = 1 / (axis ? machine.axes[k].acceleration : options.path.acceleration);
      limit_.inverse_jerk[k] = 1 / (axis ? machine.axes[k].jerk : options.path.jerk);
      if (axis && std::isfinite(machine.axes[k].jerk))
        jerk_time_ = std::min(jerk_time_, machine.axes[k].acceleration / machine.axes[k].jerk);
    }
    if (!std::isfinite(jerk_time_)) jerk_time_ = 0;
  }

  void plan(std::size_t first, std::size_t last, double from, double to, JerkLimitedResult& result) {
    PlanningPulse pulse(progress_, from, to);
    pulse.part(0, 0.1);
    if (last == first + 1 && alone(first, result)) return;
    double shortest = unlimited;
    for (const Start start : {Start{0.7, 0.3}, Start{0.2, 1}, Start{0.02, 1}, Start{0, 0}}) {
      // The last one is no optimum at all, but always a law.
      if (start.part == 0 && shortest < unlimited) break;
      const double duration = attempt(first, last, start, pulse);
      if (duration < shortest) {
        shortest = duration;
        best_ = pieces_;
      }
      if (slow_ < good_enough) break;
    }
    result.law.reserve(best_.size());
    for (const LawPiece& p : best_) result.law.append(p);
    result.cells += grid_.cells.size();
    result.iterations += static_cast<std::size_t>(work_ / static_cast<double>(grid_.cells.size()) + 0.5);
  }

 private:
  /// Where the interior-point method starts: which part of the rough profile's v², and the barrier.
  struct Start {
    double part, mu;
  };

  /// A straight segment alone between two rests has a closed form.
  bool alone(std::size_t segment, JerkLimitedResult& result) {
    const Segment& line = path_[segment];
    if (!line.straight()) return false;
    const PathPoint p = line.at_parameter(line.curve().begin());
    ProfileLimits limits{std::min(feed_[segment], options_.path.velocity), options_.path.acceleration,
                         options_.path.jerk, unlimited};
    for (std::size_t k = 0; k < N; ++k) {
      const double t = std::abs(p.d1[k]);
      if (t == 0) continue;
      limits.velocity = std::min(limits.velocity, machine_.axes[k].velocity / t);
      limits.acceleration = std::min(limits.acceleration, machine_.axes[k].acceleration / t);
      limits.jerk = std::min(limits.jerk, machine_.axes[k].jerk / t);
    }
    if (!std::isfinite(limits.jerk)) return false;  // its acceleration would jump
    append(result.law, straight_profile(line.length(), 0, 0, limits), line.s0(), segment);
    ++result.cells;
    return true;
  }

  /// Solves the run from the given start; its pieces then hold all limits. Their duration, infinite if it came to
  /// nothing.
  double attempt(std::size_t first, std::size_t last, Start start, PlanningPulse& pulse) {
    GridOptions grid;
    grid.angle = options_.angle;
    grid.hermite = 1e-5;
    pulse.half_of_rest();
    grid_.build(path_, first, last, feed_, machine_, grid, pulse);
    lay(pulse);
    state_.resize(grid_.cells.size() + 1);
    soften(pulse);
    guess(start.part, pulse);
    if (start.mu > 0) improve(start.mu, pulse);
    if (start.mu == 0) pose(pulse);
    certify(pulse);
    return emit(pulse);
  }

  /// Solves, looks between the nodes, and solves again with a smaller gap.
  void improve(double mu, PlanningPulse& pulse) {
    JerkSolverOptions solver;
    double reach = 3e-2;
    int division = 0;
    bool fresh = true;
    for (int round = 0;; ++round) {
      pulse.half_of_rest();
      if (mu > 0) {
        pose(pulse);
        fresh = true;
      }
      solver.gap = solver.violation = reach;
      const JerkSolverResult r = solver_.solve(problem_, state_, mu, solver, pulse);
      work_ += r.iterations * static_cast<double>(grid_.cells.size());
      if (!std::isfinite(r.duration)) return;
      mu = 0;
      if (reach > 1e-3 && reach < 1e-2 && division < options_.max_divisions && mark(pulse)) {
        ++division;
        refine(pulse);
        mu = std::max(10 * r.mu, 1e-2);
        continue;
      }
      measure(soft_, pulse);
      if (fresh) pose_middles(true, pulse);
      fresh = false;
      // What is left slows the run by its half (v², a) or third (j) power.
      if (reach <= options_.gap &&
          (round >= options_.max_rounds ||
           (std::max(worst_.v, worst_.a) < 1 + 4 * options_.gap && worst_.j < 1 + 4 * options_.gap)))
        break;
      tighten();
      reach = std::max(0.1 * reach, options_.gap);
    }
  }

 private:
  JerkStation<M> rows_of(const Station<N>& s) const {
    JerkStation<M> r;
    for (std::size_t k = 0; k < N; ++k) {
      r.d1[k] = s.d1[k];
      r.d2[k] = s.d2[k];
      r.d3[k] = s.d3[k];
    }
    if constexpr (M > N) r.d1[N] = 1;
    return r;
  }

  bool joint(std::size_t node) const {
    return node > 0 && node < grid_.cells.size() && grid_.cells[node].segment != grid_.cells[node - 1].segment;
  }

  /// Largest v² per node: velocity limits, feeds, joints.
  void caps(LargeVector<double>& cap, PlanningPulse& pulse) const {
    const std::size_t n = grid_.cells.size();
    cap.assign(n + 1, unlimited);
    for (std::size_t c = 0; c < n; ++c) {
      pulse(c, n);
      const double f = std::min(feed_[grid_.cells[c].segment], options_.path.velocity);
      for (const std::size_t e : {std::size_t{0}, std::size_t{1}}) {
        const Station<N>& s = e ? grid_.right(c) : grid_.left(c);
        double most = f * f;
        for (std::size_t k = 0; k < N; ++k) {
          const double t = s.d1[k] * s.d1[k] * limit_.inverse_velocity2[k];
          if (t * most > 1) most = 1 / t;
        }
        cap[c + e] = std::min(cap[c + e], most);
      }
      if (joint(c)) {
        cap[c] = std::min(cap[c], runs_.joint_cap[grid_.cells[c].segment]);

        for (std::size_t k = 0; k < N; ++k) {
          const double step = std::abs(grid_.left(c).d2[k] - grid_.right(c - 1).d2[k]) * limit_.inverse_jerk[k];
          if (step * cap[c] > machine_.cycle_time) cap[c] = machine_.cycle_time / step;
        }
      }
    }
    cap[0] = cap[n] = 0;
  }

  /// The first (or last) inner Bernstein coefficient that the limits on v² leave a cell: of φ(s) it is φ ± h/3 φ′, and
  /// never needs to be below both ends' values.
  double cell_cap(std::size_t c, bool at_end) const {
    const Station<N>&l = grid_.left(c), &r = grid_.right(c), &s = at_end ? r : l;
    const double f = std::min(feed_[grid_.cells[c].segment], options_.path.velocity),
                 h = at_end ? l.s - r.s : r.s - l.s;
    double cap = f * f;
    for (std::size_t k = 0; k < N; ++k) {
      const double least = limit_.inverse_velocity2[k] * std::max(l.d1[k] * l.d1[k], r.d1[k] * r.d1[k]);
      if (least * cap <= 1) continue;
      const double t = s.d1[k] * s.d1[k] * limit_.inverse_velocity2[k];
      // φ = 1/t, φ′ = −2 φ h″/h′
      const double sloped = t > 0 ? (1 - (2.0 / 3) * h * s.d2[k] / s.d1[k]) / t : 0;
      cap = std::min(cap, std::max(sloped, 1 / least));
    }
    return cap;
  }

  void rough(PlanningPulse& pulse) {
    caps(cap_, pulse);
    rough_profile<N>(grid_, feed_, machine_, options_.path, cap_, rough_, pulse);
  }

  /// Nodes where the law needs them, by a rough profile.
  void lay(PlanningPulse& pulse) {
    rough(pulse);
    const std::size_t n = grid_.cells.size();
    double total = 0;
    for (const double t : rough_.duration) total += t;
    division_.assign(n, {});
    for (std::size_t c = 0; c < n; ++c) {
      const bool straight = grid_.cells[c].straight;
      const bool rest_left = c == 0, rest_right = c + 1 == n;
      const double t = rough_.duration[c];
      const double tau = std::min(std::max(jerk_time_ / 6, straight ? t / 40 : t), total / 40);
      int parts = static_cast<int>(std::clamp(std::ceil(t / tau), 1.0, 64.0));
      if (rest_left || rest_right) parts = std::max(parts, 4);
      division_[c] = {static_cast<std::uint16_t>(parts), rest_left && rest_right ? Spread::both
                                                         : rest_left             ? Spread::from_rest
                                                         : rest_right            ? Spread::to_rest
                                                                                 : Spread::even};
    }
    divide<N>(grid_, path_, division_, pulse);
  }

  /// What the solver may do with jerk: no more than takes an axis from one limit of its acceleration to the other in a
  /// quarter of a mean cell. A larger jerk gains nothing that the grid could show, and without any limit along some
  /// axis the law would swing between the nodes.
  void soften(PlanningPulse& pulse) {
    rough(pulse);
    double total = 0;
    for (const double t : rough_.duration) total += t;
    const double mean = total / static_cast<double>(grid_.cells.size());
    soft_ = limit_;
    for (std::size_t k = 0; k < M; ++k)
      soft_.inverse_jerk[k] = std::max(limit_.inverse_jerk[k], 0.125 * mean * limit_.inverse_acceleration[k]);
  }

  /// From the rough profile; part 0: rest to rest by one bow, v² ~ (s (L − s)/L)^(4/3).
  void guess(double part, PlanningPulse& pulse) {
    rough(pulse);
    const std::size_t n = grid_.cells.size();
    const auto& b = rough_.b;
    for (std::size_t i = 1; i < n; ++i) {
      const double l = grid_.length(i - 1), r = grid_.length(i);
      state_[i].b = part * b[i];
      state_[i].a = 0.5 * part * ((b[i] - b[i - 1]) * r / l + (b[i + 1] - b[i]) * l / r) / (l + r);
    }
    state_[0] = state_[n] = {};
    if (part > 0) return;
    double L = 0, s = 0;
    for (std::size_t c = 0; c < n; ++c) L += grid_.length(c);
    for (std::size_t i = 1; i < n; ++i) {
      s += grid_.length(i - 1);
      const double x = s * (L - s) / L, root = std::cbrt(x);
      state_[i] = {x * root, (2.0 / 3) * root * (L - 2 * s) / L};
    }
    state_[1].a = rest_tie(grid_.length(0)) * state_[1].b;
    state_[n - 1].a = -rest_tie(grid_.length(n - 1)) * state_[n - 1].b;
  }

  void pose(PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size();
    caps(cap_, pulse);
    problem_.inverse_jerk = soft_.inverse_jerk;
    problem_.inverse_cap.resize(n + 1);
    for (std::size_t i = 1; i < n; ++i)
      problem_.inverse_cap[i] = {1 / (full_share * std::min(cap_[i], cell_cap(i - 1, true))),
                                 1 / (full_share * std::min(cap_[i], cell_cap(i, false)))};
    problem_.stations.clear();
    for (const auto& s : grid_.stations) problem_.stations.push_back(rows_of(s));
    problem_.cells.resize(n);
    problem_.nodes.clear();
    problem_.middles.clear();
    for (std::size_t c = 0; c < n; ++c) {
      pulse(c, n);
      auto& cell = problem_.cells[c];
      cell.h = grid_.length(c);
      cell.station = grid_.cells[c].station;
      for (auto& share : cell.share) share.fill(full_share);
      const JerkStation<M>& s = problem_.stations[cell.station];
      if (c > 0) {
        add_node(c, s, limit_.inverse_acceleration);
        if (joint(c)) {
          const JerkStation<M>& before = problem_.stations[problem_.cells[c - 1].station + 1];
          add_node(c, before, limit_.inverse_acceleration);
          JerkStation<M> step;
          std::array<double, M> inverse{};
          for (std::size_t k = 0; k < N; ++k) {
            step.d1[k] = s.d1[k] - before.d1[k];
            step.d2[k] = s.d2[k] - before.d2[k];
            inverse[k] = limit_.inverse_jerk[k] / machine_.cycle_time;
          }
          add_node(c, step, inverse);
        }
      }
    }
    pose_middles(false, pulse);
  }

  /// Rows for the acceleration between nodes: in long cells, and, once there is a law to look at, where an axis comes
  /// near its limit.
  void pose_middles(bool looked, PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size();
    problem_.middles.clear();
    const auto near = [&](std::size_t c) {
      for (const double a : peaks_[c].acceleration)
        if (a > near_limit) return true;
      return false;
    };
    for (std::size_t c = 1; c + 1 < n; ++c) {
      pulse(c, n);
      if (duration(c) < middle_from * jerk_time_ && !(looked && (near(c - 1) || near(c) || near(c + 1)))) continue;
      const JerkStation<M>&s = problem_.stations[problem_.cells[c].station],
            &r = problem_.stations[problem_.cells[c].station + 1];
      const double h = problem_.cells[c].h;
      MiddleRows<M> m;
      m.cell = c;
      m.share.fill(full_share);
      for (std::size_t k = 0; k < M; ++k) {
        const double i = limit_.inverse_acceleration[k];
        m.d1[k] = (0.5 * (s.d1[k] + r.d1[k]) + h * 0.125 * (s.d2[k] - r.d2[k])) * i;
        m.d2[k] = (0.25 * (s.d2[k] + r.d2[k]) + h * 0.0625 * (s.d3[k] - r.d3[k])) * i;
      }
      problem_.middles.push_back(m);
    }
  }

  void add_node(std::size_t node, const JerkStation<M>& s, const std::array<double, M>& inverse) {
    NodeRows<M> rows;
    rows.node = node;
    rows.share.fill(full_share);
    for (std::size_t k = 0; k < M; ++k) {
      rows.p[k] = s.d2[k] * inverse[k];
      rows.q[k] = s.d1[k] * inverse[k];
    }
    problem_.nodes.push_back(rows);
  }

  /// How long the law at hand takes for a cell, s.
  double duration(std::size_t c) const { return jerk_piece(state_[c], state_[c + 1], grid_.length(c)).duration; }

  /// Where acceleration rises from rest or in a trough of v² the law stays slower for all that follows: the part of the
  /// cell's duration that a jerk as large as allowed would save, if the change of acceleration is one worth a node.
  double slack_ramp(std::size_t c, double change, double jerk) const {
    const PathLimits here = path_limits<N>(grid_.left(c), machine_, options_.path, unlimited);
    if (change < 0.2 * here.acceleration) return 0;
    double used = 0;  // of the jerk that the solver may use
    for (std::size_t k = 0; k < N; ++k)
      used = std::max(used, jerk * std::abs(grid_.left(c).d1[k]) * soft_.inverse_jerk[k]);
    if constexpr (M > N) used = std::max(used, jerk * soft_.inverse_jerk[N]);
    return std::min(1.0, change / here.acceleration) * std::max(0.0, 1 - 1.02 * used);
  }

  /// Where the law switches inside a cell its jerk ramps instead of jumping: a deficit of speed that lasts for about
  /// a/j. Estimates what that costs and marks cells for division until the sum stays below the tolerance. False =
  /// nothing to divide.
  bool mark(PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size();
    loss_.assign(n, 0);
    double time = 0, total = 0;
    for (std::size_t c = 0; c < n; ++c) {
      pulse(c, n);
      const LawPiece p = jerk_piece(state_[c], state_[c + 1], grid_.length(c));
      const double T = p.duration, change = std::abs(p.q) * T, end = p.a + T * (p.j + 0.5 * T * p.q);
      const double jerk = std::max(std::abs(p.j), std::abs(p.j + T * p.q)), a = std::max(std::abs(p.a), std::abs(end));
      const double v = std::sqrt(std::max(state_[c].b, state_[c + 1].b));
      time += T;
      if (jerk > 0) loss_[c] = change * T * T / 24 * std::max(T, std::min(a / jerk, jerk_time_)) / v;
      const bool rest = c == 0 || c + 1 == n;
      if (rest || end > p.a) loss_[c] += (rest ? 0.5 : 0.125) * T * slack_ramp(c, std::abs(end - p.a), jerk);
      total += loss_[c];
    }
    const double bearable = options_.tolerance * time;
    if (total <= bearable) return false;
    std::size_t many = 0;
    for (const double l : loss_)
      if (l > bearable / static_cast<double>(n)) ++many;
    division_.assign(n, {});
    for (std::size_t c = 0; c < n; ++c) {
      if (loss_[c] <= 0.5 * bearable / static_cast<double>(many)) continue;
      division_[c] = {static_cast<std::uint16_t>(4), c == 0       ? Spread::from_rest
                                                     : c + 1 == n ? Spread::to_rest
                                                                  : Spread::even};
      if (c > 0 && division_[c - 1].parts == 1) division_[c - 1].parts = 2;
      if (c + 1 < n && division_[c + 1].parts == 1) division_[c + 1].parts = 2;
    }
    if (division_[0].parts > 1) division_[0].spread = Spread::from_rest;
    if (division_[n - 1].parts > 1) division_[n - 1].spread = Spread::to_rest;
    return true;
  }

  /// Divides the grid and carries the law over.
  void refine(PlanningPulse& pulse) {
    const LargeVector<GridCell> cells = grid_.cells;
    LargeVector<double> length(cells.size()), begin(cells.size()), ends(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      length[c] = grid_.length(c);
      begin[c] = grid_.left(c).s;
      ends[c] = grid_.right(c).s;
    }
    const LargeVector<JerkNode> old = state_;
    divide<N>(grid_, path_, division_, pulse);
    state_.resize(grid_.cells.size() + 1);
    std::size_t c = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      pulse(i, cells.size());
      const LawPiece law = jerk_piece(old[i], old[i + 1], length[i]);
      state_[c] = old[i];
      double t = 0;
      for (++c; c < grid_.cells.size() && grid_.cells[c].segment == cells[i].segment && grid_.left(c).s < ends[i];
           ++c) {
        const double s = grid_.left(c).s - begin[i];
        if (t == 0) t = law.duration * (s / length[i]);
        for (int step = 0; step < 20; ++step) {
          const LawState x = law.at(t);
          const double next = std::clamp(t + (s - x.s) / std::max(x.v, 1e-3 * s / law.duration), 0.0, law.duration);
          if (std::abs(next - t) <= 1e-9 * law.duration) break;
          t = next;
        }
        const LawState x = law.at(t);
        state_[c] = {x.v * x.v, x.a};
      }
    }
    state_[c] = old.back();
  }

  double feed(std::size_t c) const { return std::min(feed_[grid_.cells[c].segment], options_.path.velocity); }

  struct Worst {
    double v = 0, a = 0, j = 0;
  };

  JerkStation<M> rows_of(const PathPoint& p) const {
    JerkStation<M> r;
    for (std::size_t k = 0; k < N; ++k) {
      r.d1[k] = p.d1[k];
      r.d2[k] = p.d2[k];
      r.d3[k] = p.d3[k];
    }
    if constexpr (M > N) r.d1[N] = 1;
    return r;
  }

  /// Peaks of every cell, from samples.
  void measure(const RowLimits<M>& limit, PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size();
    peaks_.resize(n);
    worst_ = {};
    for (std::size_t c = 0; c < n; ++c) {
      pulse(c, n);
      const double h = grid_.length(c), f = feed(c);
      const LawPiece law = jerk_piece(state_[c], state_[c + 1], h);
      const JerkStation<M>&l = problem_.stations[problem_.cells[c].station],
            &r = problem_.stations[problem_.cells[c].station + 1];
      if (grid_.cells[c].straight) {
        peaks_[c] = cell_peaks<M>(law, h, limit, 1 / (f * f), [&](double, JerkStation<M>& out) { out = l; });
      } else {
        const Segment& segment = path_[grid_.cells[c].segment];
        const double um = 0.5 * (grid_.left(c).u + grid_.right(c).u);
        const CellPath<M> path(l, rows_of(segment.at_parameter(um)), r, segment.travelled(um) - grid_.left(c).s, h);
        peaks_[c] = cell_peaks<M>(law, h, limit, 1 / (f * f), [&](double s, JerkStation<M>& out) { path.at(s, out); });
      }
      raise(peaks_[c]);
    }
  }

  /// Continuous peaks on the path itself wherever samples leave a doubt, and what holds at nodes alone: afterwards
  /// `worst_` is what the run has to be slowed by. Positions are rounded as those of the finished law are: on
  /// micrometres far from the path's begin that noise shows, and the peaks' outer bounds contain it.
  void certify(PlanningPulse& pulse) {
    measure(limit_, pulse);
    worst_ = {};
    PeakSweep sweep(std::vector<double>(3 * M, 1.0));
    const std::size_t n = grid_.cells.size();
    for (std::size_t c = 0; c < n; ++c) {
      pulse(c, n);
      if (peaks_[c].doubt > sure) {
        LawPiece law = jerk_piece(state_[c], state_[c + 1], grid_.length(c));
        if (!(law.duration > 0) || !std::isfinite(law.duration)) continue;  // emit() refuses the run
        const Segment& segment = path_[grid_.cells[c].segment];
        law.s = segment.s0() + grid_.left(c).s;
        const bool open = grid_.cells[c].cusp_left || grid_.cells[c].cusp_right;
        sweep.sweep(0, law.duration, open, c, [&](const ChebyshevRule& rule, double begin, double end, double* values) {
          const auto points = static_cast<std::size_t>(rule.points);
          for (std::size_t i = 0; i < points; ++i) {
            const LawState x = law.at(begin + rule.node[i] * (end - begin));
            const JerkStation<M> d = rows_of(segment.at(x.s));
            const double b = x.v * x.v;
            for (std::size_t k = 0; k < M; ++k) {
              values[k * points + i] = d.d1[k] * d.d1[k] * b * limit_.inverse_velocity2[k];
              values[(M + k) * points + i] = (d.d2[k] * b + d.d1[k] * x.a) * limit_.inverse_acceleration[k];
              values[(2 * M + k) * points + i] =
                  (d.d3[k] * b * x.v + 3 * d.d2[k] * x.v * x.a + d.d1[k] * x.j) * limit_.inverse_jerk[k];
            }
          }
          return true;
        });
        const double f = feed(c);
        worst_.v = std::max(worst_.v, peak_speed2(law) / (f * f));
      } else {
        raise(peaks_[c]);
      }
      if (c > 0) worst_.v = std::max(worst_.v, state_[c].b / cap_[c]);
    }
    for (const auto& rows : problem_.nodes)
      for (std::size_t k = 0; k < M; ++k)
        worst_.a = std::max(worst_.a, std::abs(rows.p[k] * state_[rows.node].b + rows.q[k] * state_[rows.node].a));
    const auto bound = [](double peak) { return peak > 1 ? 1 + 1.5 * (peak - 1) : peak; };
    for (std::size_t k = 0; k < M; ++k) {
      worst_.v = std::max(worst_.v, bound(sweep[k].value));
      worst_.a = std::max(worst_.a, bound(sweep[M + k].value));
      worst_.j = std::max(worst_.j, bound(sweep[2 * M + k].value));
    }
  }

  void raise(const CellPeaks<M>& peaks) {
    worst_.v = std::max(worst_.v, peaks.velocity);
    for (std::size_t k = 0; k < M; ++k) {
      worst_.a = std::max(worst_.a, peaks.acceleration[k]);
      worst_.j = std::max(worst_.j, peaks.jerk[k]);
    }
  }

  /// Cells that exceed a limit between their nodes get a smaller share of it.
  void tighten() {
    const std::size_t n = grid_.cells.size();
    const auto less = [](double peak) { return peak > sure ? sure / (sure + 1.05 * (peak - sure)) : 1.0; };
    for (auto& rows : problem_.nodes) {
      for (std::size_t k = 0; k < M; ++k)
        rows.share[k] *= less(std::max(peaks_[rows.node - 1].acceleration[k], peaks_[rows.node].acceleration[k]));
    }
    for (auto& rows : problem_.middles)
      for (std::size_t k = 0; k < M; ++k) rows.share[k] *= less(peaks_[rows.cell].acceleration[k]);
    for (std::size_t c = 0; c < n; ++c) {
      for (auto& share : problem_.cells[c].share)
        for (std::size_t k = 0; k < M; ++k) share[k] *= less(peaks_[c].jerk[k]);
      if (c > 0) {
        problem_.inverse_cap[c][0] /= less(peaks_[c - 1].velocity);
        problem_.inverse_cap[c][1] /= less(peaks_[c].velocity);
      }
    }
  }

  /// The run's pieces, slowed by what still exceeds a limit. Returns their duration, infinite if they are no law.
  double emit(PlanningPulse& pulse) {
    const std::size_t n = grid_.cells.size();
    slow_ = 1;
    if (worst_.v > 1) slow_ = std::max(slow_, std::sqrt(worst_.v));
    if (worst_.a > 1) slow_ = std::max(slow_, std::sqrt(worst_.a));
    if (worst_.j > 1) slow_ = std::max(slow_, std::cbrt(worst_.j));
    if (slow_ > 1) slow_ *= 1 + 1e-12;
    pieces_.clear();
    pieces_.reserve(n);
    double total = 0;
    bool sound = std::isfinite(slow_);
    for (std::size_t c = 0; c < n; ++c) {
      pulse(c, n);
      const double h = grid_.length(c);
      LawPiece p = jerk_piece(state_[c], state_[c + 1], h);
      sound = sound && p.duration > 0 && std::abs(p.at(p.duration).s - h) <= 1e-9 * h;
      for (const double t : turning_points(p))
        if (t > 0 && t < p.duration) sound = sound && p.at(t).v > 0;
      p.segment = grid_.cells[c].segment;
      p.s = path_[p.segment].s0() + grid_.left(c).s;
      p.s_end = path_[p.segment].s0() + grid_.right(c).s;
      p.slow(slow_);
      total += p.duration;
      pieces_.push_back(p);
    }
    if (!sound || !std::isfinite(total)) slow_ = unlimited;
    return std::isfinite(slow_) ? total : unlimited;
  }

  const Path& path_;
  const Machine& machine_;
  const JerkLimitedOptions& options_;
  const std::vector<double>& feed_;
  const Runs& runs_;
  Progress& progress_;
  RowLimits<M> limit_, soft_;
  double jerk_time_ = unlimited;
  Grid<N> grid_;
  RoughProfile rough_;
  LargeVector<double> cap_, loss_;
  LargeVector<Division> division_;
  LargeVector<JerkNode> state_;
  JerkProblem<M> problem_;
  JerkSolver<M> solver_;
  LargeVector<CellPeaks<M>> peaks_;
  Worst worst_;
  LargeVector<LawPiece> pieces_, best_;
  double slow_ = 1, work_ = 0;
};

template <int N, int M>
JerkLimitedResult plan(const Contour& contour, const Machine& machine, const JerkLimitedOptions& options,
                       Progress& progress, double from, double to) {
  const std::vector<double> feed = contour.feeds();
  const Runs runs = find_runs(contour, machine, options.corner_angle);
  JerkLimitedResult result;
  JerkRunPlanner<N, M> planner(contour, machine, options, feed, runs, progress);
  const double length = contour.path.length();
  for (std::size_t i = 0; i + 1 < runs.begin.size(); ++i) {
    const auto fraction = [&](std::size_t segment) {
      return from + (to - from) * (segment < contour.path.size() ? contour.path[segment].s0() / length : 1);
    };
    planner.plan(runs.begin[i], runs.begin[i + 1], fraction(runs.begin[i]), fraction(runs.begin[i + 1]), result);
  }
  return result;
}

}  // namespace

JerkLimitedResult plan_jerk_limited(const Contour& contour, const Machine& machine, const JerkLimitedOptions& options,
                                    Progress& progress, double from, double to) {
  std::vector<InputFault> faults;
  for (const AxisLimits& axis : machine.axes)
    if (!(axis.velocity > 0) || !(axis.acceleration > 0) || !std::isfinite(axis.acceleration) || !(axis.jerk > 0))
      faults.push_back(
          {{"machine", "axes", axis.name}, "velocity, acceleration and jerk must be positive, acceleration finite"});
  const JerkPathOptions& along = options.path;
  if (!(along.velocity > 0) || !(along.acceleration > 0) || !(along.jerk > 0))
    faults.push_back({{"planning"}, "limits along the path must be positive"});
  if (!faults.empty()) throw InvalidInput(faults);
  const bool path = std::isfinite(options.path.acceleration) || std::isfinite(options.path.jerk);
  if (machine.dimension() == 2)
    return path ? plan<2, 3>(contour, machine, options, progress, from, to)
                : plan<2, 2>(contour, machine, options, progress, from, to);
  return path ? plan<3, 4>(contour, machine, options, progress, from, to)
              : plan<3, 3>(contour, machine, options, progress, from, to);
}

}  // namespace bahnwerk
