#include "core/motion/grid/grid.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/grow.hpp"

namespace bahnwerk {

namespace {

constexpr int max_parts = 16;  // cells made at once; an interval with more is halved first
constexpr int end_halvings = 4;
constexpr std::size_t usual_segment = 1 << 10;  // cells; longer ones may outgrow the memory that was reserved for them
constexpr double shortest_smooth =
    1e-5;  // shortest cell next to a vanishing tangent without effect on motions, as a part of a segment
constexpr double needle_reach = 2e-11;  // part of a segment beside a needle point for which cells may be too wide
constexpr double min_interval = 1e-6;   // part of a segment's parameter range at which grading towards a cusp ends

template <int N>
double distance(const Lanes<N>& a, const Lanes<N>& b) {
  return std::sqrt(sum((a - b) * (a - b)));
}

/// Lays the cells of one curved segment.
template <int N>
class Layer {
 public:
  Layer(Grid<N>& grid, const LanePath<N>& path, std::uint32_t index, const Machine& machine, double feed,
        const GridOptions& options)
      : grid_(grid), path_(path), segment_(path[index]), index_(index), feed2_(feed * feed), options_(options) {
    for (std::size_t k = 0; k < N; ++k)
      acceleration_[k] = machine.axes[k].acceleration, inverse_velocity_[k] = 1 / machine.axes[k].velocity;
    inverse_acceleration_ = 1 / acceleration_;
    // A lane that repeats an axis has its name; counted twice it would make cells depend on the order of axes.
    for (std::size_t k = 0; k < N; ++k) {
      counts_[k] = 1;
      for (std::size_t i = 0; i < k; ++i)
        if (!machine.axes[k].name.empty() && machine.axes[k].name == machine.axes[i].name) counts_[k] = 0;
    }
  }

  void build() {
    const std::vector<double> panel = segment_.panel_parameters();
    smallest_ = min_interval * (panel.back() - panel.front());
    end_ = segment_.travelled(panel.back());
    const double shortest = vanishes_smoothly() ? shortest_smooth : shortest_cell;
    push(end_station(panel.front(), segment_.cusp_begin()));
    for (std::size_t i = 1; i < panel.size(); ++i) {
      const bool last = i + 1 == panel.size();
      const Station<N> left = grid_.stations.back(),
                       right = last ? end_station(panel[i], segment_.cusp_end()) : path_.at(index_, panel[i]);
      if (last || Grid<N>::resolved(left.s, right.s, end_, segment_.length(), shortest)) interval(left, right);
    }
  }

 private:
  void push(const Station<N>& at) { grid_.stations.push_back(at); }

  /// At a cusp the station has the tangent of the nearest place that path length resolves: where the curve's tangent
  /// nearly vanishes and is mostly rounding, its direction at the end itself is arbitrary.
  Station<N> end_station(double u, bool cusp) const {
    Station<N> station = path_.at(index_, u);
    if (!cusp) return station;
    const bool begin = u == segment_.curve().begin();
    const double near = segment_.parameter_at(begin ? shortest_cell * end_ : end_ - shortest_cell * end_);
    station.d1 = path_.derivatives(index_, near).d1;
    return station;
  }

  /// The parametric tangent vanishes at an end, where the curvature stays bounded: to path length, and to a motion that
  /// passes, nothing happens there, whatever the panels of the arc length.
  bool vanishes_smoothly() const {
    if (segment_.straight() || segment_.curve().kind() != CurveKind::rational) return false;
    const auto& curve = static_cast<const Rational&>(segment_.curve());
    return curve.vanishing_begin() + curve.vanishing_end() > 0 && !segment_.cusp_begin() && !segment_.cusp_end();
  }

  void cell_to(const Station<N>& at) {
    GridCell cell;
    cell.station = static_cast<std::uint32_t>(grid_.stations.size() - 1);
    cell.segment = index_;
    cell.cusp_left = segment_.cusp_begin() && grid_.stations.back().u == segment_.curve().begin();
    cell.cusp_right = segment_.cusp_end() && at.u == segment_.curve().end();
    const double near = needle_reach * segment_.length();
    cell.any_way = (needle(true) && (cell.cusp_left || at.s <= near)) ||
                   (needle(false) && (cell.cusp_right || end_ - grid_.stations.back().s <= near));
    grid_.cells.push_back(cell);
    push(at);
  }

  /// A cusp of curvature at which no parametric tangent vanishes: its direction there is not the one beside it.
  bool needle(bool begin) const {
    if (!path_.cartesian() || segment_.curve().kind() != CurveKind::rational) return false;
    const auto& curve = static_cast<const Rational&>(segment_.curve());
    return begin ? segment_.cusp_begin() && curve.vanishing_begin() == 0
                 : segment_.cusp_end() && curve.vanishing_end() == 0;
  }

  /// Every axis in one lane, 0 in those that repeat one.
  Lanes<N> once(const Lanes<N>& lanes) const {
    if constexpr (N > 3)
      return counts_ * lanes;
    else
      return lanes;
  }

  /// Returns the largest v² where the path bends: |n · q̈| ≤ Σ |n_k| A_k with the unit normal n, so v² κ ≤ Σ |n_k| A_k,
  /// and |q'_k| v ≤ V_k. The second counts where a path is straight but for rounding: there curvature is noise.
  double curvature_cap(const Station<N>& at) const {
    Lanes<N> normal = once(at.d2);
    if (const double along = sum(once(at.d1) * at.d1); !path_.cartesian() && along > 0)
      normal = once(at.d2 - (sum(once(at.d2) * at.d1) / along) * at.d1);
    const double square = sum(normal * normal);
    const double cap =
        square > 0 ? sum(magnitude(normal) * acceleration_) / square : std::numeric_limits<double>::infinity();
    const double inverse = largest(magnitude(at.d1) * inverse_velocity_);
    return inverse * inverse * cap > 1 ? 1 / (inverse * inverse) : cap;
  }

  /// Returns the number of cells that [left, right] needs, estimated at its middle.
  double parts(const Station<N>& left, const Station<N>& mid, const Station<N>& right) const {
    const Lanes<N> middle = once(mid.d1);
    const double turn = distance<N>(once(left.d1), middle) + distance<N>(middle, once(right.d1));
    const double h = right.s - left.s;
    if (!(h > 0)) return 1;
    const double t = (mid.s - left.s) / h, r = 1 - t;
    const double cap = std::min({feed2_, curvature_cap(left), curvature_cap(mid), curvature_cap(right)});
    // This is the error of the cubic model of d2 relative to the axis' limit.
    const Lanes<N> model =
        (r * r * (1 + 2 * t)) * left.d2 + (t * t * (1 + 2 * r)) * right.d2 + (h * t * r) * (r * left.d3 - t * right.d3);
    const double error = std::isfinite(cap) ? cap * largest(magnitude(model - mid.d2) * inverse_acceleration_) : 0;
    return std::max({turn / options_.angle, std::sqrt(std::sqrt(error / options_.hermite)), h / options_.longest});
  }

  /// Makes the cells between two stations; `known` is the one in the middle, if it was evaluated before.
  void interval(const Station<N>& left, const Station<N>& right, const Station<N>* known = nullptr) {
    // Three at once cost no more than the middle alone, and are what both halves need.
    std::array<Station<N>, 3> inner;
    if (!known) {
      PathBatch batch;
      batch.count = 3;
      const double middle = 0.5 * (left.u + right.u);
      batch.u.set(0, 0.5 * (left.u + middle));
      batch.u.set(1, middle);
      batch.u.set(2, 0.5 * (middle + right.u));
      path_.at_parameters(index_, batch);
      for (std::size_t i = 0; i < 3; ++i) inner[i] = path_.station(batch, i);
    }
    const Station<N>& mid = known ? *known : inner[1];
    const double need = parts(left, mid, right);
    const bool at_cusp = (segment_.cusp_begin() && left.u == segment_.curve().begin()) ||
                         (segment_.cusp_end() && right.u == segment_.curve().end());
    const double length = segment_.length();
    if ((need > max_parts || at_cusp) && right.u - left.u > smallest_ &&
        Grid<N>::resolved(left.s, mid.s, right.s, length)) {
      interval(left, mid, known ? nullptr : &inner[0]);
      interval(mid, right, known ? nullptr : &inner[2]);
      return;
    }
    const int n = std::clamp(static_cast<int>(std::ceil(need)), 1, max_parts);
    const double du = (right.u - left.u) / n;
    if (n > 1) {
      PathBatch batch;
      batch.count = static_cast<std::size_t>(n - 1);
      for (int i = 1; i < n; ++i) batch.u.set(static_cast<std::size_t>(i - 1), left.u + i * du);
      path_.at_parameters(index_, batch);
      for (std::size_t i = 0; i < batch.count; ++i)
        if (const Station<N> at = path_.station(batch, i);
            Grid<N>::resolved(grid_.stations.back().s, at.s, right.s, length))
          cell(at);
    }
    cell(right);
  }

  /// A cell up to `right`, parted where an axis turns round (zero inertia): the touching points of time-optimal laws
  /// lie there.
  void cell(const Station<N>& right) {
    const Lanes<N> product = grid_.stations.back().d1 * right.d1;
    bool turns = false;
    for (std::size_t k = 0; k < N; ++k) turns = turns || product[k] < 0;
    if (turns) part_turning(right);
    cell_to(right);
  }

  [[gnu::noinline]] void part_turning(const Station<N>& right) {
    const Station<N> left = grid_.stations.back();
    std::array<double, N> turning{};
    std::size_t count = 0;
    constexpr double closest = 1e-3;  // least distance of divisions, as a part of the cell: two axes may reverse at
                                      // places that differ by rounding
    for (std::size_t k = 0; k < N; ++k) {
      if (!(left.d1[k] * right.d1[k] < 0)) continue;
      double a = left.u, b = right.u, fa = left.d1[k], fb = right.d1[k], u = a;
      for (int i = 0; i < 8; ++i) {  // regula falsi (Illinois); the tangent is nearly linear here
        u = b - fb * (b - a) / (fb - fa);
        const double f = path_.at(index_, u).d1[k];
        if (std::abs(f) < 1e-14) break;
        if (f * fb < 0) {
          a = b;
          fa = fb;
        } else {
          fa *= 0.5;
        }
        b = u;
        fb = f;
      }
      const double share = (u - left.u) / (right.u - left.u);
      if (!(share > closest && share < 1 - closest)) continue;
      std::size_t i = count++;
      for (; i > 0 && turning[i - 1] > u; --i) turning[i] = turning[i - 1];
      turning[i] = u;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!(turning[i] - grid_.stations.back().u > closest * (right.u - left.u))) continue;
      const Station<N> at = path_.at(index_, turning[i]);
      if (Grid<N>::resolved(grid_.stations.back().s, at.s, right.s, segment_.length())) cell_to(at);
    }
  }

  Grid<N>& grid_;
  const LanePath<N>& path_;
  const Segment& segment_;
  std::uint32_t index_;
  double feed2_;
  const GridOptions& options_;
  Lanes<N> acceleration_, inverse_acceleration_, inverse_velocity_, counts_;
  double smallest_ = 0, end_ = 0;
};

}  // namespace

template <int N>
void Grid<N>::build(const LanePath<N>& path, std::size_t first, std::size_t last, const LaneLimits& limits,
                    const GridOptions& options, ProgressScope& progress) {
  stations.clear();
  cells.clear();
  section_length = 0;
  for (std::size_t i = first; i < last; ++i) {
    section_length += path[i].length();
    progress.now(i - first, last - first);
    if (const std::size_t least = stations.size() + usual_segment; least > stations.capacity()) {
      const std::size_t room = foreseen(least, static_cast<double>(i - first) / static_cast<double>(last - first));
      grow(stations, room, progress);
      grow(cells, room, progress);
    }
    if (path.linear(i)) {
      cells.push_back({static_cast<std::uint32_t>(stations.size()), static_cast<std::uint32_t>(i), true, false, false});
      stations.push_back(path.at(i, path[i].curve().begin()));
      stations.push_back(path.at(i, path[i].curve().end()));
    } else {
      Layer<N>(*this, path, static_cast<std::uint32_t>(i), limits.machine, limits.feed[i], options).build();
    }
    if (i == first) grade_end(path, true);  // the first cells are graded while few cells stand behind them
  }
  grade_end(path, false);
}

template <int N>
void Grid<N>::grade_end(const LanePath<N>& path, bool front) {
  // Parts of the end cell, from the rest: 1/16 1/16 1/8 1/4 1/2.
  const auto part = [](int i) { return i == 0 ? 0.0 : std::ldexp(1.0, i - 1 - end_halvings); };
  const GridCell old = front ? cells.front() : cells.back();
  if (old.straight) return;
  const double u0 = stations[old.station].u, u1 = stations[old.station + 1].u;
  const double s0 = stations[old.station].s, s1 = stations[old.station + 1].s;
  std::vector<Station<N>> inner;
  for (int i = 1; i <= end_halvings; ++i) {
    const Station<N> at =
        path.at(old.segment, front ? u0 + part(i) * (u1 - u0) : u1 - part(end_halvings + 1 - i) * (u1 - u0));
    if (resolved(inner.empty() ? s0 : inner.back().s, at.s, s1, path[old.segment].length())) inner.push_back(at);
  }
  std::vector<GridCell> parts(inner.size() + 1, old);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].station = old.station + static_cast<std::uint32_t>(i);
    parts[i].cusp_left = old.cusp_left && i == 0;
    parts[i].cusp_right = old.cusp_right && i + 1 == parts.size();
  }
  if (front)
    for (GridCell& cell : cells)
      if (cell.station > old.station) cell.station += static_cast<std::uint32_t>(inner.size());
  stations.insert(stations.begin() + old.station + 1, inner.begin(), inner.end());
  const auto at = front ? cells.begin() : cells.end() - 1;
  cells.insert(cells.erase(at), parts.begin(), parts.end());
}

template <int N>
void Grid<N>::slice(const Grid& of, std::size_t first, std::size_t last) {
  const auto at = [](auto& items, std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::uint32_t begin = of.cells[first].station, end = of.cells[last - 1].station + 2;
  stations.assign(at(of.stations, begin), at(of.stations, end));
  cells.assign(at(of.cells, first), at(of.cells, last));
  section_length = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells[c].station -= begin;
    section_length += length(c);
  }
}

template <int N>
void Grid<N>::cut(std::size_t last) {
  for (std::size_t c = last; c < cells.size(); ++c) section_length -= length(c);
  cells.resize(last);
  stations.resize(cells.back().station + 2);
}

template <int N>
void Grid<N>::divide(const LanePath<N>& path, LargeVector<std::uint8_t>& parts, ProgressScope& progress) {
  divide(
      path, [&](std::size_t c) { return parts[c]; },
      [&](std::size_t c, int i, double u0, double u1) { return u0 + i * ((u1 - u0) / parts[c]); },
      [&](std::size_t c, std::size_t cells_made) { parts[c] = static_cast<std::uint8_t>(cells_made); }, progress);
}

template <int N>
void Grid<N>::insert(const LargeVector<Station<N>>& inner, const LargeVector<Inner>& divided, ProgressScope& progress) {
  constexpr std::size_t block = 4096;
  std::size_t station = stations.size(), cell = cells.size(), before = inner.size();  // ends of what is not yet moved
  grow(stations, station + before, progress);
  grow(cells, cell + before, progress);
  stations.resize(station + before);
  cells.resize(cell + before);
  /// Moves what lies behind the inner stations that are left, down to this station and this cell.
  const auto move_down_to = [&](std::size_t least_station, std::size_t least_cell) {
    const auto move = [&](auto& items, std::size_t& end, std::size_t least) {
      while (end > least) {
        const std::size_t count = std::min(block, end - least);
        progress.work(count / 4);
        const auto from = items.begin() + static_cast<std::ptrdiff_t>(end - count);
        std::move_backward(from, items.begin() + static_cast<std::ptrdiff_t>(end),
                           items.begin() + static_cast<std::ptrdiff_t>(end + before));
        end -= count;
      }
    };
    const std::size_t last = cell + before;
    move(stations, station, least_station);
    move(cells, cell, least_cell);
    for (std::size_t c = cell + before; c < last; ++c) cells[c].station += static_cast<std::uint32_t>(before);
  };
  for (std::size_t d = divided.size(); d-- > 0;) {
    const auto [index, count] = divided[d];
    move_down_to(cells[index].station + std::size_t{1}, index + 1);
    const GridCell old = cells[index];
    for (std::size_t i = 0; i <= count; ++i) {
      GridCell part = old;
      part.station = old.station + static_cast<std::uint32_t>(before - count + i);
      part.cusp_left = old.cusp_left && i == 0;
      part.cusp_right = old.cusp_right && i == count;
      cells[index + before - count + i] = part;
    }
    before -= count;
    std::copy_n(inner.begin() + static_cast<std::ptrdiff_t>(before), count,
                stations.begin() + static_cast<std::ptrdiff_t>(station + before));
    cell = index;
  }
}

template class Grid<2>;
template class Grid<3>;
template class Grid<5>;
template class Grid<8>;

}  // namespace bahnwerk
