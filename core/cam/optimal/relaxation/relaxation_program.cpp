#include "core/cam/optimal/relaxation/relaxation_program.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

RelaxationProgram::RelaxationProgram(const LawTask& task, const std::vector<Range>& ranges, const KnownLaw& law,
                                     std::size_t cells)
    : task_(task), ranges_(ranges), grid_(lay_grid(task, ranges, cells)) {
  for (std::size_t r = 1; r < limited_orders; ++r) {
    counted_[r] = task.weight[r] > 0;
    unit_[r] = std::max(law.peak(static_cast<int>(r)), 1e-4 * LawTask::usual_peaks[r]);
    if (counted_[r] && task.largest_peak) unit_[r] = 1 / task.weight[r];  // the limits themselves
    if (counted_[r]) scale_ += task.weight[r] * unit_[r];
  }
  if (task.groups.count() > 1) scale_ = law.objective();
  if (task.largest_peak) scale_ = 1;
  border_.resize(task.groups.count());
  for (std::size_t g = 0; g < border_.size(); ++g)
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted_[r])
        border_[g][r] = task.largest_peak && band_.borders() > 0
                            ? 0
                            : band_.add_border(task.groups.weight[g] * task.weight[r] * unit_[r] / scale_);
  any_.fill(BorderedRow::none);
  for (std::size_t r = 1; r < limited_orders && border_.size() > 1 && task.free_angles(); ++r)
    if (counted_[r]) any_[r] = band_.add_border(0);
  add_nodes();
  add_floors();
  add_points();
  add_cells();
}

std::size_t RelaxationProgram::peak_border(std::size_t section, int order) const {
  const auto r = static_cast<std::size_t>(order);
  return section != LawTask::none ? border_[task_.groups.of_section[section]][r]
         : border_.size() == 1    ? border_[0][r]
                                  : any_[r];
}

/// Adds the rows that keep peaks at least as large as those of given sections, and those that define the largest peak
/// of any group as no more than their sum.
void RelaxationProgram::add_floors() {
  for (std::size_t r = 1; r < limited_orders; ++r) {
    if (!counted_[r]) continue;
    std::vector<double> floors(border_.size());  // peaks in the longest sections that the ranges allow
    for (std::size_t s = 0; s < task_.sections(); ++s) {
      double& floor = floors[task_.groups.of_section[s]];
      if (const auto velocity = task_.constant_velocity(s); velocity && r == 1)
        floor = std::max(floor, std::abs(*velocity));
      if (!task_.is_given(s)) continue;
      const std::size_t end = task_.end_point(s);
      const double until = ranges_[end].max + (s + 1 == task_.points() ? task_.cycle : 0);
      floor = std::max(floor, task_.given[s]->peak_at(static_cast<int>(r), until - ranges_[s].min));
    }
    for (std::size_t g = 0; g < border_.size(); ++g) {
      const BorderedRow::Term peak[] = {{border_[g][r], 1}};
      BorderedRow row;
      row.border = peak;
      row.lower = floors[g] / unit_[r];
      // Without a row that holds it from below a peak would have no interior.
      if (floors[g] > 0 || grid_.cells.empty() || border_.size() > 1) band_.add_row(row);
    }
    if (any_[r] == BorderedRow::none) continue;
    std::vector<BorderedRow::Term> sum{{any_[r], -1}};
    for (const auto& group : border_) sum.push_back({group[r], 1});
    BorderedRow row;
    row.border = sum;
    row.lower = 0;
    band_.add_row(row);
  }
}

void RelaxationProgram::pin(std::size_t node, int order, double value) {
  if (pinned_[variable(node, order)]) return;
  const std::pair<std::size_t, double> term[] = {{variable(node, order), 1}};
  band_.add_equality(term, value / node_unit_[order]);
  pinned_[variable(node, order)] = true;
}

/// A section of constant velocity without cells: its ends have this velocity and no acceleration, as far as they share
/// them with the section on the other side, and lie apart by what it moves. Returns whether there is one at the node.
bool RelaxationProgram::join_constant_sections(std::size_t node) {
  const RelaxationNode& here = grid_.nodes[node];
  if (here.point == LawTask::none) return false;
  const auto is_constant = [&](std::size_t section) {
    return section != LawTask::none && !task_.is_given(section) && is_known(task_, ranges_, section);
  };
  const bool first = task_.periodic && node == 0;  // the section before it ends at the last node
  const std::size_t before = first ? LawTask::none : task_.section_before(here.point);
  const std::size_t behind = grid_.closing(node) ? LawTask::none : task_.section_behind(here.point);
  for (const std::size_t section : {before, behind}) {
    if (!is_constant(section)) continue;
    const double velocity = *task_.constant_velocity(section);
    for (int r = 1; r <= std::min(task_.continuity[here.point], 2); ++r) pin(node, r, r == 1 ? velocity : 0);
    const std::size_t from = variable(node - 1, 0), to = variable(node, 0);
    if (section != before || (pinned_[from] && pinned_[to])) continue;
    const std::pair<std::size_t, double> moved[] = {{to, 1}, {from, -1}};
    band_.add_equality(moved, velocity * (here.time - grid_.nodes[node - 1].time) / node_unit_[0]);
  }
  return is_constant(before) || is_constant(behind);
}

void RelaxationProgram::add_nodes() {
  node_unit_[0] = 1;
  node_unit_[1] = unit_[1];
  node_unit_[2] = unit_[2];
  pinned_.resize(3 * grid_.nodes.size());
  for (std::size_t i = 0; i < grid_.nodes.size(); ++i) {
    const RelaxationNode& node = grid_.nodes[i];
    band_.add_variables(3);
    for (int r = 0; r < node.joined; ++r) equal(variable(i - 1, r), variable(i, r), false);
    if (node.point != LawTask::none && ranges_[node.point].fixed() && !grid_.closing(i))
      for (const LawTask::Condition& condition : task_.conditions)
        if (condition.point == node.point && condition.order <= 2 && condition.range.fixed())
          pin(i, condition.order, condition.range.min);
    const bool constant = join_constant_sections(i);
    if (node.used) continue;
    // No cell depends on these variables: what joins them aside, they are 0.
    int free = constant ? 1 : node.joined;
    const bool joined_at_closing = i == 0 && task_.periodic && grid_.nodes.back().used;
    if (joined_at_closing || grid_.closing(i)) free = task_.continuity[0] + 1;
    for (int r = free; r <= 2; ++r) pin(i, r, 0);
  }
  if (task_.periodic)
    for (int r = 0; r <= std::min(task_.continuity[0], 2); ++r)
      equal(variable(0, r), variable(grid_.nodes.size() - 1, r), true, r == 0 ? -task_.travel / node_unit_[0] : 0);
}

void RelaxationProgram::equal(std::size_t a, std::size_t b, bool far, double more) {
  const std::pair<std::size_t, double> terms[] = {{a, 1}, {b, -1}};
  if (far)
    band_.add_far_equality(terms, more);
  else
    band_.add_equality(terms, more);
}

void RelaxationProgram::row(std::size_t first, std::span<const double> weights, Range range, std::size_t elastic,
                            double elastic_weight) {
  BorderedRow row;
  row.first = first;
  row.weights = weights;
  row.lower = range.min;
  row.upper = range.max;
  row.elastic = elastic;
  if (elastic != BorderedRow::none) row.elastic_weight = elastic_weight;
  band_.add_row(row);
}

/// Returns the tightest bound of |s^(order)| over a point's range of times: the peak of the order, or, where the
/// derivative is a number at another point, what the peak of the next order can change until then.
RelaxationProgram::Reach RelaxationProgram::reach_of(std::size_t point, int order) const {
  const auto r = static_cast<std::size_t>(order);
  Reach out{0, 0, BorderedRow::unlimited};
  const auto take = [&](const Reach& each) {
    if (each.known + each.elastic < out.known + out.elastic) out = each;
  };
  if (counted_[r]) take({order, 0, unit_[r]});
  if (r + 1 >= limited_orders || !counted_[r + 1]) return out;
  for (std::size_t p = 0; p < task_.points(); ++p)
    if (task_.joint(p) && task_.continuity[p] < order) return out;
  for (const LawTask::Condition& condition : task_.conditions) {
    if (condition.order != order || !condition.range.fixed()) continue;
    const Range &from = ranges_[condition.point], &here = ranges_[point];
    const double time = std::max(here.max - from.min, from.max - here.min);
    take({order + 1, std::abs(condition.range.min), time * unit_[r + 1]});
  }
  return out;
}

/// Adds ranges at points, and values where the angle is free.
void RelaxationProgram::add_points() {
  for (std::size_t i = 0; i < grid_.nodes.size(); ++i) {
    const RelaxationNode& node = grid_.nodes[i];
    if (node.point == LawTask::none || grid_.closing(i)) continue;
    const double reach = (ranges_[node.point].max - ranges_[node.point].min) / 2;
    for (const LawTask::Condition& condition : task_.conditions) {
      if (condition.point != node.point || condition.order > 2) continue;
      const auto r = static_cast<std::size_t>(condition.order);
      if (pinned_[variable(i, condition.order)]) continue;
      Reach next{0, 0, 0};
      if (reach > 0) {
        next = reach_of(node.point, condition.order + 1);
        if (next.order == 0 || task_.continuity[node.point] < condition.order) continue;
      }
      const double one[] = {1}, known = reach * next.known;
      row(variable(i, condition.order), one,
          {(condition.range.min - known) / node_unit_[r], (condition.range.max + known) / node_unit_[r]},
          reach > 0 ? peak_border(LawTask::none, next.order) : BorderedRow::none, reach * next.elastic / node_unit_[r]);
    }
  }
}

void RelaxationProgram::add_cells() {
  static const std::vector<Direction> directions = make_directions();
  for (const RelaxationCell& cell : grid_.cells) {
    const RelaxationNode &left = grid_.nodes[cell.left], &right = grid_.nodes[cell.left + 1];
    const std::size_t first = variable(cell.left, 0);
    const double h = right.time - left.time;
    double w[6];
    const auto clear = [&] { std::fill(w, w + 6, 0.0); };
    const auto peak = [&](int order) { return peak_border(cell.section, order); };
    // Node values of velocity and acceleration, and their means.
    for (int r = 1; r <= 2; ++r) {
      const auto o = static_cast<std::size_t>(r);
      if (counted_[o]) {
        const double one[] = {1};
        row(first + o, one, {0, 0}, peak(r), unit_[o] / node_unit_[o]);
        // The node on the right is that of the next cell, too, whose row says less where the groups differ.
        if (right.before || border_.size() > 1) row(first + 3 + o, one, {0, 0}, peak(r), unit_[o] / node_unit_[o]);
      }
    }
    const auto mean = [&](int r, Range range, std::size_t elastic) {
      clear();
      const auto o = static_cast<std::size_t>(r);
      w[o - 1] = -node_unit_[o - 1] / (h * unit_[o]);
      w[o + 2] = node_unit_[o - 1] / (h * unit_[o]);
      row(first, w, range, elastic, 1);
    };
    if (counted_[1]) mean(1, {0, 0}, peak(1));
    if (counted_[2] && cell.smooth >= 1) {
      mean(2, {0, 0}, peak(2));
      // The second moment of the acceleration, from either end.
      for (const bool from_left : {true, false}) {
        clear();
        const double k = 2 / (h * h * unit_[2]);
        w[0] = -k, w[3] = k;
        w[from_left ? 1 : 4] = -k * h * node_unit_[1];
        row(first, w, {0, 0}, peak(2), 1);
      }
    }
    const auto jerk_row = [&](const Direction& d, Range range, bool elastic) {
      clear();
      const double k = 1 / (unit_[3] * d.size);
      w[2] = -node_unit_[2] * k * d.c[0] / h, w[5] = node_unit_[2] * k * d.c[0] / h;
      const double moment = k * d.c[1] / (h * h);
      w[4] += node_unit_[1] * moment, w[1] -= node_unit_[1] * moment, w[2] -= node_unit_[2] * moment * h;
      const double second = 2 * k * d.c[2] / (h * h * h);
      w[3] += second, w[0] -= second, w[1] -= node_unit_[1] * second * h, w[2] -= node_unit_[2] * second * h * h / 2;
      row(first, w, range, elastic ? peak(3) : BorderedRow::none, 1);
    };
    if (counted_[3] && cell.smooth >= 2)
      for (const Direction& d : directions) jerk_row(d, {0, 0}, true);
    if (cell.section == LawTask::none) continue;
    for (int r = 0; r < limited_orders; ++r) {
      const auto o = static_cast<std::size_t>(r);
      Range limit = task_.limits[cell.section][o];
      if (limit.free()) continue;
      if (limit.fixed()) {  // a small range, for a program with an interior: the bound loses as little
        const double room = 1e-6 * (r == 0 ? 1 : unit_[o]);
        limit = {limit.min - room, limit.max + room};
      }
      if (r == 3) {
        for (std::size_t d = 0; d < 3 && cell.smooth >= 2; ++d)
          jerk_row(directions[d], {limit.min / unit_[3], limit.max / unit_[3]}, false);
        continue;
      }
      const Range range{limit.min / node_unit_[o], limit.max / node_unit_[o]};
      const double one[] = {1};
      for (const std::size_t node : {cell.left, cell.left + 1}) {
        const std::size_t point = grid_.nodes[node].point;
        if (!pinned_[variable(node, r)] && (point == LawTask::none || ranges_[point].fixed()))
          row(variable(node, r), one, range, BorderedRow::none, 0);
      }
      if (r > 0) mean(r, {limit.min / unit_[o], limit.max / unit_[o]}, BorderedRow::none);
    }
  }
}

}  // namespace bahnwerk::cam
