#include "core/numeric/optimise/least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace bahnwerk {

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, Eigen::Index free,
                                           const std::function<void()>& step) {
  const Eigen::Index n = a.cols();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  if (n == 0) return y;
  std::vector<Eigen::Index> used(static_cast<std::size_t>(n));
  std::iota(used.begin(), used.end(), Eigen::Index{0});
  const auto solve = [&] {
    step();
    Eigen::VectorXd full = Eigen::VectorXd::Zero(n);
    if (used.empty()) return full;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr;
    qr.setThreshold(1e-12);
    const Eigen::VectorXd part = qr.compute(a(Eigen::all, used)).solve(b);
    full(used) = part;
    return full;
  };
  const auto drop_non_positive = [&](const Eigen::VectorXd& values) {
    return std::erase_if(used, [&](Eigen::Index k) { return k >= free && !(values[k] > 0); });
  };
  do y = solve();
  while (drop_non_positive(y) > 0);

  const Eigen::VectorXd norms = a.colwise().norm();
  const double rounding = 1e-14 * b.norm();
  std::vector<bool> closed;  // whether it is in use, or was tried without success since y last changed
  for (Eigen::Index k = 0; k < 3 * n; ++k) {
    closed.assign(static_cast<std::size_t>(n), false);
    for (const Eigen::Index i : used) closed[static_cast<std::size_t>(i)] = true;
    const Eigen::VectorXd slope = a.transpose() * (b - a * y);
    bool moved = false;
    while (!moved) {
      Eigen::Index enter = -1;
      double steepest = rounding;
      for (Eigen::Index i = 0; i < n; ++i)
        if (!closed[static_cast<std::size_t>(i)] && slope[i] > steepest * norms[i]) {
          steepest = slope[i] / norms[i];
          enter = i;
        }
      if (enter < 0) return y;
      closed[static_cast<std::size_t>(enter)] = true;
      used.push_back(enter);
      Eigen::VectorXd next = solve();
      if (!(next[enter] > 0)) {  // the variable seemed useful by rounding only
        used.pop_back();
        continue;
      }
      moved = true;
      while (true) {  // go towards `next` until the first of y reaches 0
        double part = 1;
        Eigen::Index leave = -1;
        for (const Eigen::Index i : used)
          if (i >= free && !(next[i] > 0)) {
            const double reach = y[i] > 0 ? y[i] / (y[i] - next[i]) : 0;
            if (leave >= 0 && reach >= part) continue;
            part = reach;
            leave = i;
          }
        if (leave < 0) break;
        y += part * (next - y);
        y[leave] = 0;
        drop_non_positive(y);
        next = solve();
      }
      y = next;
    }
  }
  return y;
}

}  // namespace bahnwerk
