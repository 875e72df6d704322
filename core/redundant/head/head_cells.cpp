#include "core/redundant/head/head_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numeric/peak.hpp"

namespace bahnwerk {
namespace {

constexpr double rounding = 1e-12;  // relative widening of ranges
constexpr double jump = 1e-9;       // least jump of an acceleration, relative to the head's limit

/// Position, velocity and acceleration of one axis.
struct State {
  double x, v, a, j;
};

/// Returns the range of the Bernstein coefficients of the polynomial through the samples, which encloses the
/// polynomial.
Range hull(const std::array<double, ChebyshevRule::max_points>& samples, const ChebyshevRule& rule) {
  const auto n = static_cast<std::size_t>(rule.points);
  Range r{samples[0], samples[0]};
  for (std::size_t i = 0; i < n; ++i) {
    double b = 0;
    for (std::size_t k = 0; k < n; ++k) b += rule.bernstein[i][k] * samples[k];
    r.lowest = std::min(r.lowest, b);
    r.highest = std::max(r.highest, b);
  }
  return r;
}

Range hull(const Range& a, const Range& b) { return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)}; }

Range within(const Range& r, double limit) {
  return {std::clamp(r.lowest, -limit, limit), std::clamp(r.highest, -limit, limit)};
}

class Division {
 public:
  Division(const PathMotion& head, const HeadCellOptions& options, ProgressScope& scope)
      : head_(head), options_(options), scope_(scope), axes_(head.axes()), now_(axes_), part_(axes_), both_(axes_) {
    cells_.nodes.resize(axes_);
    cells_.cells.resize(axes_);
  }

  HeadCells run(std::size_t first, std::size_t last) {
    // Entries that are not needed are never written.
    const double longest = (head_.end(last - 1) - head_.begin(first)) / options_.longest;
    reserve(last - first + static_cast<std::size_t>(std::min(longest, 1e7)) + 2);
    for (std::size_t i = first; i < last; ++i) {
      const double begin = head_.begin(i), end = head_.end(i);
      if (!(end > begin)) continue;
      const auto parts = static_cast<std::size_t>(std::ceil((end - begin) / options_.longest * (1 - 1e-9)));
      for (std::size_t k = 0; k < std::max<std::size_t>(parts, 1); ++k) {
        const double n = static_cast<double>(std::max<std::size_t>(parts, 1));
        add(i, begin + (end - begin) * (static_cast<double>(k) / n),
            k + 1 >= parts ? end : begin + (end - begin) * (static_cast<double>(k + 1) / n));
      }
    }
    close();
    const double end = head_.end(last - 1);
    const MotionState state = last == head_.pieces() ? head_.final_state() : head_.in_piece(last - 1, end);
    cells_.times.push_back(end);
    for (std::size_t a = 0; a < axes_; ++a) cells_.nodes[a].push_back({state[0][a], state[1][a], state[2][a]});
    return std::move(cells_);
  }

 private:
  void reserve(std::size_t count) {
    cells_.times.reserve(count);
    cells_.pieces.reserve(count);
    for (std::size_t a = 0; a < axes_; ++a) cells_.nodes[a].reserve(count), cells_.cells[a].reserve(count);
  }

  /// Adds the part [begin, end] of a piece to the open cell or to a new one, and halves it while accelerations differ
  /// too much.
  void add(std::size_t piece, double begin, double end, int halvings = 10) {
    scope_.work(10);
    const ChebyshevRule& rule = lobatto_rule(5);
    std::array<State, 5 * max_axes>
        states;  // NOLINT(cppcoreguidelines-pro-type-member-init); of axis a at node k: [k · axes + a]
    for (std::size_t k = 0; k < 5; ++k) evaluate(piece, begin + rule.node[k] * (end - begin), &states[k * axes_]);
    const State *first_state = states.data(), *last_state = &states[4 * axes_];
    std::vector<HeadCell>& part = part_;
    for (std::size_t a = 0; a < axes_; ++a) {
      std::array<double, ChebyshevRule::max_points> samples{}, jerks{};
      for (std::size_t k = 0; k < 5; ++k) {
        samples[k] = states[k * axes_ + a].a;
        jerks[k] = states[k * axes_ + a].j;
      }
      part[a] = {within(hull(samples, rule), options_.held[a].acceleration),
                 within(hull(jerks, rule), options_.held[a].jerk)};
    }
    const bool wide = !narrow(part, end - begin);
    if (const double middle = begin + 0.5 * (end - begin); wide && halvings > 0 && middle > begin && middle < end) {
      add(piece, begin, middle, halvings - 1);
      add(piece, middle, end, halvings - 1);
      return;
    }
    const std::array<State, max_axes> before = before_;
    std::copy(last_state, last_state + axes_, before_.begin());
    if (open_ && end - begin_ <= options_.longest && !jumps(before.data(), first_state)) {
      for (std::size_t a = 0; a < axes_; ++a)
        both_[a] = {hull(now_[a].acceleration, part[a].acceleration), hull(now_[a].jerk, part[a].jerk)};
      if (narrow(both_, end - begin_)) {
        now_ = both_;
        return;
      }
    }
    const bool first = cells_.times.empty();
    close();
    open_ = true;
    begin_ = begin;
    now_ = part;
    cells_.times.push_back(begin);
    cells_.pieces.push_back(piece);
    for (std::size_t a = 0; a < axes_; ++a)
      cells_.nodes[a].push_back({first_state[a].x, first_state[a].v, first_state[a].a,
                                 first ? 0 : first_state[a].v - before[a].v,
                                 first ? 0 : first_state[a].a - before[a].a});
  }

  /// Evaluates a piece like PathMotion::in_piece(), for the machine's axes only.
  void evaluate(std::size_t piece, double t, State* out) const {
    std::array<double, 4 * max_axes> q;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled as far as it is read
    const LawState x = head_.along(piece, t);
    head_.path().write_at(head_.law().pieces()[piece].segment, x.s, q.data());
    const double v2 = x.v * x.v, v3 = v2 * x.v;
    for (std::size_t a = 0; a < axes_; ++a) {
      const double d1 = q[axes_ + a], d2 = q[2 * axes_ + a], d3 = q[3 * axes_ + a];
      out[a] = {q[a], d1 * x.v, d2 * v2 + d1 * x.a, d3 * v3 + 3 * x.v * x.a * d2 + d1 * x.j};
    }
  }

  /// Tells whether an acceleration jumps although jerk is limited.
  bool jumps(const State* before, const State* after) const {
    for (std::size_t a = 0; a < axes_; ++a)
      if (options_.jerk_range[a] < unlimited &&
          std::abs(after[a].a - before[a].a) > jump * options_.held[a].acceleration)
        return true;
    return false;
  }

  bool narrow(const std::vector<HeadCell>& cell, double span) const {
    for (std::size_t a = 0; a < axes_; ++a)
      if (cell[a].acceleration.width() > options_.acceleration_change[a] ||
          cell[a].jerk.width() * span > options_.jerk_change[a] || cell[a].jerk.width() > options_.jerk_range[a])
        return false;
    return true;
  }

  void close() {
    if (!open_) return;
    for (std::size_t a = 0; a < axes_; ++a) {
      HeadCell cell = now_[a];
      const auto widen = [](Range& r) {
        const double by = rounding * std::max(std::abs(r.lowest), std::abs(r.highest));
        r.lowest -= by;
        r.highest += by;
      };
      widen(cell.acceleration);
      widen(cell.jerk);
      cells_.cells[a].push_back(cell);
    }
    open_ = false;
  }

  const PathMotion& head_;
  const HeadCellOptions& options_;
  ProgressScope& scope_;
  std::size_t axes_;
  HeadCells cells_;
  bool open_ = false;
  double begin_ = 0;
  std::array<State, max_axes> before_{};  // at the end of what was added last
  std::vector<HeadCell> now_, part_, both_;
};

}  // namespace

HeadCells head_cells(const PathMotion& head, const HeadCellOptions& options, ProgressScope& scope) {
  return Division(head, options, scope).run(0, head.pieces());
}

HeadCells head_cells(const PathMotion& head, std::size_t first, std::size_t last, const HeadCellOptions& options,
                     ProgressScope& scope) {
  return Division(head, options, scope).run(first, last);
}

}  // namespace bahnwerk
