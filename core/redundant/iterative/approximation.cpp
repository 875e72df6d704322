#include "core/redundant/iterative/approximation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/redundant/iterative/band_program.hpp"

namespace bahnwerk {
namespace {

constexpr int max_passes = 400;
// Bound of the ratio of the least-squares error to the least largest error: the norm of the projection, bounded
// independently of the knots [de Boor, Shadrin]. If the ratio of error and tolerance is larger, the best spline with
// these knots is out of tolerance, too.
constexpr double projection_norm = 10;
constexpr int refinements = 6;  // most refinements of Schoenberg's T_max for the end conditions

double position_at(const CoarseTask& task, double t) {
  const auto last = static_cast<double>(task.positions.size() - 1);
  const double at = std::clamp(t / task.duration, 0.0, 1.0) * last;
  const auto i = std::min(static_cast<std::size_t>(at), task.positions.size() - 2);
  const double share = at - static_cast<double>(i);
  return (1 - share) * task.positions[i] + share * task.positions[i + 1];
}

std::optional<std::vector<double>> least_squares(const CoarseTask& task, const FitRows& rows) {
  std::vector<double> y;
  SymmetricBand<> normal = rows.normal(task, y);
  if (!normal.factor()) return std::nullopt;
  normal.solve(y);
  return y;
}

std::vector<double> schoenberg(const CoarseTask& task, const FitRows& rows) {
  std::vector<double> y(rows.ends.variables());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = position_at(task, rows.space.greville(rows.ends.control(i)));
  return y;
}

std::optional<std::vector<double>> chebyshev(const CoarseTask& task, const FitRows& rows, double gap,
                                             const std::function<void()>& tick) {
  std::optional<std::vector<double>> y = least_squares(task, rows);
  if (!y || rows.largest_error(task, *y) > projection_norm * task.tolerance) return y;
  const double scale = task.tolerance, middle = task.positions.front();
  BandProgram program{SymmetricBand<>(rows.ends.variables(), rows.space.degree()), {}, {}, 1};
  program.rows.reserve(rows.rows.size());
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    // Rows of B-splines sum up to 1 less the share of fixed control points, so positions are counted from the first
    // one, in tolerances.
    const VariableRow& row = rows.rows[i];
    double fixed = 1;
    for (std::size_t r = 0; r < row.count; ++r) fixed -= row.weights[r];
    const double x = (task.positions[i + 1] - row.offset - (1 - fixed) * middle) / scale;
    program.rows.push_back({row, x, x, 1});
  }
  for (double& v : *y) v = (v - middle) / scale;
  BandProgramOptions options;
  options.gap = gap;
  options.tick = tick;
  y = solve(program, *y, options).y;
  for (double& v : *y) v = middle + scale * v;
  return y;
}

/// Returns the times of the largest error of each interval of samples out of tolerance, the largest first.
std::vector<double> worst_times(const CoarseTask& task, const FitRows& rows, const std::vector<double>& y) {
  std::vector<std::pair<double, double>> worst;  // error, time
  bool out = false;
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const double error = std::abs(rows.error(task, y, i));
    if (!(error > task.tolerance)) {
      out = false;
      continue;
    }
    if (!out) worst.emplace_back(0, 0);
    out = true;
    worst.back() = std::max(worst.back(), std::pair{error, task.time(i + 1)});
  }
  std::sort(worst.rbegin(), worst.rend());
  std::vector<double> times;
  for (const auto& w : worst) times.push_back(w.second);
  return times;
}

double worst_time(const CoarseTask& task, const FitRows& rows, const std::vector<double>& y) {
  std::size_t worst = 0;
  double most = -1;
  for (std::size_t i = 0; i < rows.rows.size(); ++i)
    if (const double error = std::abs(rows.error(task, y, i)); error > most) most = error, worst = i;
  return task.time(worst + 1);
}

class Fitter {
 public:
  Fitter(const CoarseTask& task, const CoarseFitOptions& options) : task_(task), options_(options) {}

  std::optional<Approximation> run() {
    const std::size_t most = KnotChoice::interpolating(task_.positions.size(), options_.degree, options_.multiplicity);
    if (options_.approximation == CoarseApproximation::chebyshev) return evenly(most);
    if (options_.approximation == CoarseApproximation::least_squares) return inserted(most);
    // (4.19) without the error of half a sample that the nearest sample may have.
    const double rate = task_.speed > 0 ? task_.speed : 1;
    const double spacing = task_.tolerance / rate * std::sqrt(12.0 / static_cast<double>(options_.degree + 1));
    double places = std::ceil(task_.duration / spacing);
    for (int i = 0; i < refinements; ++i, places *= 2)
      if (auto found = inserted(static_cast<std::size_t>(places))) return found;
    return std::nullopt;
  }

 private:
  void tick() const {
    if (options_.tick) options_.tick();
  }

  /// Inserts knots until there are enough control points for the end conditions.
  void begin(KnotChoice& choice) const {
    const std::size_t least = SplineEnds::least(task_.begin), have = options_.degree + 1;
    if (least > have) choice.choose_evenly((least - have + options_.multiplicity - 1) / options_.multiplicity);
  }

  std::optional<Approximation> fit(const KnotChoice& choice, double gap = 1e-4) const {
    tick();
    const std::vector<double> knots = choice.knots();
    if (knots.size() < options_.degree + 1 + SplineEnds::least(task_.begin)) return std::nullopt;
    Approximation a{FitRows(task_, options_.degree, knots), {}, choice.chosen()};
    std::optional<std::vector<double>> y;
    switch (options_.approximation) {
      case CoarseApproximation::least_squares:
        y = least_squares(task_, a.rows);
        break;
      case CoarseApproximation::chebyshev:
        y = chebyshev(task_, a.rows, gap, options_.tick);
        break;
      case CoarseApproximation::schoenberg:
        y = schoenberg(task_, a.rows);
        break;
    }
    if (!y) return std::nullopt;
    a.variables = std::move(*y);
    return a;
  }

  bool within(const Approximation& a) const { return a.rows.largest_error(task_, a.variables) <= task_.tolerance; }

  /// Inserts knots where the error is too large, then those of the afterburner.
  std::optional<Approximation> inserted(std::size_t places) const {
    const bool least_squares = options_.approximation == CoarseApproximation::least_squares;
    KnotChoice choice(task_.duration, places, options_.degree, options_.multiplicity, options_.wide,
                      least_squares ? options_.grading : 0);
    begin(choice);
    if (least_squares) choice.choose_nearest(task_.knots);
    std::optional<Approximation> best;
    std::size_t hits = 0;
    for (int pass = 0; pass < max_passes; ++pass) {
      std::optional<Approximation> a = fit(choice);
      if (!a) break;
      const std::vector<double> times = worst_times(task_, a->rows, a->variables);
      const bool done = times.empty();
      if (done) best = std::move(a);
      if (done && ++hits >= std::max<std::size_t>(burns(), 1)) break;
      const bool more = !done                         ? choice.insert_apart(times, options_.degree + 1) > 0
                        : options_.afterburner_evenly ? choice.insert_in_widest()
                                                      : choice.insert(worst_time(task_, best->rows, best->variables));
      if (!more) break;
    }
    return best;
  }

  /// Without a second phase more knots only make the spline rougher.
  std::size_t burns() const { return options_.smoothing == CoarseSmoothing::none ? 0 : options_.afterburner; }

  std::optional<Approximation> evenly(std::size_t places) const {
    KnotChoice choice(task_.duration, places, options_.degree, options_.multiplicity, options_.wide);
    const auto at = [&](std::size_t count) {
      choice.choose_evenly(count);
      std::optional<Approximation> a = fit(choice);
      if (a && !within(*a)) a.reset();
      return a;
    };
    begin(choice);
    std::size_t low = choice.chosen(), high = std::max<std::size_t>(2 * low, 4);
    std::optional<Approximation> best = at(low);
    if (best) high = low;
    while (!best && high < 2 * places) {
      best = at(std::min(high, places));
      if (!best) low = high, high *= 2;
    }
    if (!best) return best;
    high = std::min(high, places);
    while (high - low > std::max<std::size_t>(1, high / 16)) {
      const std::size_t middle = (low + high) / 2;
      if (auto a = at(middle)) {
        best = std::move(a);
        high = middle;
      } else {
        low = middle;
      }
    }
    if (burns() == 0) return best;
    if (auto finer = at(std::min(high + burns(), places))) return finer;
    return best;
  }

  const CoarseTask& task_;
  const CoarseFitOptions& options_;
};

}  // namespace

std::optional<Approximation> approximate(const CoarseTask& task, const CoarseFitOptions& options) {
  return Fitter(task, options).run();
}

}  // namespace bahnwerk
