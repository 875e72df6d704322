#include "core/cam/spline/spline_matrix.hpp"

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

SplineMatrix::SplineMatrix(std::size_t n, std::vector<Entry> entries) : n_(n), entries_(std::move(entries)) {
  constexpr double vanishing = 1e-16;  // pivots that are replaced, so that inverse iteration finds the null vectors
  std::size_t lower = 0, upper = 0;
  for (const Entry& e : entries_) {
    if (e.row > e.column) lower = std::max(lower, e.row - e.column);
    if (e.column > e.row) upper = std::max(upper, e.column - e.row);
  }
  factors_.reset(n, lower, upper);
  for (const Entry& e : entries_) factors_.at(e.row, e.column) += e.value;
  factors_.factor(vanishing);
}

SplineMatrix::NullVectors SplineMatrix::null_vectors(int iterations) const {
  NullVectors out;
  out.right = start_vector(n_);
  double before = 0;
  for (int i = 0; i < iterations; ++i) {
    out.left = out.right;
    factors_.solve_transposed(out.left.data());
    normalise(out.left);
    out.right = out.left;
    factors_.solve(out.right.data());
    const double grown = normalise(out.right);
    out.smallest = grown > 0 ? 1 / grown : 0;
    if (std::abs(grown - before) < 1e-4 * grown) break;
    before = grown;
  }
  return out;
}

double SplineMatrix::largest_singular_value() const {
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

double SplineMatrix::condition() const {
  const double smallest = null_vectors().smallest;
  return smallest > 0 ? largest_singular_value() / smallest : std::numeric_limits<double>::infinity();
}

}  // namespace bahnwerk::cam
