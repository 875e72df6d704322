#include "core/cam/spline/band_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace bahnwerk::cam {
namespace {

double normalise(std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  const double length = std::sqrt(sum);
  if (length > 0)
    for (double& x : v) x /= length;
  return length;
}

/// Returns a vector that is not orthogonal to anything that has a pattern.
std::vector<double> start_vector(std::size_t n) {
  std::vector<double> v(n);
  double x = 0.5;
  for (double& entry : v) x = std::fmod(x + std::numbers::phi - 1, 1.0), entry = 0.25 + x;
  normalise(v);
  return v;
}

}  // namespace

// Row i holds columns i − lower … i + upper + lower: exchanged rows fill `lower` more places.
BandLu::BandLu(std::size_t n, std::vector<Entry> given) : n_(n), entries_(std::move(given)) {
  const std::vector<Entry>& entries = entries_;
  std::size_t upper = 0;
  double largest = 0;
  for (const Entry& e : entries) {
    if (e.row > e.column) lower_ = std::max(lower_, e.row - e.column);
    if (e.column > e.row) upper = std::max(upper, e.column - e.row);
    largest = std::max(largest, std::abs(e.value));
  }
  width_ = 2 * lower_ + upper + 1;
  lu_.assign(n * width_, 0);
  multipliers_.assign(n * std::max<std::size_t>(lower_, 1), 0);
  exchanged_.resize(n);
  for (const Entry& e : entries) row(e.row)[e.column + lower_ - e.row] += e.value;
  const auto at = [&](std::size_t i, std::size_t j) -> double& { return row(i)[j + lower_ - i]; };
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t last = std::min(n - 1, k + lower_);
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i <= last; ++i)
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    exchanged_[k] = pivot;
    const std::size_t end = std::min(n - 1, k + lower_ + upper);
    if (pivot != k)
      for (std::size_t j = k; j <= end; ++j) std::swap(at(k, j), at(pivot, j));
    smallest = std::min(smallest, std::abs(at(k, k)));
    // A vanishing pivot becomes one of the size of rounding, so that inverse iteration finds the null vectors.
    const double least = 1e-16 * largest;
    if (std::abs(at(k, k)) < least) at(k, k) = least;
    for (std::size_t i = k + 1; i <= last; ++i) {
      const double factor = at(i, k) / at(k, k);
      multipliers_[k * lower_ + (i - k - 1)] = factor;
      at(i, k) = 0;
      if (factor == 0) continue;
      const double* source = &at(k, k + 1 <= end ? k + 1 : k);
      double* target = &at(i, k + 1 <= end ? k + 1 : k);
      for (std::size_t j = k + 1; j <= end; ++j) *target++ -= factor * *source++;
    }
  }
  pivot_ratio_ = largest > 0 ? smallest / largest : 0;
}

void BandLu::solve(double* b) const {
  for (std::size_t k = 0; k < n_; ++k) {
    std::swap(b[k], b[exchanged_[k]]);
    const std::size_t last = std::min(n_ - 1, k + lower_);
    for (std::size_t i = k + 1; i <= last; ++i) b[i] -= multipliers_[k * lower_ + (i - k - 1)] * b[k];
  }
  for (std::size_t k = n_; k-- > 0;) {
    const double* u = row(k) + lower_;
    const std::size_t count = std::min(n_ - k, width_ - lower_);
    double sum = b[k];
    for (std::size_t j = 1; j < count; ++j) sum -= u[j] * b[k + j];
    b[k] = sum / u[0];
  }
}

void BandLu::solve_transposed(double* b) const {
  for (std::size_t k = 0; k < n_; ++k) {
    const double* u = row(k) + lower_;
    const std::size_t count = std::min(n_ - k, width_ - lower_);
    b[k] /= u[0];
    for (std::size_t j = 1; j < count; ++j) b[k + j] -= u[j] * b[k];
  }
  for (std::size_t k = n_; k-- > 0;) {
    const std::size_t last = std::min(n_ - 1, k + lower_);
    for (std::size_t i = k + 1; i <= last; ++i) b[k] -= multipliers_[k * lower_ + (i - k - 1)] * b[i];
    std::swap(b[k], b[exchanged_[k]]);
  }
}

BandLu::NullVectors BandLu::null_vectors(int iterations) const {
  NullVectors out;
  out.right = start_vector(n_);
  double before = 0;
  for (int i = 0; i < iterations; ++i) {
    out.left = out.right;
    solve_transposed(out.left.data());
    normalise(out.left);
    out.right = out.left;
    solve(out.right.data());
    const double grown = normalise(out.right);
    out.smallest = grown > 0 ? 1 / grown : 0;
    if (std::abs(grown - before) < 1e-4 * grown) break;
    before = grown;
  }
  return out;
}

double BandLu::largest_singular_value() const {
  std::vector<double> v = start_vector(n_), w(n_);
  double value = 0, before = 0;
  for (int i = 0; i < 60; ++i) {
    std::fill(w.begin(), w.end(), 0.0);
    for (const Entry& e : entries_) w[e.row] += e.value * v[e.column];
    std::fill(v.begin(), v.end(), 0.0);
    for (const Entry& e : entries_) v[e.column] += e.value * w[e.row];
    value = std::sqrt(normalise(v));
    if (std::abs(value - before) < 1e-4 * value) break;
    before = value;
  }
  return value;
}

double BandLu::condition() const {
  const double smallest = null_vectors().smallest;
  return smallest > 0 ? largest_singular_value() / smallest : std::numeric_limits<double>::infinity();
}

}  // namespace bahnwerk::cam
