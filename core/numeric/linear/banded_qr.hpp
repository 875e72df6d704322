#pragma once
/// Least squares problems whose rows reach over a few neighbouring nodes, by orthogonal factors that are made node by
/// node [Lawson & Hanson, "Solving Least Squares Problems", ch. 27]. Their normal equations JᵀJ would square the
/// condition number (Golub & Van Loan, "Matrix Computations", 5.3).
#include <Eigen/Core>
#include <Eigen/StdVector>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// `B` unknowns per node, rows that reach from a node over `W` nodes, `R` right-hand sides; at most `Rows` rows at
/// once: those that begin at a node, and up to B (W − 1) that earlier ones leave.
template <int B, int W, int R, int Rows>
class BandedQr {
 public:
  static constexpr int columns = B * W, width = columns + R;

  explicit BandedQr(std::size_t nodes) : factor_(nodes) {}

  /// Begins a problem; all its rows follow.
  void clear() {
    work_.setZero();
    height_ = 0;
    residual_.fill(0);
  }
  /// Adds a row of zeros that begins at the node which close() takes next. Unknown i of its node n is column n B + i,
  /// the right-hand sides follow the unknowns.
  auto add_row() { return work_.row(height_++); }
  /// Eliminates the unknowns of a node, in order of nodes. `known(m)`: the unknowns of node m are 0. Returns whether
  /// the rows say what the node's unknowns are.
  template <class Known>
  bool close(std::size_t node, Known&& known) {
    reduce(node, known);
    const int taken = known(node) ? 0 : B, left = std::max(0, height_ - taken);
    if (taken == 0) {
      factor_[node].setZero();
    } else {
      factor_[node] = work_.template topRows<B>();
      for (int i = 0; i < B; ++i)
        if (!(std::abs(factor_[node](i, i)) > 0) || !std::isfinite(factor_[node](i, i))) return false;
    }
    // The rows of this node are done; what is left moves up and to the left.
    for (int i = 0; i < left; ++i) {
      for (int c = 0; c < columns; ++c) work_(i, c) = c + B < columns ? work_(i + taken, c + B) : 0;
      for (int c = columns; c < width; ++c) work_(i, c) = work_(i + taken, c);
    }
    for (int i = left; i < height_; ++i) work_.row(i).setZero();
    height_ = left;
    return true;
  }
  /// Returns the square of the length of right-hand side r less what the unknowns can take of it.
  double residual(int r) const { return residual_[static_cast<std::size_t>(r)]; }
  /// Returns the scalar product of the parts of two right-hand sides that the unknowns can take.
  double product(int r, int s) const {
    double sum = 0;
    for (const Factor& f : factor_)
      for (int i = 0; i < B; ++i) sum += f(i, columns + r) * f(i, columns + s);
    return sum;
  }
  /// Computes the unknowns for the right-hand side Σ share_r · right-hand side r; those of known nodes are 0.
  template <class Known>
  void solve(const std::array<double, R>& share, Known&& known, std::vector<std::array<double, B>>& x) const {
    for (std::size_t k = factor_.size(); k-- > 0;)
      for (int i = B; i-- > 0;) {
        const Factor& f = factor_[k];
        double sum = 0;
        for (int r = 0; r < R; ++r) sum += share[static_cast<std::size_t>(r)] * f(i, columns + r);
        for (int c = i + 1; c < columns; ++c) {
          const std::size_t m = k + static_cast<std::size_t>(c / B);
          if (m < factor_.size()) sum -= f(i, c) * x[m][static_cast<std::size_t>(c % B)];
        }
        x[k][static_cast<std::size_t>(i)] = known(k) ? 0 : sum / f(i, i);
      }
  }

 private:
  using Factor = Eigen::Matrix<double, B, width>;

  /// Householder reflections: the columns of the rows in use become a triangle.
  template <class Known>
  void reduce(std::size_t node, Known&& known) {
    const int rows = height_;
    int p = 0;  // the row that this column's reflection fills
    for (int c = 0; c < columns && p < rows; ++c) {
      const std::size_t at = node + static_cast<std::size_t>(c / B);
      if (at >= factor_.size() || known(at)) continue;
      double sum = 0;
      for (int i = p + 1; i < rows; ++i) sum += work_(i, c) * work_(i, c);
      if (sum > 0) {
        const double head = work_(p, c), norm = std::sqrt(sum + head * head);
        const double v0 = head > 0 ? head + norm : head - norm;
        const double beta = 2 / (v0 * v0 + sum);
        for (int j = c + 1; j < width; ++j) {
          double dot = v0 * work_(p, j);
          for (int i = p + 1; i < rows; ++i) dot += work_(i, c) * work_(i, j);
          dot *= beta;
          work_(p, j) -= dot * v0;
          for (int i = p + 1; i < rows; ++i) work_(i, j) -= dot * work_(i, c);
        }
        work_(p, c) = head > 0 ? -norm : norm;
        for (int i = p + 1; i < rows; ++i) work_(i, c) = 0;
      }
      ++p;
    }
    for (int i = p; i < rows; ++i) {
      for (int r = 0; r < R; ++r)
        residual_[static_cast<std::size_t>(r)] += work_(i, columns + r) * work_(i, columns + r);
      work_.row(i).setZero();
    }
    height_ = p;
  }

  std::vector<Factor, Eigen::aligned_allocator<Factor>> factor_;
  Eigen::Matrix<double, Rows, width> work_;  // rows that reach over the node to be closed
  int height_ = 0;                           // rows in use
  std::array<double, R> residual_{};
};

}  // namespace bahnwerk
