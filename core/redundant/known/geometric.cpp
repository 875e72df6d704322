#include "core/redundant/known/geometric.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/progress_scope.hpp"
#include "core/redundant/known/split_plan.hpp"

namespace bahnwerk {
namespace {

constexpr double used_stroke = 0.99;
constexpr int looks_per_pitch = 16;
constexpr std::size_t degree = 5;
constexpr double cells_per_pitch = 64;  // of the planner: the curve's knots lie inside them

/// The degree + 1 uniform B-splines that are not zero on a span, at t ∈ [0, 1] of it (Cox, de Boor).
std::array<double, degree + 1> basis(std::size_t of, double t) {
  std::array<double, degree + 1> b{1};
  for (std::size_t d = 1; d <= of; ++d)
    for (std::size_t j = d + 1; j-- > 0;) {
      const double n = static_cast<double>(d), i = static_cast<double>(j);
      b[j] = (j > 0 ? (t + n - i) / n * b[j - 1] : 0) + (j < d ? (1 - t + i) / n * b[j] : 0);
    }
  return b;
}

/// The tool's place at path length s, kept to the path.
AxisArray place(const AxisPath& path, double s, std::size_t& hint) {
  s = std::clamp(s, 0.0, path.length());
  hint = path.tool().find(s, hint);
  return path.at(hint, std::clamp(s, path[hint].s0(), path[hint].s1())).value;
}

bool within_strokes(const AxisPath& path, const CoarseCurve& curve, const CoarseFineMachine& machine,
                    ProgressScope& scope) {
  const auto looks = static_cast<std::size_t>(std::ceil(path.length() / curve.pitch() * looks_per_pitch)) + 1;
  const double step = path.length() / static_cast<double>(looks);
  std::size_t hint = 0;
  for (std::size_t i = 0; i <= looks; ++i) {
    scope.work(2);
    const double s = step * static_cast<double>(i);
    const AxisArray tool = place(path, s, hint), coarse = curve.at(hint, s, {}).value;
    for (std::size_t k = 0; k < path.axes(); ++k) {
      // The tool goes no further than half a step from a look, the coarse axis neither.
      if (std::abs(tool[k] - coarse[k]) + step > used_stroke * machine.axes[k].stroke) return false;
    }
  }
  return true;
}

}  // namespace

CoarseCurve::CoarseCurve(const AxisPath& path, double pitch) : axes_(path.axes()), pitch_(pitch) {
  std::size_t hint = 0;
  const auto spans = static_cast<std::size_t>(std::ceil(path.length() / pitch)) + 1;
  for (std::size_t j = 0; j < spans + degree; ++j)
    control_.push_back(place(path, pitch * (static_cast<double>(j) - 0.5 * (degree - 1)), hint));
}

AxisJet CoarseCurve::at(std::size_t, double s, const AxisJet&) const {
  const double x = std::fmax(0, s / pitch_);
  const auto span = std::min(static_cast<std::size_t>(x), control_.size() - 1 - degree);
  const double t = x - static_cast<double>(span);
  std::array<AxisArray, degree + 1> c;
  std::copy_n(control_.begin() + static_cast<std::ptrdiff_t>(span), degree + 1, c.begin());
  AxisJet q;
  AxisArray* rows[] = {&q.value, &q.d1, &q.d2, &q.d3};
  for (std::size_t order = 0; order < 4; ++order) {  // a derivative is the spline of the differences
    const std::size_t of = degree - order;
    const std::array<double, degree + 1> b = basis(of, t);
    for (std::size_t i = 0; i <= of; ++i)
      for (std::size_t k = 0; k < axes_; ++k) {
        (*rows[order])[k] += b[i] * c[i][k];
        if (i < of) c[i][k] = (c[i + 1][k] - c[i][k]) / pitch_;
      }
  }
  return q;
}

std::shared_ptr<const CoarseCurve> coarse_curve(const AxisPath& path, const CoarseFineMachine& machine,
                                                Progress& progress) {
  ProgressScope scope(progress, "planning", 0, 0);
  double stroke = machine.axes.front().stroke;
  for (const CoarseFineAxis& axis : machine.axes) stroke = std::fmin(stroke, axis.stroke);
  // |x(s) − x_c(s)| ≤ Σ B_i |s − s_i| ≤ √(Σ B_i (s − s_i)²) = Δ √((degree + 1)/12) = Δ/√2.
  auto best = std::make_shared<const CoarseCurve>(path, used_stroke * std::sqrt(2.0) * stroke);
  while (best->pitch() < path.length()) {
    auto wider = std::make_shared<const CoarseCurve>(path, 2 * best->pitch());
    if (!within_strokes(path, *wider, machine, scope)) break;
    best = std::move(wider);
  }
  return best;
}

RedundancyResult plan_geometric(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                double from, double to) {
  const auto curve = coarse_curve(*task.path, task.machine, progress);
  return plan_split(task, curve, curve->pitch() / cells_per_pitch, options, progress, from, to);
}

}  // namespace bahnwerk
