#include "core/redundant/iterative/band_program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/numeric/interior_point/interior_point.hpp"

namespace bahnwerk {
namespace {

constexpr double least_objective = 1e-2;  // that the first multipliers are taken from, without a price
constexpr double first_slack = 1e-2;      // that every row has at least at the begin

/// A row's weights without what VariableRow leaves empty: programs do not fit the cache, and every pass reads all rows.
struct PackedRow {
  std::uint32_t first, count;
  std::size_t weights;  ///< place of the first one among all
  double elastic;
};

/// Sums over the entries of `a`; `b` may have more.
double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The program for the driver: variables are y, then w where there is one; a row's upper side is inequality 2i, its
/// lower side 2i + 1; w ≥ 0 is the last one.
class BandSystem final : public InteriorPointSystem {
 public:
  explicit BandSystem(const BandProgram& program)
      : p_(program),
        n_(program.quadratic.size()),
        elastic_(program.price > 0),
        cost_(n_ + (elastic_ ? 1 : 0), 0.0),
        inequality_side_(2 * program.rows.size() + (elastic_ ? 1 : 0), 0.0),
        normal_(program.quadratic),
        border_(n_) {
    std::copy(p_.linear.begin(), p_.linear.end(), cost_.begin());
    if (elastic_) cost_[n_] = p_.price;
    rows_.reserve(p_.rows.size());
    for (std::size_t i = 0; i < p_.rows.size(); ++i) {
      const BandRow& row = p_.rows[i];
      inequality_side_[2 * i] = row.upper;
      inequality_side_[2 * i + 1] = -row.lower;
      rows_.push_back({static_cast<std::uint32_t>(row.row.first), static_cast<std::uint32_t>(row.row.count),
                       weights_.size(), row.elastic});
      weights_.insert(weights_.end(), row.row.weights.begin(),
                      row.row.weights.begin() + static_cast<std::ptrdiff_t>(row.row.count));
    }
  }

  const std::vector<double>& cost() const override { return cost_; }
  const std::vector<double>& equality_side() const override { return equality_side_; }
  const std::vector<double>& inequality_side() const override { return inequality_side_; }

  void multiply(const std::vector<double>& x, std::vector<double>& gx, std::vector<double>& /*ex*/) const override {
    const double w = elastic_ ? x[n_] : 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double a = value_at(i, x), give = rows_[i].elastic * w;
      gx[2 * i] = a - give;
      gx[2 * i + 1] = -a - give;
    }
    if (elastic_) gx.back() = -w;
  }
  void add_transposed(const std::vector<double>& z, const std::vector<double>& /*y*/,
                      std::vector<double>& out) const override {
    double by_w = elastic_ ? -z.back() : 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double upper = z[2 * i], lower = z[2 * i + 1];
      scatter_at(i, upper - lower, out);
      by_w -= rows_[i].elastic * (upper + lower);
    }
    if (elastic_) out[n_] += by_w;
  }
  void add_quadratic(const std::vector<double>& x, std::vector<double>& out) const override {
    p_.quadratic.multiply(x, out);
  }

  /// The band by Cholesky's method, w by its Schur complement.
  bool factor(const std::vector<double>& weights) override {
    normal_ = p_.quadratic;
    std::fill(border_.begin(), border_.end(), 0.0);
    double corner = elastic_ ? weights.back() : 1;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const PackedRow& row = rows_[i];
      const double upper = weights[2 * i], lower = weights[2 * i + 1];
      normal_.add(row.first, row.count, &weights_[row.weights], upper + lower);
      if (row.elastic > 0) {
        scatter_at(i, row.elastic * (lower - upper), border_);
        corner += row.elastic * row.elastic * (upper + lower);
      }
    }
    if (!normal_.factor()) return false;
    solved_border_ = border_;
    if (elastic_) normal_.solve(solved_border_);
    complement_ = corner - dot(solved_border_, border_);
    return true;
  }
  void solve(std::vector<double>& x, std::vector<double>& /*y*/) const override {
    const double w = elastic_ ? (x[n_] - dot(solved_border_, x)) / complement_ : 0;
    x.resize(n_);
    normal_.solve(x);
    if (!elastic_) return;
    for (std::size_t i = 0; i < n_; ++i) x[i] -= w * solved_border_[i];
    x.push_back(w);
  }

  /// Slacks of at least `first_slack` and multipliers of one product with them.
  InteriorPoint start(const std::vector<double>& y) const {
    InteriorPoint point;
    point.x = y;
    point.s.resize(inequality_side_.size());
    double excess = 0;
    for (std::size_t i = 0; i < p_.rows.size(); ++i) {
      const BandRow& row = p_.rows[i];
      const double a = value_at(i, y);
      if (row.elastic > 0) excess = std::max({excess, (a - row.upper) / row.elastic, (row.lower - a) / row.elastic});
    }
    const double w = elastic_ ? 1.1 * excess + first_slack : 0;
    if (elastic_) point.x.push_back(w), point.s.back() = w;
    double share = elastic_ ? 1 / w : 0;  // Σ e/s: what the multipliers of w take of its price
    for (std::size_t i = 0; i < p_.rows.size(); ++i) {
      const BandRow& row = p_.rows[i];
      const double a = value_at(i, y), give = row.elastic * w;
      double &upper = point.s[2 * i], &lower = point.s[2 * i + 1];
      upper = std::max(row.upper + give - a, first_slack);
      lower = std::max(a - row.lower + give, first_slack);
      share += row.elastic * (1 / upper + 1 / lower);
    }
    // With a price the multipliers begin where that of w is met: a start far from it takes w to where rounding rules.
    std::vector<double> qx(point.x.size(), 0.0);
    add_quadratic(point.x, qx);
    const double objective = std::abs(0.5 * dot(qx, point.x) + dot(cost_, point.x));
    const double mu =
        elastic_ ? p_.price / share : std::max(objective, least_objective) / static_cast<double>(point.s.size());
    for (const double s : point.s) point.z.push_back(mu / s);
    return point;
  }

 private:
  double value_at(std::size_t row, const std::vector<double>& x) const {
    const double *const a = &weights_[rows_[row].weights], *const y = &x[rows_[row].first];
    return with_constant(rows_[row].count, [&](auto count) {
      double sum = 0;
      for (std::size_t r = 0; r < count; ++r) sum += a[r] * y[r];
      return sum;
    });
  }
  void scatter_at(std::size_t row, double factor, std::vector<double>& out) const {
    const double* const a = &weights_[rows_[row].weights];
    double* const y = &out[rows_[row].first];
    with_constant(rows_[row].count, [&](auto count) {
      for (std::size_t r = 0; r < count; ++r) y[r] += factor * a[r];
    });
  }

  const BandProgram& p_;
  std::size_t n_;
  bool elastic_;
  std::vector<double> cost_, equality_side_, inequality_side_;
  std::vector<PackedRow> rows_;
  std::vector<double> weights_;  // weights of all rows
  SymmetricBand<> normal_;
  std::vector<double> border_, solved_border_;
  double complement_ = 1;
};

}  // namespace

BandSolution solve(const BandProgram& program, const std::vector<double>& start, const BandProgramOptions& options) {
  BandSystem system(program);
  InteriorPoint point = system.start(start);
  InteriorPointOptions interior;
  interior.gap = options.gap;
  interior.primal_residual = options.residual;
  interior.dual_residual = options.gap * (1 + program.price);
  interior.common_step = true;
  interior.refined = false;
  interior.max_iterations = options.max_iterations;
  interior.tick = options.tick;
  const InteriorPointResult result = solve_interior_point(system, point, interior);
  BandSolution solution;
  solution.converged = result.converged;
  solution.iterations = result.iterations;
  if (program.price > 0) {
    solution.w = point.x.back();
    point.x.pop_back();
  }
  solution.y = std::move(point.x);
  return solution;
}

}  // namespace bahnwerk
