#include "core/numeric/interior_point/interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

using Vector = std::vector<double>;

// Sums and maxima run over every fourth entry, four at once: one after the other they would wait for each other.
constexpr std::size_t lanes = 4;

/// Returns the sum of term(i) for i < size.
template <class Term>
double sum_of(std::size_t size, const Term& term) {
  double sum[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) sum[k] += term(i + k);
  for (; i < size; ++i) sum[0] += term(i);
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}
/// Returns the largest term(i) for i < size, or `least`.
template <class Term>
double most_of(std::size_t size, double least, const Term& term) {
  double most[lanes] = {least, least, least, least};
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) {
      const double value = term(i + k);
      most[k] = most[k] < value ? value : most[k];
    }
  for (; i < size; ++i) most[0] = std::max(most[0], term(i));
  return std::max({most[0], most[1], most[2], most[3]});
}
double dot(const Vector& a, const Vector& b) {
  return sum_of(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}
double largest(const Vector& a) {
  return most_of(a.size(), 0, [&](std::size_t i) { return std::abs(a[i]); });
}

constexpr int most_directions = 12;  // largest number of directions of GMRES

/// The program as a problem of the driver.
class Program final : public InteriorPointProblem {
 public:
  Program(InteriorPointSystem& system, InteriorPoint& point, const InteriorPointOptions& options)
      : system_(system),
        p_(point),
        options_(options),
        variables_(p_.x.size()),
        equalities_(p_.y.size()),
        rows_(p_.s.size()),
        gx_(rows_),
        ds_(rows_),
        dz_(rows_),
        predicted_(rows_),
        weights_(rows_),
        push_(rows_),
        row_residual_(rows_),
        ex_(equalities_),
        qx_(variables_),
        dual_residual_(variables_),
        equality_residual_(equalities_) {}

  InteriorPointFigures evaluate(double /*mu*/) override {
    residuals();
    InteriorPointFigures figures;
    figures.scale = 1 + std::abs(dot(system_.cost(), p_.x) + 0.5 * dot(qx_, p_.x));
    figures.complementarity = dot(p_.s, p_.z);
    figures.weight = static_cast<double>(std::max<std::size_t>(rows_, 1));
    figures.primal_residual = std::max(largest(row_residual_), largest(equality_residual_));
    return figures;
  }
  double dual_residual() override { return largest(dual_residual_); }
  bool factor() override {
    for (std::size_t i = 0; i < rows_; ++i) weights_[i] = p_.z[i] / p_.s[i];
    return system_.factor(weights_);
  }
  std::optional<double> predict() override {
    std::fill(predicted_.begin(), predicted_.end(), 0.0);
    direct(0);
    const double primal = step_length(primal_reach(), 1), dual = step_length(dual_reach(), 1);
    const double after =
        sum_of(rows_, [&](std::size_t i) { return (p_.s[i] + primal * ds_[i]) * (p_.z[i] + dual * dz_[i]); });
    for (std::size_t i = 0; i < rows_; ++i) predicted_[i] = ds_[i] * dz_[i];
    return rows_ ? after / dot(p_.s, p_.z) : 0;
  }
  StepLengths step(double mu) override {
    direct(mu);
    if (!finite()) return {unlimited, unlimited};
    StepLengths taken{step_length(primal_reach()), step_length(dual_reach())};
    if (options_.common_step) taken.primal = taken.dual = std::min(taken.primal, taken.dual);
    for (std::size_t i = 0; i < variables_; ++i) p_.x[i] += taken.primal * dx_[i];
    for (std::size_t i = 0; i < equalities_; ++i) p_.y[i] += taken.dual * dy_[i];
    for (std::size_t i = 0; i < rows_; ++i) {
      p_.s[i] += taken.primal * ds_[i];
      p_.z[i] += taken.dual * dz_[i];
    }
    return taken;
  }

 private:
  static constexpr double unlimited = std::numeric_limits<double>::infinity();
  bool finite() const {
    const auto all = [](const Vector& a) {
      return std::all_of(a.begin(), a.end(), [](double value) { return std::isfinite(value); });
    };
    return all(dx_) && all(dy_);
  }
  double primal_reach() const {
    return most_of(rows_, 0, [&](std::size_t i) { return -ds_[i] / p_.s[i]; });
  }
  double dual_reach() const {
    return most_of(rows_, 0, [&](std::size_t i) { return -dz_[i] / p_.z[i]; });
  }

  void residuals() {
    system_.multiply(p_.x, gx_, ex_);
    const Vector &g = system_.inequality_side(), &e = system_.equality_side();
    for (std::size_t i = 0; i < rows_; ++i) row_residual_[i] = gx_[i] + p_.s[i] - g[i];
    for (std::size_t i = 0; i < equalities_; ++i) equality_residual_[i] = ex_[i] - e[i];
    std::fill(qx_.begin(), qx_.end(), 0.0);
    system_.add_quadratic(p_.x, qx_);
    dual_residual_ = system_.cost();
    for (std::size_t i = 0; i < variables_; ++i) dual_residual_[i] += qx_[i];
    system_.add_transposed(p_.z, p_.y, dual_residual_);
  }

  /// Newton's step towards s z = target − predicted.
  void direct(double target) {
    for (std::size_t i = 0; i < rows_; ++i)
      push_[i] = (target - predicted_[i] + p_.z[i] * row_residual_[i]) / p_.s[i] - p_.z[i];
    right_x_ = dual_residual_;
    none_.assign(equalities_, 0);
    system_.add_transposed(push_, none_, right_x_);
    for (double& value : right_x_) value = -value;
    right_y_ = equality_residual_;
    for (double& value : right_y_) value = -value;
    dx_ = right_x_;
    dy_ = right_y_;
    if (options_.refined)
      solve_refined(system_, weights_, dx_, dy_);
    else
      system_.solve(dx_, dy_);
    system_.multiply(dx_, gx_, ex_);
    for (std::size_t i = 0; i < rows_; ++i) {
      ds_[i] = -row_residual_[i] - gx_[i];
      dz_[i] = push_[i] + weights_[i] * gx_[i];
    }
  }

  InteriorPointSystem& system_;
  InteriorPoint& p_;
  const InteriorPointOptions& options_;
  std::size_t variables_, equalities_, rows_;
  Vector gx_, ds_, dz_, predicted_, weights_, push_, row_residual_, ex_, qx_, dual_residual_, equality_residual_;
  Vector right_x_, right_y_, dx_, dy_, none_;
};

}  // namespace

void solve_refined(const InteriorPointSystem& system, const std::vector<double>& weights, std::vector<double>& x,
                   std::vector<double>& y) {
  const Vector right_x = x, right_y = y;
  const std::size_t variables = x.size(), size = x.size() + y.size();
  Vector ax(variables), ay(y.size()), gx(weights.size()), residual(size);
  const auto apply = [&](const Vector& from_x, const Vector& from_y) {
    system.multiply(from_x, gx, ay);
    for (std::size_t i = 0; i < gx.size(); ++i) gx[i] *= weights[i];
    std::fill(ax.begin(), ax.end(), 0.0);
    system.add_quadratic(from_x, ax);
    system.add_transposed(gx, from_y, ax);
  };
  system.solve(x, y);
  apply(x, y);
  for (std::size_t i = 0; i < variables; ++i) residual[i] = right_x[i] - ax[i];
  for (std::size_t i = 0; i < y.size(); ++i) residual[variables + i] = right_y[i] - ay[i];
  const double aim = 1e-13 + 1e-11 * std::max(largest(right_x), largest(right_y));
  if (largest(residual) <= aim) return;
  std::vector<Vector> basis, directions_x, directions_y, columns;  // columns: of the rotated Hessenberg matrix
  Vector cosine, sine, right;
  const double length = std::sqrt(dot(residual, residual));
  if (!std::isfinite(length)) return;
  for (double& value : residual) value /= length;
  basis.push_back(std::move(residual));
  right.push_back(length);
  for (int k = 0; k < most_directions && std::abs(right.back()) > aim; ++k) {
    const Vector& last = basis.back();
    Vector along_x(last.begin(), last.begin() + static_cast<std::ptrdiff_t>(variables));
    Vector along_y(last.begin() + static_cast<std::ptrdiff_t>(variables), last.end());
    system.solve(along_x, along_y);
    apply(along_x, along_y);
    Vector next(ax), column;
    next.insert(next.end(), ay.begin(), ay.end());
    for (const Vector& other : basis) {
      const double share = dot(next, other);
      column.push_back(share);
      for (std::size_t i = 0; i < size; ++i) next[i] -= share * other[i];
    }
    const double rest = std::sqrt(dot(next, next));
    for (std::size_t i = 0; i < cosine.size(); ++i) {
      const double a = column[i], b = column[i + 1];
      column[i] = cosine[i] * a + sine[i] * b;
      column[i + 1] = cosine[i] * b - sine[i] * a;
    }
    const double hypotenuse = std::hypot(column.back(), rest);
    if (!(hypotenuse > 0) || !std::isfinite(hypotenuse)) break;
    cosine.push_back(column.back() / hypotenuse);
    sine.push_back(rest / hypotenuse);
    column.back() = hypotenuse;
    const double now = right.back();
    right.back() = cosine.back() * now;
    right.push_back(-sine.back() * now);
    columns.push_back(std::move(column));
    directions_x.push_back(std::move(along_x));
    directions_y.push_back(std::move(along_y));
    if (!(rest > 0)) break;
    for (double& value : next) value /= rest;
    basis.push_back(std::move(next));
  }
  for (std::size_t k = columns.size(); k-- > 0;) {
    double share = right[k];
    for (std::size_t j = k + 1; j < columns.size(); ++j) share -= columns[j][k] * right[j];
    right[k] = share /= columns[k][k];
    for (std::size_t i = 0; i < variables; ++i) x[i] += share * directions_x[k][i];
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += share * directions_y[k][i];
  }
}

InteriorPointResult solve_interior_point(InteriorPointSystem& system, InteriorPoint& point,
                                         const InteriorPointOptions& options) {
  Program program(system, point, options);
  return run_interior_point(program, options);
}

DualValue dual_value(const InteriorPointSystem& system, const std::vector<double>& y, const std::vector<double>& z) {
  std::vector<double> multipliers = z;
  for (double& value : multipliers) value = std::max(value, 0.0);
  DualValue result{-dot(system.inequality_side(), multipliers) - dot(system.equality_side(), y), system.cost()};
  system.add_transposed(multipliers, y, result.residual);
  return result;
}

}  // namespace bahnwerk
