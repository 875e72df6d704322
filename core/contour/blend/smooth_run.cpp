#include "core/contour/blend/smooth_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contour/blend/layout.hpp"
#include "core/contour/blend/reversed_run.hpp"
#include "core/contour/blend/smooth.hpp"
#include "core/contour/blend/smooth_basis.hpp"
#include "core/contour/blend/smooth_scale.hpp"
#include "core/contour/blend/smooth_spans.hpp"
#include "core/geometry/curve/nurbs.hpp"
#include "core/geometry/path/second_derivative_bound.hpp"
#include "core/numeric/windows.hpp"

namespace bahnwerk::blending {

namespace {

constexpr int max_rounds = 8;
constexpr double site_share = 0.99;  // part of the tolerance used at the sites; the rest is for the places between them
constexpr double site_step = 0.25;   // largest distance of sites, as a part of H
constexpr double slowest = 0.05;     // smallest |f'|: below it the curve all but turns round in a point

/// Samples all joints of the run, and places between them so that none is further from the next than H/4.
std::vector<TubeSite> sites_of(const ElementRun& stretch, const RunRange& range, const TubeScale& scale, double radius,
                               const std::vector<double>& extra) {
  std::vector<double> places;
  const double tiny = 1e-9 * (range.b - range.a);
  double last = range.a;
  std::size_t node = 0;
  const auto fill_to = [&](double t) {
    // H changes slowly: the smaller one of both sides of a step is never far off.
    while (true) {
      double step = site_step * scale.at(last, node);
      step = std::min(step, site_step * scale.at(std::min(t, last + step), node));
      if (!(last + 1.5 * step < t)) break;
      last += step;
      places.push_back(last);
    }
    if (t - last > 0.75 * site_step * scale.at(t, node)) places.push_back(0.5 * (last + t));
    last = t;
  };
  std::size_t at = stretch.find(range.a, 0);
  for (std::size_t i = at + 1; i < stretch.elements.size(); ++i) {
    const double t = stretch.elements[i].begin;
    if (t >= range.b - tiny) break;
    if (t <= range.a + tiny) continue;
    fill_to(t);
    places.push_back(t);
  }
  fill_to(range.b);
  places.insert(places.end(), extra.begin(), extra.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<TubeSite> sites;
  sites.reserve(places.size());
  for (const double t : places) sites.push_back({t, point_of(stretch, t, at), radius});
  return sites;
}

/// Ends a piece at each border, exactly there: blocks shorter than the spline's spans have pieces of their own.
void cut_at(const std::vector<double>& borders, SmoothedRun& run) {
  if (borders.empty()) return;
  std::vector<std::optional<Rational>> pieces;
  std::vector<double> breaks{run.breaks.front()};
  const auto part = [](const std::optional<Rational>& piece, double u0, double u1) {
    return piece ? std::optional(piece->restricted(u0, u1, 0.5 * (u0 + u1))) : std::nullopt;
  };
  auto border = borders.begin();
  for (std::size_t k = 0; k < run.pieces.size(); ++k) {
    const double begin = run.breaks[k], end = run.breaks[k + 1];
    double u = 0;
    while (border != borders.end() && *border <= begin) ++border;
    for (; border != borders.end() && *border < end; ++border) {
      const double next = (*border - begin) / (end - begin);
      if (!(next > u && next < 1)) continue;
      pieces.push_back(part(run.pieces[k], u, next));
      breaks.push_back(*border);
      u = next;
    }
    pieces.push_back(u > 0 ? part(run.pieces[k], u, 1) : std::move(run.pieces[k]));
    breaks.push_back(end);
  }
  run.pieces = std::move(pieces);
  run.breaks = std::move(breaks);
}

TubeEnd end_of(const ElementRun& stretch, double t, bool clamped) {
  const Element& e = stretch.elements[stretch.find(t, 0)];
  const double along = std::clamp(t - e.begin, 0.0, e.length);
  return {clamped, e.at(along)};
}

/// Bounds of |f''| per span: the control points of f'' that count there.
std::vector<double> second_derivative_bounds_of(const TubeSpline& spline) {
  const auto derivative = [&](const std::vector<Vec>& points, std::size_t degree, std::size_t skipped) {
    std::vector<Vec> list;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double width = spline.knots[i + skipped + degree + 1] - spline.knots[i + skipped + 1];
      list.push_back((static_cast<double>(degree) / width) * (points[i + 1] - points[i]));
    }
    return list;
  };
  const auto second = derivative(derivative(spline.points, spline_degree, 0), spline_degree - 1, 1);
  std::vector<double> bounds;
  for (std::size_t k = 0; k + spline_degree - 1 <= second.size(); ++k) {
    double most = 0;
    for (std::size_t i = k; i < k + spline_degree - 1; ++i)
      if (const double size = norm(second[i]); !(size <= most)) most = size;
    bounds.push_back(most);
  }
  return bounds;
}

/// Returns the bulge of an element from its chord between two places on it.
double bulge_of(const Element& e, double from, double to) {
  if (e.straight) return 0;
  const double u0 = e.parameter(from), u1 = e.parameter(to);
  return u1 > u0 ? SecondDerivativeBound(e.segment->curve()).at(u0, u1) * (u1 - u0) * (u1 - u0) / 8 : 0.0;
}

struct Finding {
  bool turning = false;        ///< the curve all but turns round in a point, at `places`
  std::vector<double> places;  ///< places at which the curve turns round, or else is outside between sites
};

/// Looks at the distance, everywhere, and at the speed.
class Inspection {
 public:
  Inspection(const ElementRun& stretch, const TubeProblem& problem, const TubeSpline& spline,
             const RunTolerance& tolerance)
      : stretch_(stretch),
        problem_(problem),
        spline_(spline),
        tolerance_(tolerance),
        second_derivatives_(second_derivative_bounds_of(spline)) {}

  Finding run(ProgressScope& progress) {
    Finding found;
    std::vector<double> slow;
    Place last = place(problem_.breaks.front());
    for (std::size_t i = 0; i <= problem_.sites.size(); ++i) {
      progress.work();
      const double begin = last.t, end = i < problem_.sites.size() ? problem_.sites[i].t : problem_.breaks.back();
      worst_ = tolerance_.aimed, outside_ = -1;
      double least = slowest, halt = -1;
      for (int k = 1; k <= 4; ++k) {
        const Place next = place(k < 4 ? begin + (end - begin) * k / 4 : end);
        if (k < 4 && !(next.off <= worst_)) worst_ = next.off, outside_ = next.t;
        if (!(next.speed >= least)) least = next.speed, halt = next.t;
        if (outside_ < 0) prove(last, next, max_halvings);
        last = next;
      }
      if (outside_ >= 0) found.places.push_back(outside_);
      if (halt >= 0 && (slow.empty() || halt - slow.back() > problem_.scale[span_])) slow.push_back(halt);
    }
    found.turning = !slow.empty();
    if (found.turning) found.places = std::move(slow);
    return found;
  }

 private:
  static constexpr int max_halvings = 12;
  struct Place {
    double t = 0, off = 0, speed = 0;
    std::size_t span = 0;
  };

  Place place(double t) {
    span_ = std::min(span_, second_derivatives_.size() - 1);
    while (span_ > 0 && t < problem_.breaks[span_]) --span_;
    while (span_ + 2 < problem_.breaks.size() && t >= problem_.breaks[span_ + 1]) ++span_;
    const SpanPolynomials::Place f = spline_.at(span_, t);
    return {t, norm(f.value - point_of(stretch_, t, at_)), norm(f.slope), span_};
  }

  /// Between two places the distance is at most the larger one at them plus what both curves bulge.
  void prove(const Place& a, const Place& b, int depth) {
    const double width = b.t - a.t;
    double second_derivative = 0;
    for (std::size_t k = a.span; k <= b.span; ++k)
      second_derivative = std::max(second_derivative, second_derivatives_[k]);
    element_ = stretch_.find(0.5 * (a.t + b.t), element_);
    const Element& e = stretch_.elements[element_];
    const double bulge =
        second_derivative * width * width / 8 + bulge_of(e, std::max(0.0, a.t - e.begin), b.t - e.begin);
    if (std::max(a.off, b.off) + bulge <= tolerance_.proven) return;
    const Place middle = place(0.5 * (a.t + b.t));
    if (!(middle.off <= worst_) || depth == 0) {
      worst_ = middle.off;
      outside_ = middle.t;
      return;
    }
    prove(a, middle, depth - 1);
    if (outside_ < 0) prove(middle, b, depth - 1);
  }

  const ElementRun& stretch_;
  const TubeProblem& problem_;
  const SpanPolynomials spline_;
  const RunTolerance& tolerance_;
  std::vector<double> second_derivatives_;
  std::size_t span_ = 0, element_ = 0, at_ = 0;  // indices of the last evaluated places
  double worst_ = 0, outside_ = -1;
};

/// A spline between two places of an element run.
struct SmoothWindow {
  bool done = false;
  std::vector<double> breaks;
  TubeSpline spline;
  std::vector<double> failure_positions;  ///< places of failure, if not done
};

/// Window by window along a run, each on from where the one before it was cut.
class WindowedRun {
 public:
  WindowedRun(const ElementRun& stretch, const RunRange& range, const SmoothRunOptions& options,
              ProgressScope& progress)
      : stretch_(stretch),
        range_(range),
        options_(options),
        progress_(progress),
        scale_(stretch, range.a, range.b, options.tolerance.aimed, progress),
        rests_(options.rests || end_of_window(range.a, usual, range.b) < range.b) {}

  SmoothedRun run() {
    run_.breaks = {range_.a};
    const Place reached = solve_windows(from_rest(range_.a, range_.clamped_begin), range_.b,
                                        [&](Place& here, Place* before) { return solve(here, before); });
    run_.done = reached.begin >= range_.b;
    return std::move(run_);
  }

 private:
  static constexpr double usual = 1024, largest = 4096, overlap = 96;  // spline intervals; an end shows over some 60

  struct Place {
    double begin, stop;  // place of the element run, and the next rest behind it
    TubeEnd state;
    double size = usual;     // spline intervals of the window
    bool free = true;        // whether it lies on the contour, not on a curve before it
    std::size_t pieces = 0;  // number of pieces before it
  };

  double end_of_window(double at, double size, double stop) const {
    const double end = scale_.ahead(at, size + overlap);
    return scale_.ahead(end, overlap) < stop ? end : stop;
  }

  /// Returns a place of the contour, from which the curve goes on to the end of the run.
  Place from_rest(double at, bool clamped) const {
    return {at, range_.b, end_of(stretch_, at, clamped), usual, true, run_.pieces.size()};
  }

  /// Returns a spline in a range of the run with the given ends; `scale` is its scale, which is refined where no curve
  /// is found.
  SmoothWindow smooth(const RunRange& range, TubeScale scale, const TubeEnd& begin, const TubeEnd& end) const;

  /// The cut from which a window cannot continue may be the cause: it and the window before are merged. Otherwise the
  /// window ends at a rest.
  WindowResult<Place> solve(Place& here, Place* before) {
    run_.pieces.resize(here.pieces);
    run_.breaks.resize(here.pieces + 1);
    const double end = end_of_window(here.begin, here.size, here.stop);
    const bool all = here.begin == range_.a && end == range_.b;
    SmoothWindow window = smooth({here.begin, end}, all ? scale_ : scale_.part(here.begin, end), here.state,
                                 end_of(stretch_, end, end == range_.b && range_.clamped_end));
    if (window.done) return take(window, here, end == here.stop);
    if (!here.free && here.size == usual && before->size < largest) {
      before->size *= 2;
      return WindowRetry::before;
    }
    if (rests_ && rest_near(window.failure_positions, here, end)) return WindowRetry::same;
    if (!rests_ || !here.free) {
      run_.pieces.clear();
      run_.failure_positions = window.failure_positions;
      return WindowRetry::none;
    }
    run_.pieces.emplace_back();  // the contour itself
    run_.breaks.push_back(end);
    return from_rest(end, false);
  }

  /// Takes the part of a window that its far end does not influence, all of the last one before a rest.
  WindowResult<Place> take(SmoothWindow& window, const Place& here, bool last) {
    const std::size_t all = window.breaks.size() - 1, kept = last ? all : all - static_cast<std::size_t>(overlap);
    std::vector<Rational> pieces = Nurbs(spline_degree, window.spline.points, {}, window.spline.knots).pieces();
    if (pieces.size() != all) return WindowRetry::none;
    for (std::size_t k = 0; k < kept; ++k) {
      run_.pieces.emplace_back(std::move(pieces[k]));
      run_.breaks.push_back(window.breaks[k + 1]);
    }
    if (last) return from_rest(here.stop, false);
    const double cut = window.breaks[kept];
    return Place{cut, here.stop, {true, window.spline.at(kept, cut)}, usual, false, run_.pieces.size()};
  }

  /// Ends the window at a joint near the first failure. Returns false if there is none.
  bool rest_near(const std::vector<double>& failure_positions, Place& here, double end) const {
    const double failure = failure_positions.empty() ? 0.5 * (here.begin + end) : failure_positions.front();
    const auto& elements = stretch_.elements;
    const auto inside = [&](std::size_t j) {
      return j < elements.size() && elements[j].begin > here.begin && elements[j].begin < end;
    };
    const std::vector<std::size_t> sharp = sharpest_joints(stretch_, here.begin, end, {failure}, 0);
    std::size_t joint = sharp.empty() ? stretch_.find(failure, 0) : sharp.front();
    if (!inside(joint)) ++joint;
    if (!inside(joint)) return false;
    here.stop = elements[joint].begin;
    return true;
  }

  const ElementRun& stretch_;
  const RunRange& range_;
  const SmoothRunOptions& options_;
  ProgressScope& progress_;
  TubeScale scale_;
  bool rests_;
  SmoothedRun run_;
};

SmoothWindow WindowedRun::smooth(const RunRange& range, TubeScale scale, const TubeEnd& begin,
                                 const TubeEnd& end) const {
  SmoothWindow window;
  std::vector<double> extra;
  TubeProblem problem;
  problem.dimension = options_.dimension;
  problem.begin = begin;
  problem.end = end;
  for (int round = 0; round < max_rounds; ++round) {
    progress_.report();
    problem.breaks = scale.breaks();
    problem.scale.clear();
    for (std::size_t k = 0; k + 1 < problem.breaks.size(); ++k)
      problem.scale.push_back(2 * (problem.breaks[k + 1] - problem.breaks[k]));
    problem.sites = sites_of(stretch_, range, scale, site_share * options_.tolerance.aimed, extra);
    window.spline = smooth_in_tube(problem, progress_);
    if (!window.spline.inside) {
      window.failure_positions.clear();
      for (const TubeSite& site : problem.sites) {
        const auto k = static_cast<std::size_t>(std::upper_bound(problem.breaks.begin(), problem.breaks.end(), site.t) -
                                                problem.breaks.begin());
        if (!(norm(window.spline.at(k - 1, site.t).value - site.p) < site.radius))
          window.failure_positions.push_back(site.t);
      }
      if (!scale.refine(window.failure_positions)) return window;
      continue;
    }
    const Finding finding = Inspection(stretch_, problem, window.spline, options_.tolerance).run(progress_);
    window.done = finding.places.empty();
    if (window.done) window.breaks = std::move(problem.breaks);
    if (!window.done) window.failure_positions = finding.places;
    if (window.done || finding.turning) return window;
    extra.insert(extra.end(), finding.places.begin(), finding.places.end());
  }
  return window;
}

}  // namespace

SmoothedRun smooth_run(const ElementRun& stretch, const RunRange& range, const std::vector<double>& borders,
                       const SmoothRunOptions& options, ProgressScope& progress) {
  SmoothedRun run;
  if (begins_at_end(range.a, range.b, [&](double t) { return point_of(stretch, t); })) {
    const ReversedRun back(stretch, range);
    run = back.turned_back(WindowedRun(back.stretch(), back.range(), options, progress).run());
  } else {
    run = WindowedRun(stretch, range, options, progress).run();
  }
  if (run.done) cut_at(borders, run);
  return run;
}

}  // namespace bahnwerk::blending
