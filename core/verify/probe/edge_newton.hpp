#pragma once
/// The Newton step of the search for an edge's multipliers, by a QR factorization, sample by sample.
///
/// The matrix in the samples is JᵀJ, J the weighted differences; both right-hand sides have the form Jᵀv. Orthogonal
/// factors of J cost twice as much as a Cholesky factor of JᵀJ, and do not square the condition number, about
/// (samples)^4 (Golub & Van Loan, "Matrix Computations", 5.3).
#include <Eigen/Dense>
#include <vector>

#include "core/verify/probe/edge_samples.hpp"

namespace bahnwerk {

/// An iterate of the search.
template <int D>
struct EdgeIterate {
  std::vector<std::array<double, D>> x;  ///< samples
  double h = 0;
  std::vector<double> slack, dual;  ///< slacks and multipliers as EdgeSamples numbers them
};

template <int D>
class EdgeNewton {
  using Point = std::array<double, D>;

 public:
  explicit EdgeNewton(const EdgeSamples<D>& samples)
      : samples_(samples), factor_(samples.count()), dx_(samples.count()) {}

  /// Computes the step from `at` for barrier parameter `mu`; returns whether there is one. `curvature` is 1 with the
  /// second derivatives of products of samples and h, 0 without.
  bool step(const EdgeIterate<D>& at, double mu, double curvature, double damping);
  const std::vector<Point>& of_samples() const { return dx_; }
  double of_logarithm() const { return dtau_; }  ///< the step of ln h

 private:
  using Work = Eigen::Matrix<double, 10 * D + 4, 5 * D + 2>;
  using Factor = Eigen::Matrix<double, D, 5 * D + 2>;

  void put(std::size_t r, std::size_t k, double power, const Point& weight, double step, double border);
  void tube_rows(const EdgeIterate<D>& at, std::size_t k, double mu);
  void difference_rows(const EdgeIterate<D>& at, std::size_t r, std::size_t k, double mu, double curvature);
  void reduce(std::size_t k);
  bool take(std::size_t k);
  void substitute_back();

  const EdgeSamples<D>& samples_;
  Work work_;
  std::size_t height_ = 0;  // rows of `work_` in use
  double tg_ = 0, extra_ = 0, residual_ = 0;
  std::vector<Factor, Eigen::aligned_allocator<Factor>> factor_;
  std::vector<Point> dx_;
  double dtau_ = 0;
};

}  // namespace bahnwerk
