#include "core/cam/optimal/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"

namespace bahnwerk::cam {
namespace {

/// d(x) = c₀ + c₁ x + c₂ x², x = 1 − τ: the Bernstein polynomials, and some that change their sign inside a cell.
struct Direction {
  double c[3];
  double size;  // ∫₀¹ |d|
};

double integral(const Direction& d, double a, double b) {
  const auto whole = [&](double x) { return x * (d.c[0] + x * (d.c[1] / 2 + x * d.c[2] / 3)); };
  return whole(b) - whole(a);
}

std::vector<Direction> make_directions() {
  std::vector<Direction> result{{{1, -2, 1}, 0},   {{0, 2, -2}, 0},    {{0, 0, 1}, 0},      {{-0.25, 1, 0}, 0},
                                {{-0.5, 1, 0}, 0}, {{-0.75, 1, 0}, 0}, {{0.1875, -1, 1}, 0}};
  const std::vector<std::vector<double>> roots{{}, {}, {}, {0.25}, {0.5}, {0.75}, {0.25, 0.75}};
  for (std::size_t i = 0; i < result.size(); ++i) {
    double from = 0;
    for (const double root : roots[i]) {
      result[i].size += std::abs(integral(result[i], from, root));
      from = root;
    }
    result[i].size += std::abs(integral(result[i], from, 1));
  }
  return result;
}

class Relaxation {
 public:
  Relaxation(const LawTask& task, const std::vector<Range>& ranges, const KnownLaw& law, std::size_t cells)
      : task_(task), ranges_(ranges), law_(law) {
    for (std::size_t r = 1; r < limited_orders; ++r) {
      counted_[r] = task.weight[r] > 0;
      unit_[r] = std::max(law.peak(static_cast<int>(r)), 1e-12);
      if (counted_[r]) scale_ += task.weight[r] * unit_[r];
    }
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted_[r]) border_[r] = band_.add_border(task.weight[r] * unit_[r] / scale_);
    lay_nodes(cells);
    add_points();
    add_cells();
  }

  double solve(const RelaxationOptions& options, Progress& progress) {
    InteriorPoint point;
    const std::vector<double>& g = band_.inequality_side();
    point.x.assign(band_.band_variables() + band_.borders(), 0);
    for (const Node& node : nodes_)
      for (int r = 0; r < 3; ++r)
        point.x[node.first + static_cast<std::size_t>(r)] = law_.value(node.time, r, node.before) / node_unit_[r];
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted_[r]) point.x[band_.border_index(border_[r])] = 1.1;
    point.y.assign(band_.equality_side().size(), 0);
    std::vector<double> gx(g.size()), ex(point.y.size());
    band_.multiply(point.x, gx, ex);
    point.s.resize(g.size());
    point.z.resize(g.size());
    double share = 0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      point.s[i] = std::max(g[i] - gx[i], 0.01);
      share += 1 / point.s[i];
    }
    for (std::size_t i = 0; i < g.size(); ++i) point.z[i] = 1 / share / point.s[i];
    InteriorPointOptions interior;
    interior.gap = options.gap;
    interior.residual = 1e-6;  // the dual's value holds whatever the residuals are
    interior.max_iterations = 60;
    interior.tick = [&] { progress.report("bound", 0); };
    solve_interior_point(band_, point, interior);
    return dual(point);
  }

 private:
  struct Node {
    double time;
    std::size_t first;  // index among the variables; the other two follow
    bool before;        // it ends a cell before a jump
    std::size_t point;  // BorderedRow::none: of none
  };

  void lay_nodes(std::size_t cells) {
    node_unit_[0] = 1;
    node_unit_[1] = unit_[1];
    node_unit_[2] = unit_[2];
    const std::size_t points = task_.points();
    std::vector<double> at;
    for (const Range& range : ranges_) at.push_back((range.min + range.max) / 2);
    for (std::size_t i = 1; i < points; ++i) at[i] = std::max(at[i], at[i - 1]);
    if (task_.periodic) at.push_back(at.front() + task_.cycle);
    const double whole = at.back() - at.front();
    const auto add = [&](double time, bool before, std::size_t point) {
      nodes_.push_back({time, band_.add_variables(3), before, point});
      pinned_.resize(band_.band_variables());
      if (point == BorderedRow::none || !ranges_[point].fixed() || (task_.periodic && nodes_.size() > 1 && point == 0))
        return;
      for (const LawTask::Condition& condition : task_.conditions) {
        if (condition.point != point || condition.order > 2 || !condition.range.fixed()) continue;
        const auto r = static_cast<std::size_t>(condition.order);
        const std::pair<std::size_t, double> term[] = {{nodes_.back().first + r, 1}};
        band_.add_equality(term, condition.range.min / node_unit_[r]);
        pinned_[nodes_.back().first + r] = true;
      }
    };
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::size_t point = i < points ? i : 0;
      // The first node of a periodic law and the last one are two; they are joined at the end.
      const bool inside = i > 0 && i + 1 < at.size();
      const bool jump = inside && ranges_[point].fixed() && task_.continuity[point] < 2;
      add(at[i], jump || i + 1 == at.size(), point);
      if (jump) {
        const Node left = nodes_.back();
        add(at[i], false, BorderedRow::none);
        for (int r = 0; r <= task_.continuity[point] && r < 3; ++r)
          equal(left.first + static_cast<std::size_t>(r), nodes_.back().first + static_cast<std::size_t>(r), false);
        jumps_.push_back(nodes_.size() - 1);
      }
      if (i + 1 == at.size()) break;
      const double length = at[i + 1] - at[i];
      if (!(length > 1e-12 * whole)) continue;
      const auto count =
          std::max<std::size_t>(4, static_cast<std::size_t>(std::ceil(static_cast<double>(cells) * length / whole)));
      for (std::size_t k = 1; k < count; ++k)
        add(at[i] + length * static_cast<double>(k) / static_cast<double>(count), false, BorderedRow::none);
    }
    if (task_.periodic)
      for (int r = 0; r <= std::min(task_.continuity[0], 2); ++r)
        equal(nodes_.front().first + static_cast<std::size_t>(r), nodes_.back().first + static_cast<std::size_t>(r),
              true);
  }

  void equal(std::size_t a, std::size_t b, bool far) {
    const std::pair<std::size_t, double> terms[] = {{a, 1}, {b, -1}};
    if (far)
      band_.add_far_equality(terms, 0);
    else
      band_.add_equality(terms, 0);
  }

  void row(std::size_t first, std::span<const double> weights, Range range, int elastic, double elastic_weight) {
    BorderedRow row;
    row.first = first;
    row.weights = weights;
    row.lower = range.min;
    row.upper = range.max;
    if (elastic > 0) {
      row.elastic = border_[static_cast<std::size_t>(elastic)];
      row.elastic_weight = elastic_weight;
    }
    band_.add_row(row);
  }

  /// Ranges at points, and values where the angle is free.
  void add_points() {
    for (const Node& node : nodes_) {
      if (node.point == BorderedRow::none || closing(node)) continue;
      const double reach = (ranges_[node.point].max - ranges_[node.point].min) / 2;
      for (const LawTask::Condition& condition : task_.conditions) {
        if (condition.point != node.point || condition.order > 2) continue;
        const auto r = static_cast<std::size_t>(condition.order);
        if (pinned_[node.first + r]) continue;
        const auto next = r + 1;
        if (reach > 0 && (!counted_[next] || task_.continuity[node.point] < condition.order)) continue;
        const double one[] = {1};
        row(node.first + r, one, {condition.range.min / node_unit_[r], condition.range.max / node_unit_[r]},
            reach > 0 ? condition.order + 1 : 0, reach * unit_[next] / node_unit_[r]);
      }
    }
  }
  bool closing(const Node& node) const { return task_.periodic && &node == &nodes_.back(); }

  void add_cells() {
    static const std::vector<Direction> directions = make_directions();
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      if (std::find(jumps_.begin(), jumps_.end(), i + 1) != jumps_.end()) continue;
      const Node &left = nodes_[i], &right = nodes_[i + 1];
      const double h = right.time - left.time;
      // Up to which order the cell is certainly smooth, and which section it certainly belongs to.
      int smooth = 2;
      std::size_t section = BorderedRow::none;
      for (std::size_t k = 0; k < task_.points(); ++k)
        if (task_.joint(k) && !ranges_[k].fixed() && left.time < ranges_[k].max && right.time > ranges_[k].min)
          smooth = std::min(smooth, task_.continuity[k]);
      for (std::size_t k = 0; k < task_.sections(); ++k) {
        const std::size_t end = task_.end_point(k);
        const double until =
            end == 0 && task_.periodic ? ranges_[0].min + task_.cycle : ranges_[task_.periodic ? end : k + 1].min;
        const double slack = 1e-9 * task_.cycle;
        if (left.time >= ranges_[k].max - slack && right.time <= until + slack) section = k;
      }
      double w[6];
      const auto clear = [&] { std::fill(w, w + 6, 0.0); };
      // Node values of velocity and acceleration, and their means.
      for (int r = 1; r <= 2; ++r) {
        const auto o = static_cast<std::size_t>(r);
        if (counted_[o]) {
          const double one[] = {1};
          row(left.first + o, one, {0, 0}, r, unit_[o] / node_unit_[o]);
          if (i + 2 == nodes_.size() || right.before) row(right.first + o, one, {0, 0}, r, unit_[o] / node_unit_[o]);
        }
      }
      const auto mean = [&](int r, Range range, int elastic) {
        clear();
        const auto o = static_cast<std::size_t>(r);
        w[o - 1] = -node_unit_[o - 1] / (h * unit_[o]);
        w[o + 2] = node_unit_[o - 1] / (h * unit_[o]);
        row(left.first, w, range, elastic, 1);
      };
      if (counted_[1]) mean(1, {0, 0}, 1);
      if (counted_[2] && smooth >= 1) {
        mean(2, {0, 0}, 2);
        // The second moment of the acceleration, from either end.
        for (const bool from_left : {true, false}) {
          clear();
          const double k = 2 / (h * h * unit_[2]);
          w[0] = -k, w[3] = k;
          w[from_left ? 1 : 4] = -k * h * node_unit_[1];
          row(left.first, w, {0, 0}, 2, 1);
        }
      }
      const auto jerk_row = [&](const Direction& d, Range range, bool elastic) {
        clear();
        const double k = 1 / (unit_[3] * d.size);
        w[2] = -node_unit_[2] * k * d.c[0] / h, w[5] = node_unit_[2] * k * d.c[0] / h;
        const double first = k * d.c[1] / (h * h);
        w[4] += node_unit_[1] * first, w[1] -= node_unit_[1] * first, w[2] -= node_unit_[2] * first * h;
        const double second = 2 * k * d.c[2] / (h * h * h);
        w[3] += second, w[0] -= second, w[1] -= node_unit_[1] * second * h, w[2] -= node_unit_[2] * second * h * h / 2;
        row(left.first, w, range, elastic ? 3 : 0, 1);
      };
      if (counted_[3] && smooth >= 2)
        for (const Direction& d : directions) jerk_row(d, {0, 0}, true);
      if (section == BorderedRow::none) continue;
      for (int r = 0; r < limited_orders; ++r) {
        const auto o = static_cast<std::size_t>(r);
        Range limit = task_.limits[section][o];
        if (limit.free()) continue;
        if (limit.fixed()) {  // a little room, for a program with an interior: what the bound loses is as little
          const double room = 1e-6 * (r == 0 ? 1 : unit_[o]);
          limit = {limit.min - room, limit.max + room};
        }
        if (r == 3) {
          for (std::size_t d = 0; d < 3 && smooth >= 2; ++d)
            jerk_row(directions[d], {limit.min / unit_[3], limit.max / unit_[3]}, false);
          continue;
        }
        const Range range{limit.min / node_unit_[o], limit.max / node_unit_[o]};
        const double one[] = {1};
        for (const Node* node : {&left, &right})
          if (!pinned_[node->first + o] && !(node->point != BorderedRow::none && ranges_[node->point].fixed() == false))
            row(node->first + o, one, range, 0, 0);
        if (r > 0) mean(r, {limit.min / unit_[o], limit.max / unit_[o]}, 0);
      }
    }
  }

  double dual(InteriorPoint& point) {
    const double upper = law_.objective();
    double best = 0;
    for (int refinement = 0; refinement < 2; ++refinement) {
      DualValue value = dual_value(band_, point.y, point.z);
      double bound = value.value;
      double largest[3] = {0, 0, 0};
      for (const Node& node : nodes_)
        for (std::size_t r = 0; r < 3; ++r) largest[r] = std::max(largest[r], std::abs(point.x[node.first + r]));
      for (std::size_t r = 1; r < 3; ++r)
        if (counted_[r])
          largest[r] = upper / task_.weight[r] / node_unit_[r];
        else
          largest[r] *= 1e3;
      const double position = position_bound(task_, upper);
      largest[0] = position > 0 ? position : 1e3 * largest[0];
      for (const Node& node : nodes_)
        for (std::size_t r = 0; r < 3; ++r) bound -= std::abs(value.residual[node.first + r]) * largest[r];
      for (std::size_t r = 1; r < limited_orders; ++r)
        if (counted_[r])
          bound -= std::abs(value.residual[band_.border_index(border_[r])]) * upper / (task_.weight[r] * unit_[r]);
      if (std::isfinite(bound)) best = std::max(best, bound * scale_);
      std::vector<double> y(point.y.size()), gx(point.z.size()), ex(point.y.size());
      for (double& each : value.residual) each = -each;
      solve_refined(band_, band_.weights(), value.residual, y);
      band_.multiply(value.residual, gx, ex);
      for (std::size_t i = 0; i < point.z.size(); ++i)
        point.z[i] = std::max(point.z[i] * 1e-3, point.z[i] + band_.weights()[i] * gx[i]);
      for (std::size_t i = 0; i < y.size(); ++i) point.y[i] += y[i];
    }
    return best;
  }

  const LawTask& task_;
  const std::vector<Range>& ranges_;
  const KnownLaw& law_;
  BorderedBand band_;
  std::array<bool, limited_orders> counted_{};
  std::array<double, limited_orders> unit_{};
  std::array<std::size_t, limited_orders> border_{};
  double node_unit_[3];
  double scale_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::size_t> jumps_;  // nodes that begin behind a jump
  std::vector<bool> pinned_;
};

}  // namespace

double relaxation_bound(const LawTask& task, const std::vector<Range>& ranges, const KnownLaw& law,
                        const RelaxationOptions& options, Progress& progress) {
  return Relaxation(task, ranges, law, options.cells).solve(options, progress);
}

}  // namespace bahnwerk::cam
