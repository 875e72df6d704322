#include "core/redundant/iterative/band_program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double keep = 0.995;            // share of the step to the nearest bound
constexpr double least_objective = 1e-2;  // least objective from which the first multipliers follow, without a price
constexpr double first_slack = 1e-2;      // least slack of every row at the start

template <std::size_t C>
double value_of(const VariableRow& row, const double* y, std::size_t any) {
  double sum = 0;
  for (std::size_t r = 0; r < (C > 0 ? C : any); ++r) sum += row.weights[r] * y[r];
  return sum;
}
double value(const VariableRow& row, const std::vector<double>& all) {
  const double* const y = all.data() + row.first;
  switch (row.count) {
    case 2:
      return value_of<2>(row, y, 2);
    case 3:
      return value_of<3>(row, y, 3);
    case 4:
      return value_of<4>(row, y, 4);
    case 5:
      return value_of<5>(row, y, 5);
    default:
      return value_of<0>(row, y, row.count);
  }
}
template <std::size_t C>
void scatter_of(const VariableRow& row, double factor, double* out, std::size_t any) {
  for (std::size_t r = 0; r < (C > 0 ? C : any); ++r) out[r] += factor * row.weights[r];
}
void scatter(const VariableRow& row, double factor, std::vector<double>& all) {
  double* const out = all.data() + row.first;
  switch (row.count) {
    case 2:
      return scatter_of<2>(row, factor, out, 2);
    case 3:
      return scatter_of<3>(row, factor, out, 3);
    case 4:
      return scatter_of<4>(row, factor, out, 4);
    case 5:
      return scatter_of<5>(row, factor, out, 5);
    default:
      return scatter_of<0>(row, factor, out, row.count);
  }
}
double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Slack s of one side of a row, its multiplier z, and their steps.
struct Side {
  double s = 0, z = 0;
  double ds = 0, dz = 0;
  double residual = 0, complement = 0;
};
struct Pair {
  Side upper, lower;
};

class Solver {
 public:
  Solver(const BandProgram& program, const std::vector<double>& start, const BandProgramOptions& options)
      : p_(program),
        options_(options),
        elastic_(program.price > 0),
        n_(program.quadratic.size()),
        y_(start),
        dy_(n_),
        border_(n_),
        normal_(program.quadratic),
        pairs_(program.rows.size()) {
    begin();
  }

  BandSolution run() {
    BandSolution result;
    for (; result.iterations < options_.max_iterations; ++result.iterations) {
      if (options_.tick) options_.tick();
      residuals();
      const double objective = value_now();
      const double mu = mean_;
      if (mu * count() <= options_.gap * (1 + std::abs(objective)) && worst_ <= options_.residual &&
          dual_ <= options_.gap) {
        result.converged = true;
        break;
      }
      if (!factor()) break;
      step<false>(0);
      const double primal = primal_, dual = dual_length_;
      double after = elastic_ ? (w_.s + primal * w_.ds) * (w_.z + dual * w_.dz) : 0;
      for (const Pair& pair : pairs_)
        for (const Side* side : {&pair.upper, &pair.lower})
          after += (side->s + primal * side->ds) * (side->z + dual * side->dz);
      const double share = after / count() / mu;
      step<true>(share * share * share * mu);
      move();
    }
    result.y = std::move(y_);
    result.w = elastic_ ? w_.s : 0;
    return result;
  }

 private:
  double value_now() const {
    double sum = 0.5 * dot(y_, qy_) + p_.price * w_.s;
    for (std::size_t i = 0; i < p_.linear.size(); ++i) sum += p_.linear[i] * y_[i];
    return sum;
  }
  double count() const { return static_cast<double>(2 * pairs_.size() + (elastic_ ? 1 : 0)); }

  void begin() {
    qy_.assign(n_, 0);
    p_.quadratic.multiply(y_, qy_);
    double excess = 0;
    for (const BandRow& row : p_.rows) {
      const double a = value(row.row, y_);
      if (row.elastic > 0) excess = std::max({excess, (a - row.upper) / row.elastic, (row.lower - a) / row.elastic});
    }
    w_.s = elastic_ ? 1.1 * excess + first_slack : 0;
    double share = elastic_ ? 1 / w_.s : 0;  // Σ e/s: what the multipliers of w take of its price
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const BandRow& row = p_.rows[i];
      const double a = value(row.row, y_), give = row.elastic * w_.s;
      pairs_[i].upper.s = std::max(row.upper + give - a, first_slack);
      pairs_[i].lower.s = std::max(a - row.lower + give, first_slack);
      share += row.elastic * (1 / pairs_[i].upper.s + 1 / pairs_[i].lower.s);
    }
    // With a price γ the multipliers begin where the dual condition of w holds; from a start far away w would reach
    // values dominated by rounding.
    const double objective = std::abs(value_now());
    const double mu = elastic_ ? p_.price / share : std::max(objective, least_objective) / count();
    for (Pair& pair : pairs_)
      for (Side* side : {&pair.upper, &pair.lower}) side->z = mu / side->s;
    w_.z = elastic_ ? mu / w_.s : 0;
  }

  void residuals() {
    std::fill(qy_.begin(), qy_.end(), 0.0);
    p_.quadratic.multiply(y_, qy_);
    gradient_ = qy_;
    for (std::size_t i = 0; i < p_.linear.size(); ++i) gradient_[i] += p_.linear[i];
    by_w_ = p_.price - w_.z;
    worst_ = 0;
    double products = elastic_ ? w_.s * w_.z : 0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const BandRow& row = p_.rows[i];
      Side &u = pairs_[i].upper, &l = pairs_[i].lower;
      products += u.s * u.z + l.s * l.z;
      const double a = value(row.row, y_), give = row.elastic * w_.s;
      u.residual = row.upper + give - a - u.s;
      l.residual = a - row.lower + give - l.s;
      worst_ = std::max({worst_, std::abs(u.residual), std::abs(l.residual)});
      scatter(row.row, u.z - l.z, gradient_);
      by_w_ -= row.elastic * (u.z + l.z);
    }
    mean_ = products / count();
    if (!elastic_) by_w_ = 0;
    double most = std::abs(by_w_), size = 1 + p_.price;
    for (std::size_t i = 0; i < n_; ++i) {
      most = std::max(most, std::abs(gradient_[i]));
      size = std::max(size, std::abs(qy_[i]));
    }
    dual_ = most / size;
  }

  bool factor() {
    normal_ = p_.quadratic;
    std::fill(border_.begin(), border_.end(), 0.0);
    corner_ = elastic_ ? w_.z / w_.s : 1;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const BandRow& row = p_.rows[i];
      const double u = pairs_[i].upper.z / pairs_[i].upper.s, l = pairs_[i].lower.z / pairs_[i].lower.s;
      normal_.add(row.row, u + l);
      if (row.elastic > 0) {
        scatter(row.row, row.elastic * (l - u), border_);
        corner_ += row.elastic * row.elastic * (u + l);
      }
    }
    if (!normal_.factor()) return false;
    solved_border_ = border_;
    if (elastic_) normal_.solve(solved_border_);
    return true;
  }

  /// Computes Newton's step for s z = complement on all sides: 0 in the predictor; in the corrector `centre` less the
  /// predictor's second-order term. Also computes the step lengths, at most 1, up to which slacks and multipliers stay
  /// positive. Large programs do not fit the cache, so everything is done in two passes over the rows.
  template <bool corrector>
  void step(double centre) {
    const auto aim = [centre](Side& side) { side.complement = corrector ? centre - side.ds * side.dz : 0; };
    const auto push = [](const Side& side) { return (side.complement - side.z * side.residual) / side.s - side.z; };
    double right_w = -by_w_;
    for (std::size_t i = 0; i < n_; ++i) dy_[i] = -gradient_[i];
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const BandRow& row = p_.rows[i];
      aim(pairs_[i].upper), aim(pairs_[i].lower);
      const double u = push(pairs_[i].upper), l = push(pairs_[i].lower);
      scatter(row.row, l - u, dy_);
      right_w += row.elastic * (u + l);
    }
    aim(w_);
    double dw = 0;
    if (elastic_) {
      right_w += w_.complement / w_.s - w_.z;
      dw = (right_w - dot(solved_border_, dy_)) / (corner_ - dot(solved_border_, border_));
    }
    normal_.solve(dy_);
    if (elastic_)
      for (std::size_t i = 0; i < n_; ++i) dy_[i] -= dw * solved_border_[i];
    primal_ = dual_length_ = 1;
    const auto look = [this](const Side& side) {
      if (side.ds < 0) primal_ = std::min(primal_, -side.s / side.ds);
      if (side.dz < 0) dual_length_ = std::min(dual_length_, -side.z / side.dz);
    };
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const BandRow& row = p_.rows[i];
      Side &u = pairs_[i].upper, &l = pairs_[i].lower;
      const double a = value(row.row, dy_), give = row.elastic * dw;
      u.ds = u.residual - a + give;
      l.ds = l.residual + a + give;
      for (Side* side : {&u, &l}) {
        side->dz = (side->complement - side->z * side->ds) / side->s - side->z;
        look(*side);
      }
    }
    w_.ds = dw;
    w_.dz = elastic_ ? (w_.complement - w_.z * dw) / w_.s - w_.z : 0;
    if (elastic_) look(w_);
  }

  void move() {
    const double least = std::min(primal_, dual_length_), step = least < 1 ? keep * least : 1;
    // One step length is used for both, because a quadratic objective couples rows and multipliers.
    for (std::size_t i = 0; i < n_; ++i) y_[i] += step * dy_[i];
    const auto go = [step](Side& side) { side.s += step * side.ds, side.z += step * side.dz; };
    for (Pair& pair : pairs_) go(pair.upper), go(pair.lower);
    if (elastic_) go(w_);
  }

  const BandProgram& p_;
  const BandProgramOptions& options_;
  bool elastic_;
  std::size_t n_;
  std::vector<double> y_, dy_, qy_, gradient_, border_, solved_border_;
  BandMatrix normal_;
  double corner_ = 1, by_w_ = 0, worst_ = 0, dual_ = 0, mean_ = 0, primal_ = 1, dual_length_ = 1;
  std::vector<Pair> pairs_;
  Side w_;
};

}  // namespace

BandSolution solve(const BandProgram& program, const std::vector<double>& start, const BandProgramOptions& options) {
  return Solver(program, start, options).run();
}

}  // namespace bahnwerk
