#include "core/redundant/known/geometric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/redundant/known/split_plan.hpp"

namespace bahnwerk {
namespace {

constexpr double used_stroke = 0.99;
constexpr int looks_per_pitch = 16;
constexpr std::size_t degree = 5;
constexpr double cells_per_pitch = 64;  // cells of the planner per pitch; the curve's knots lie inside cells
constexpr double least_cells_per_pitch = 4, most_cells = 2e4;  // limits for the whole path
constexpr int patience = 1;  // closer curves that are not quicker after which the search ends

/// Returns the degree + 1 uniform B-splines that do not vanish on a span, at t ∈ [0, 1] of it (Cox, de Boor).
std::array<double, degree + 1> basis(std::size_t of, double t) {
  std::array<double, degree + 1> b{1};
  for (std::size_t d = 1; d <= of; ++d)
    for (std::size_t j = d + 1; j-- > 0;) {
      const double n = static_cast<double>(d), i = static_cast<double>(j);
      b[j] = (j > 0 ? (t + n - i) / n * b[j - 1] : 0) + (j < d ? (1 - t + i) / n * b[j] : 0);
    }
  return b;
}

/// Returns the tool's position at path length s, clamped to the path.
AxisArray place(const AxisPath& path, double s, std::size_t& hint) {
  s = std::clamp(s, 0.0, path.length());
  hint = path.tool().find(s, hint);
  return path.at(hint, std::clamp(s, path[hint].s0(), path[hint].s1())).value;
}

/// Returns the tool's position; beyond its ends the path is continued by point reflection at its end point.
AxisArray turned_place(const AxisPath& path, double s, std::size_t& hint) {
  const double end = s < 0 ? 0 : path.length();
  if (s >= 0 && s <= end) return place(path, s, hint);
  const AxisArray about = place(path, end, hint);
  AxisArray x = turned_place(path, 2 * end - s, hint);
  for (std::size_t k = 0; k < path.axes(); ++k) x[k] = 2 * about[k] - x[k];
  return x;
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
      // Between samples the tool, like the coarse axis, moves by at most half a step.
      if (std::abs(tool[k] - coarse[k]) + step > used_stroke * machine.axes[k].stroke) return false;
    }
  }
  return true;
}

}  // namespace

CoarseCurve::CoarseCurve(const AxisPath& path, double pitch, Ends ends) : axes_(path.axes()), pitch_(pitch) {
  const double length = path.length();
  const auto spans = static_cast<std::size_t>(std::fmax(1, std::ceil(length / pitch)));
  if (ends == Ends::centred) pitch_ = length / static_cast<double>(spans);
  begin_ = ends == Ends::centred ? 0 : 0.5 * (length - pitch * static_cast<double>(spans));
  std::size_t hint = 0;
  for (std::size_t j = 0; j < spans + degree; ++j) {
    const double s = begin_ + pitch_ * (static_cast<double>(j) - 0.5 * (degree - 1));
    control_.push_back(ends == Ends::centred ? turned_place(path, s, hint) : place(path, s, hint));
  }
}

AxisJet CoarseCurve::at(std::size_t, double s, const AxisJet&) const {
  const double x = std::fmax(0, (s - begin_) / pitch_);
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

namespace {

CoarseCurve::Ends ends_of(const CoarseFineMachine& machine) {
  const bool centred =
      std::any_of(machine.axes.begin(), machine.axes.end(), [](const CoarseFineAxis& a) { return a.centred; });
  return centred ? CoarseCurve::Ends::centred : CoarseCurve::Ends::free;
}

double pitch_of(const AxisPath& path, int step) { return path.length() * std::pow(2.0, -0.5 * step); }

/// Returns the first pitch whose curve keeps the fine axes within their strokes.
int widest_step(const AxisPath& path, const CoarseFineMachine& machine, Progress progress) {
  ProgressScope scope(progress.part(0, 0), "planning");
  double stroke = machine.axes.front().stroke;
  for (const CoarseFineAxis& axis : machine.axes) stroke = std::fmin(stroke, axis.stroke);
  // |x(s) − x_c(s)| ≤ Σ B_i |s − s_i| ≤ √(Σ B_i (s − s_i)²) = Δ √((degree + 1)/12) = Δ/√2.
  const double fits = used_stroke * std::sqrt(2.0) * stroke;
  int step = 0;
  for (; pitch_of(path, step) > fits; ++step)
    if (within_strokes(path, CoarseCurve(path, pitch_of(path, step), ends_of(machine)), machine, scope)) break;
  return step;
}

}  // namespace

std::shared_ptr<const CoarseCurve> coarse_curve(const AxisPath& path, const CoarseFineMachine& machine,
                                                Progress progress) {
  return std::make_shared<const CoarseCurve>(path, pitch_of(path, widest_step(path, machine, progress)),
                                             ends_of(machine));
}

Expected<RedundancyResult, NoPlan> plan_geometric(const RedundancyTask& task, const RedundancyOptions& options,
                                                  Progress progress) {
  const AxisPath& path = *task.path;
  std::optional<RedundancyResult> best;
  int worse = 0;
  for (int step = widest_step(path, task.machine, progress); worse < patience; ++step) {
    const double cells = std::fmin(cells_per_pitch, most_cells * pitch_of(path, step) / path.length());
    if (cells < least_cells_per_pitch) break;
    const auto curve = std::make_shared<const CoarseCurve>(path, pitch_of(path, step), ends_of(task.machine));
    Expected<RedundancyResult, NoPlan> found = plan_split(task, curve, curve->pitch() / cells, options, progress);
    worse = !found || (best && !(found->head->duration() < best->head->duration())) ? worse + 1 : 0;
    if (worse == 0) best = *std::move(found);
    progress = progress.part(1, 1);
  }
  if (best) return *std::move(best);
  return NoPlan::no_curve;
}

}  // namespace bahnwerk
