#include "core/cam/spline/spline_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/cam/bernstein.hpp"
#include "core/cam/spline/spline_matrix.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double singular_below = 1e-11;
constexpr std::size_t none = static_cast<std::size_t>(-1);

/// The sections that meet at a point; none: there is no such section.
struct Meeting {
  std::size_t before = none, behind = none;
};
Meeting meeting(const SplineTask& task, std::size_t point) {
  const std::size_t n = task.sections();
  if (task.periodic) return {(point + n - 1) % n, point};
  return {point > 0 ? point - 1 : none, point < n ? point : none};
}
bool unknown(const SplineTask& task, std::size_t section) { return section != none && !task.is_given(section); }

/// The value conditions of all points as its unknown sections see them: a given section at one side prescribes
/// derivatives up to the point's continuity, and what the user wrote there was for that section.
std::vector<std::vector<ValueCondition>> conditions(const SplineTask& task) {
  std::vector<std::vector<ValueCondition>> out(task.points());
  for (std::size_t p = 0; p < out.size(); ++p) {
    const auto [before, behind] = meeting(task, p);
    const bool given_before = before != none && task.is_given(before);
    const bool given_behind = behind != none && task.is_given(behind);
    if (given_before == given_behind) continue;
    if (!unknown(task, before) && !unknown(task, behind)) continue;
    const GivenSection& given = *task.given[given_before ? before : behind];
    const double more = p == 0 && given_before ? task.travel : 0;
    for (int r = 0; r <= task.continuity[p]; ++r)
      out[p].push_back({p, r, given.end_value(given_before, r) - (r == 0 ? more : 0)});
  }
  for (const ValueCondition& value : task.values) {
    const auto [before, behind] = meeting(task, value.point);
    if (!(before != none && task.is_given(before)) && !(behind != none && task.is_given(behind)))
      out[value.point].push_back(value);
  }
  return out;
}

/// A row of the system: at most two sections take part.
struct Part {
  std::size_t section = none;
  bool at_end = false;
  double factor = 0;
};
struct Row {
  SingularSystem::Row name;
  std::array<Part, 2> parts;
  std::size_t count;
  double value = 0;
};

class System {
 public:
  System(const SplineTask& task, const std::vector<int>& degrees)
      : task_(task), degrees_(degrees), first_(task.sections()), conditions_(conditions(task)) {
    place_columns();
    for (const auto& list : conditions_)
      for (const ValueCondition& c : list)
        if (c.order == 0) {
          reference_ = c.value;
          break;
        }
    place_rows();
  }
  std::size_t size() const { return size_; }
  /// Returns the matrix. It may be called once: the entries move into it.
  SplineMatrix matrix() { return {size_, std::move(entries_)}; }
  const std::vector<double>& right_side() const { return right_; }
  const std::vector<SingularSystem::Row>& names() const { return names_; }

  std::vector<std::vector<double>> coefficients(const std::vector<double>& x, double offset) const {
    std::vector<std::vector<double>> out(task_.sections());
    for (std::size_t s = 0; s < out.size(); ++s)
      for (int k = 0; k <= degrees_[s]; ++k) out[s].push_back(x[first_[s] + static_cast<std::size_t>(k)] + offset);
    return out;
  }
  double reference() const { return reference_; }

 private:
  /// Around a cycle, sections 0, n − 1, 1, n − 2 … follow each other: neighbours stay within two places.
  std::vector<std::size_t> order() const {
    std::vector<std::size_t> list;
    const std::size_t n = task_.sections();
    for (std::size_t i = 0; i < n; ++i) list.push_back(!task_.periodic ? i : i % 2 == 0 ? i / 2 : n - 1 - i / 2);
    return list;
  }
  void place_columns() {
    for (const std::size_t s : order()) {
      first_[s] = size_;
      size_ += static_cast<std::size_t>(degrees_[s] + 1);
    }
  }

  /// Returns the number of conditions that every point gives to the section before it.
  std::vector<int> shares_before() const {
    const std::vector<PointShare> shares = point_shares(task_);
    const std::size_t n = task_.sections();
    for (int start = shares[0].before_max; start >= shares[0].before_min; --start) {
      std::vector<int> before(shares.size());
      before[0] = start;
      bool fits = true;
      for (std::size_t s = 0; s < n && fits; ++s) {
        const std::size_t end = task_.periodic ? (s + 1) % n : s + 1;
        const int taken = task_.is_given(s) ? 0 : degrees_[s] + 1 - (shares[s].total - before[s]);
        fits = taken >= shares[end].before_min && taken <= shares[end].before_max;
        if (end != 0)
          before[end] = taken;
        else
          fits = fits && taken == start;
      }
      if (fits) return before;
    }
    throw std::logic_error("degrees that no distribution has");
  }

  void place_rows() {
    const std::vector<int> before = shares_before();
    std::vector<std::vector<Row>> rows(task_.sections());
    for (std::size_t p = 0; p < task_.points(); ++p) {
      const auto [left, right] = meeting(task_, p);
      const bool both = unknown(task_, left) && unknown(task_, right);
      int to_left = before[p];
      for (const ValueCondition& c : conditions_[p]) {
        const bool here = both ? to_left-- > 0 : unknown(task_, left);
        const std::size_t section = here ? left : right;
        rows[section].push_back({{p, c.order, false},
                                 {Part{section, here, 1}, Part{}},
                                 1,
                                 c.value - (c.order == 0 ? reference_ - (here ? travel_at(p) : 0) : 0)});
      }
      if (!both) continue;
      for (int r = 0; r <= task_.continuity[p]; ++r)
        rows[to_left-- > 0 ? left : right].push_back(
            {{p, r, true}, {Part{left, true, 1}, Part{right, false, -1}}, 2, r == 0 ? travel_at(p) : 0});
    }
    for (const std::size_t s : order())
      for (const Row& row : rows[s]) add(row);
    if (names_.size() != size_) throw std::logic_error("a spline's system is not square");
  }

  /// Returns what the section that ends at a point is higher there than the one that begins.
  double travel_at(std::size_t point) const { return point == 0 && task_.periodic ? task_.travel : 0; }

  void add(const Row& row) {
    // (n!/(n − r)!) / T^r Σ (−1)^(r−k) C(r, k) b_k, at the end with the last coefficients.
    const std::size_t index = names_.size(), from = entries_.size();
    double largest = 0;
    for (std::size_t which = 0; which < row.count; ++which) {
      const Part& part = row.parts[which];
      const int n = degrees_[part.section], r = row.name.order;
      if (r > n) continue;
      const double duration = task_.breaks[part.section + 1] - task_.breaks[part.section];
      double factor = part.factor;
      for (int k = 0; k < r; ++k) factor *= static_cast<double>(n - k) / duration;
      double binomial = 1;
      for (int k = 0; k <= r; ++k) {
        const int at = part.at_end ? n - r + k : k;
        const double value = ((r - k) % 2 == 0 ? factor : -factor) * binomial;
        entries_.push_back({index, first_[part.section] + static_cast<std::size_t>(at), value});
        largest = std::max(largest, std::abs(value));
        binomial *= static_cast<double>(r - k) / static_cast<double>(k + 1);
      }
    }
    const double scale = largest > 0 ? 1 / largest : 1;
    for (std::size_t k = from; k < entries_.size(); ++k) entries_[k].value *= scale;
    right_.push_back(row.value * scale);
    names_.push_back(row.name);
  }

  const SplineTask& task_;
  const std::vector<int>& degrees_;
  std::vector<std::size_t> first_;  // column of a section's first coefficient
  std::vector<std::vector<ValueCondition>> conditions_;
  std::size_t size_ = 0;
  double reference_ = 0;
  std::vector<SplineMatrix::Entry> entries_;
  std::vector<double> right_;
  std::vector<SingularSystem::Row> names_;
};

/// Translates the null vectors into conditions.
SingularSystem explain(const SplineTask& task, const System& system, const SplineMatrix::NullVectors& null) {
  constexpr double noticeable = 0.02;
  SingularSystem out;
  double largest = 0;
  for (const double y : null.left) largest = std::max(largest, std::abs(y));
  for (std::size_t i = 0; i < null.left.size(); ++i)
    if (std::abs(null.left[i]) > noticeable * largest) out.dependent.push_back(system.names()[i]);
  const auto free = system.coefficients(null.right, 0);
  struct Freedom {
    SingularSystem::Row row;
    double size;
  };
  std::vector<Freedom> list;
  double most = 0;
  for (std::size_t s = 0; s < task.sections(); ++s) {
    if (free[s].empty()) continue;
    const LawPiece piece{s, free[s]};
    const CamLaw law({0, 1}, {piece}, false);
    for (const bool end : {false, true}) {
      if (end && (task.periodic || s + 1 < task.sections())) continue;
      for (int r = 0; r < 4; ++r) {
        const double size = std::abs(law.in_piece(0, end ? 1 : 0, r));
        list.push_back({{end ? s + 1 : s, r, false}, size});
        most = std::max(most, size);
      }
    }
  }
  for (const Freedom& each : list)
    if (each.size > noticeable * most) out.undetermined.push_back(each.row);
  return out;
}

}  // namespace

double GivenSection::end_value(bool at_end, int order) const {
  const std::size_t piece = at_end ? bernstein.size() - 1 : 0;
  const CamLaw law({0, breaks[piece + 1] - breaks[piece]}, {{0, bernstein[piece]}}, false);
  return law.in_piece(0, at_end ? 1 : 0, order);
}

std::vector<PointShare> point_shares(const SplineTask& task) {
  const auto values = conditions(task);
  std::vector<PointShare> shares(task.points());
  for (std::size_t p = 0; p < shares.size(); ++p) {
    const auto [left, right] = meeting(task, p);
    const int k = static_cast<int>(values[p].size()), joined = task.continuity[p] + 1;
    if (unknown(task, left) && unknown(task, right))
      shares[p] = {joined + k, k, joined};
    else if (unknown(task, left))
      shares[p] = {k, k, k};
    else
      shares[p] = {k, 0, 0};
  }
  return shares;
}

std::vector<bool> sections_with_unknowns(const SplineTask& task) {
  std::vector<bool> out;
  for (std::size_t s = 0; s < task.sections(); ++s) out.push_back(!task.is_given(s));
  return out;
}

SolvedSpline solve_spline(const SplineTask& task, const std::vector<int>& degrees) {
  System system(task, degrees);
  SolvedSpline out;
  if (system.size() == 0) {
    out.bernstein.resize(task.sections());
    return out;
  }
  const SplineMatrix matrix = system.matrix();
  if (matrix.factors().pivot_ratio() < 1e-7) {
    constexpr int few = 4;  // iterations: the estimate comes down to the singular value
    if (matrix.null_vectors(few).smallest < 10 * singular_below)
      if (const auto null = matrix.null_vectors(); null.smallest < singular_below) {
        out.singular = explain(task, system, null);
        return out;
      }
  }
  std::vector<double> x = system.right_side();
  matrix.factors().solve(x.data());
  out.bernstein = system.coefficients(x, system.reference());
  return out;
}

double spline_condition(const SplineTask& task, const std::vector<int>& degrees) {
  System system(task, degrees);
  return system.size() == 0 ? 1 : system.matrix().condition();
}

CamLaw assemble_law(const SplineTask& task, const SolvedSpline& solved) {
  std::vector<double> breaks{task.breaks.front()};
  std::vector<LawPiece> pieces;
  for (std::size_t s = 0; s < task.sections(); ++s) {
    if (task.is_given(s)) {
      const GivenSection& given = *task.given[s];
      for (std::size_t i = 0; i < given.bernstein.size(); ++i) {
        pieces.push_back({s, given.bernstein[i]});
        breaks.push_back(i + 1 < given.bernstein.size() ? given.breaks[i + 1] : task.breaks[s + 1]);
      }
    } else {
      pieces.push_back({s, solved.bernstein[s]});
      breaks.push_back(task.breaks[s + 1]);
    }
  }
  return {std::move(breaks), std::move(pieces), task.periodic, task.travel};
}

}  // namespace bahnwerk::cam
