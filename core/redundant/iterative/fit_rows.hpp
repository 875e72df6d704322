#pragma once
/// The linear system of a coarse fit: one row of the spline's free control points per sample of a CoarseTask.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/numeric/large_pages.hpp"
#include "core/numeric/linear/symmetric_band.hpp"
#include "core/redundant/iterative/coarse_fit.hpp"
#include "core/redundant/iterative/spline_ends.hpp"

namespace bahnwerk {

/// A spline space with its end conditions, and one row per sample from the second one on (the first position is given).
struct FitRows {
  SplineSpace space;
  SplineEnds ends;
  LargeVector<VariableRow> rows;  ///< row i belongs to sample i + 1

  FitRows(const CoarseTask& task, std::size_t degree, std::vector<double> knots)
      : space(degree, std::move(knots)), ends(space, task.begin) {
    rows.resize(task.positions.size() - 1);
    std::size_t span = 0;
    for (std::size_t i = 1; i < task.positions.size(); ++i) {
      VariableRow& row = rows[i - 1];
      span = space.span(task.time(i), span);
      row.first = span - degree, row.count = degree + 1;
      if (ends.fixes_none_of(row.first, row.count)) {
        space.values(span, task.time(i), row.weights.data());
        row.first -= ends.control(0);
      } else {
        row = ends.reduced(space.at(task.time(i), 0, span));
      }
    }
  }

  /// Returns the spline with the variables y less the position of sample i + 1, mm.
  double error(const CoarseTask& task, const std::vector<double>& y, std::size_t i) const {
    const VariableRow& row = rows[i];
    double sum = row.offset;
    for (std::size_t r = 0; r < row.count; ++r) sum += row.weights[r] * y[row.first + r];
    return sum - task.positions[i + 1];
  }
  /// Returns the largest magnitude of error() over all rows, mm.
  double largest_error(const CoarseTask& task, const std::vector<double>& y) const {
    double most = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) most = std::max(most, std::abs(error(task, y, i)));
    return most;
  }
  /// Returns the normal matrix Σ a aᵀ; `right` receives Σ a x.
  SymmetricBand<> normal(const CoarseTask& task, std::vector<double>& right) const {
    SymmetricBand<> matrix(ends.variables(), space.degree());
    right.assign(ends.variables(), 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      matrix.add(rows[i].first, rows[i].count, rows[i].weights.data(), 1);
      for (std::size_t r = 0; r < rows[i].count; ++r)
        right[rows[i].first + r] += rows[i].weights[r] * (task.positions[i + 1] - rows[i].offset);
    }
    return matrix;
  }
};

}  // namespace bahnwerk
