#include "core/numeric/optimise/kkt.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/optimise/least_squares.hpp"

namespace bahnwerk {

double kkt_residual(OptimisationEvaluator& evaluator, const OptimisationPoint& point) {
  using Eigen::Index;
  constexpr double near = 1e-3;
  struct Active {
    std::size_t index;  // index of a row or of a variable
    double sign;        // sign of a bound's gradient; 0: a row
    double slack;
  };
  const std::size_t n = point.z.size(), inequalities = evaluator.problem().inequality.rows;
  std::vector<Active> active;
  for (std::size_t i = inequalities; i < point.rows.size(); ++i) active.push_back({i, 0, 0});
  const auto equalities = static_cast<Index>(active.size());
  for (std::size_t i = 0; i < inequalities; ++i)
    if (point.rows[i] >= -near) active.push_back({i, 0, point.rows[i]});
  for (std::size_t j = 0; j < n; ++j) {
    if (point.z[j] - evaluator.lower(j) <= near) active.push_back({j, -1, evaluator.lower(j) - point.z[j]});
    if (evaluator.upper(j) - point.z[j] <= near) active.push_back({j, 1, point.z[j] - evaluator.upper(j)});
  }

  // Stationarity ∇f + Jᵀλ = 0 on top, complementarity λᵢcᵢ = 0 below: a multiplier on a row that is not quite active
  // costs what it is.
  const auto rows = static_cast<Index>(n), columns = static_cast<Index>(active.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows + columns, columns);
  for (Index k = 0; k < columns; ++k) {
    const Active& row = active[static_cast<std::size_t>(k)];
    if (row.sign != 0) {
      a(static_cast<Index>(row.index), k) = row.sign;
    } else {
      a.col(k).head(rows) = Eigen::Map<const Eigen::VectorXd>(point.jacobian.data() + row.index * n, rows);
    }
    a(rows + k, k) = row.slack;
  }
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows + columns);
  b.head(rows) = -Eigen::Map<const Eigen::VectorXd>(point.gradient.data(), rows);
  const Eigen::VectorXd multipliers = non_negative_least_squares(a, b, equalities, [&] { evaluator.report(); });
  const double gradient = b.lpNorm<Eigen::Infinity>();
  return (a * multipliers - b).lpNorm<Eigen::Infinity>() / std::max(1.0, gradient);
}

}  // namespace bahnwerk
