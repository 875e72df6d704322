#include "core/motion/acceleration/speed_chain.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/acceleration/spread.hpp"

namespace bahnwerk {

template <int N>
SpeedChain<N>::SpeedChain(const Grid<N>& grid, const std::vector<double>& feed, const Sections& sections,
                          const Machine& machine, std::optional<double> reserve)
    : grid_(grid), feed_(feed), sections_(sections), reserve_(reserve), limit_(machine) {}

/// Caps that need no neighbour: feed, axis velocity, limit curve, tangent jumps.
template <int N>
inline typename SpeedChain<N>::Caps SpeedChain<N>::caps(std::size_t c) const {
  const GridCell& cell = grid_.cells[c];
  const Station<N>&l = grid_.left(c), &r = grid_.right(c);
  const double feed = feed_[cell.segment], h = r.s - l.s;
  double left = std::min(max_, feed * feed), right = left, middle = left;
  for (std::size_t k = 0; k < N; ++k) {
    const double V2 = limit_.velocity2[k], tl = l.d1[k] * l.d1[k], tr = r.d1[k] * r.d1[k];
    if (V2 >= middle * std::max(tl, tr)) continue;  // the velocity limit is far above the cap
    const double vl = V2 / tl, vr = V2 / tr;
    left = std::min(left, vl);
    right = std::min(right, vr);
    if (!cell.straight)
      middle = std::min(middle, middle_cap(vl, -2 * vl * l.d2[k] / l.d1[k], vr, -2 * vr * r.d2[k] / r.d1[k], h));
  }
  if (reserve_ && !cell.straight) {
    for (std::size_t k = 0; k < N; ++k) {
      const double A = *reserve_ * limit_.acceleration[k];
      const double cl = A / std::abs(l.d2[k]), cr = A / std::abs(r.d2[k]);
      if (!cell.cusp_left) left = std::min(left, cl);
      if (!cell.cusp_right) right = std::min(right, cr);
      if (std::min(cl, cr) < middle)
        middle = std::min(middle, middle_cap(cl, -cl * l.d3[k] / l.d2[k], cr, -cr * r.d3[k] / r.d2[k], h));
    }
  }
  if (cell.straight) middle = std::min(left, right);
  return {first_cap(c, left), middle, right};
}

/// The cap at a cell's left end with what the joint there allows.
template <int N>
inline double SpeedChain<N>::first_cap(std::size_t c, double cap) const {
  if (c == 0 && !(entry_ > 0)) return 0;
  const std::uint32_t segment = grid_.cells[c].segment;
  return c == 0 || segment != grid_.cells[c - 1].segment ? std::min(cap, sections_.joint_cap[segment]) : cap;
}

template <int N>
double SpeedChain<N>::acceleration(std::size_t c) const {
  double a = unlimited;
  for (std::size_t k = 0; k < N; ++k) a = std::min(a, limit_.acceleration[k] / std::abs(grid_.left(c).d1[k]));
  return a;
}

template <int N>
Rows<N> SpeedChain<N>::rows_left(std::size_t c, double share, bool flip) const {
  return link(grid_.left(c), grid_.length(c), left_part(c) * share, flip, grid_.cells[c].segment);
}

template <int N>
Rows<N> SpeedChain<N>::rows_right(std::size_t c, double share, bool flip) const {
  return link(grid_.right(c), -grid_.length(c), right_part(c) * share, flip, grid_.cells[c].segment);
}

template <int N>
inline Rows<N> SpeedChain<N>::link(const Station<N>& at, double h, double share, bool flip, std::size_t segment) const {
  Rows<N> rows;
  if (flip)
    acceleration_rows<N, true>(rows, at, h, share, limit_);
  else
    acceleration_rows<N, false>(rows, at, h, share, limit_);
  if (reserve_) {
    const double a = reserve_limit<N>(at, limit_, feed_[segment], *reserve_).acceleration;
    if (std::isfinite(a)) rows.add(1 / h, -1 / h, a);
  }
  return rows;
}

template <int N>
double SpeedChain<N>::search_left(std::size_t c, double share, double cap_node, double cap_middle) const {
  return reach_backward(rows_left(c, share, false), cap_node, cap_middle);
}

template <int N>
double SpeedChain<N>::search_right(std::size_t c, double share, double cap_middle, double cap_node) const {
  return reach_backward(rows_right(c, share, true), cap_middle, cap_node);
}

/// Returns the controllable values at the cell's middle and left end if the right end allows `next`.
template <int N>
inline typename SpeedChain<N>::Stop SpeedChain<N>::step_back(std::size_t c, double share, const Caps& cap, double next,
                                                             Known& known) const {
  if (grid_.cells[c].straight) return {next, std::min(cap.left, next + 2 * acceleration(c) * grid_.length(c))};
  const double h = grid_.length(c);
  const std::size_t at = grid_.cells[c].station;
  if (known.at != at + 1) known.set(at + 1, PlainStation<N>(grid_.stations[at + 1], limit_));
  const PlainStation<N> begin(grid_.stations[at], limit_);
  const PlainLink<N> left(begin, h, share * left_part(c)), right(*known.station, h, share * right_part(c));
  known.set(at, begin);
  const double middle =
      right.plain() && !reserve_ ? right.backward_right(cap.middle, next) : search_right(c, share, cap.middle, next);
  return {middle,
          left.plain() && !reserve_ ? left.backward_left(cap.left, middle) : search_left(c, share, cap.left, middle)};
}

/// Returns them with the cell's caps; `next` is lowered to what the cell allows at its right end. Axis velocities are
/// evaluated only where the speed is above the least of them: |h'_k| ≤ 1.
template <int N>
typename SpeedChain<N>::Stop SpeedChain<N>::stop(std::size_t c, double share, double& next, Known& right) const {
  if (!reserve_ && !grid_.cells[c].straight) {
    const double feed = feed_[grid_.cells[c].segment], cap = std::min(max_, feed * feed);
    const double end = std::min(next, cap);
    if (end <= limit_.slowest2) {
      const Stop quick = step_back(c, share, {first_cap(c, cap), cap, cap}, end, right);
      if (std::max(quick.middle, quick.node) <= limit_.slowest2) {
        next = end;
        return quick;
      }
    }
  }
  const Caps cap = caps(c);
  next = std::min(next, cap.right);
  return step_back(c, share, cap, next, right);
}

/// Returns the cap of cell c at its right end, at most `speed2`.
template <int N>
double SpeedChain<N>::right_cap(std::size_t c, double speed2) const {
  if (reserve_ || speed2 > limit_.slowest2) return std::min(speed2, caps(c).right);
  const double feed = feed_[grid_.cells[c].segment];
  return std::min({speed2, max_, feed * feed});
}

template <int N>
double SpeedChain<N>::step_forward(std::size_t c, double share, Known& known) {
  const double h = grid_.length(c);
  if (grid_.cells[c].straight)
    return speed_[c + 1].node = std::min(speed_[c + 1].node_stop, speed_[c].node + 2 * acceleration(c) * h);
  const std::size_t at = grid_.cells[c].station;
  if (known.at != at) known.set(at, PlainStation<N>(grid_.stations[at], limit_));
  const PlainStation<N> end(grid_.stations[at + 1], limit_);
  const PlainLink<N> left(*known.station, h, share * left_part(c)), right(end, h, share * right_part(c));
  known.set(at + 1, end);
  const double cap = speed_[c].middle_stop, next = speed_[c + 1].node_stop;
  const double middle = left.plain() && !reserve_ ? left.forward_left(speed_[c].node, cap)
                                                  : reach_forward(rows_left(c, share, false), speed_[c].node, cap);
  speed_[c].middle = middle;
  return speed_[c + 1].node = right.plain() && !reserve_ ? right.forward_right(middle, next)
                                                         : reach_forward(rows_right(c, share, true), middle, next);
}

template <int N>
void SpeedChain<N>::start(double entry) {
  entry_ = entry;
  const std::size_t n = grid_.cells.size();
  speed_.resize(n + 1);
  double square = 0;  // |a| ≤ |A|, so v² can never exceed 2 |A| s: keeps everything finite
  for (std::size_t k = 0; k < N; ++k) square += limit_.acceleration[k] * limit_.acceleration[k];
  max_ = entry + 2 * std::sqrt(square) * grid_.section_length;
  speed_[n].node_stop = 0;
  speed_[0].node = entry;
}

template <int N>
std::size_t SpeedChain<N>::unaffected(const UnsetVector<double>& share) const {
  double next = unlimited;
  Known known;
  for (std::size_t c = grid_.cells.size(); c-- > 0;) {
    const Stop stop = this->stop(c, share[c], next, known);
    next = c > 0 ? std::min(stop.node, caps(c - 1).right) : stop.node;
    if (next == speed_[c].node_stop) return c;
  }
  return 0;
}

template <int N>
void SpeedChain<N>::divided(const LargeVector<std::uint8_t>& parts, ProgressScope& progress) {
  spread(speed_, parts, grid_.cells.size(), progress);
}

template <int N>
void SpeedChain<N>::update(const UnsetVector<double>& share, CellFlags& dirty, ProgressScope& progress) {
  const auto differs = [](double a, double b) { return std::abs(a - b) > 1e-14 * std::abs(b); };
  const std::size_t n = grid_.cells.size();
  bool moved = false;  // whether the right neighbour has changed
  Known known;
  for (std::size_t c = n; (c = moved ? (c > 0 ? c - 1 : no_flag) : last_set(dirty, c)) != no_flag;) {
    progress.work();
    const double node = speed_[c].node_stop, middle = speed_[c].middle_stop;
    const Stop stop = this->stop(c, share[c], speed_[c + 1].node_stop, known);
    speed_[c].middle_stop = stop.middle;
    speed_[c].node_stop = c > 0 ? right_cap(c - 1, stop.node) : stop.node;
    moved = differs(speed_[c].node_stop, node);
    if (moved || differs(speed_[c].middle_stop, middle)) dirty[c] = 1;
  }
  moved = false;
  known = {};
  for (std::size_t c = 0; c < n; ++c) {
    // A cell whose right neighbour may start slower than before has to be driven again, too.
    if (!moved && !dirty[c] && !(c + 1 < n && dirty[c + 1] != 0)) {
      const std::size_t next = first_set(dirty, c + 1);
      if (next == no_flag) break;
      c = next - 1;
    }
    progress.work();
    const double node = speed_[c + 1].node, middle = speed_[c].middle;
    step_forward(c, share[c], known);
    const bool changed = differs(speed_[c + 1].node, node);
    if (moved || changed || differs(speed_[c].middle, middle)) dirty[c] = 1;
    moved = changed;
  }
}

template class SpeedChain<2>;
template class SpeedChain<3>;
template class SpeedChain<5>;
template class SpeedChain<8>;

}  // namespace bahnwerk
