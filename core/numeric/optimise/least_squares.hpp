#pragma once
/// Linear least squares with sign constraints.
#include <Eigen/Core>
#include <functional>

namespace bahnwerk {

/// Minimises ‖Ay − b‖₂ with y_k ≥ 0 for k ≥ `free`; the first `free` may have any sign [Lawson, Hanson: Solving Least
/// Squares Problems, 1974, ch. 23]. Each step is a pivoted Householder QR of the columns in use, so dependent columns
/// are harmless. It starts from all columns and drops the negative ones, which leaves few steps of the method itself.
/// `step` is called before each factorisation (2 · rows · columns² operations) and may throw.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, Eigen::Index free,
                                           const std::function<void()>& step);

}  // namespace bahnwerk
