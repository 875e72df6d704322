#include "core/contour/blend/smooth_run.hpp"

#include <algorithm>
#include <cmath>

#include "core/contour/blend/smooth.hpp"
#include "core/contour/blend/smooth_basis.hpp"
#include "core/contour/blend/smooth_scale.hpp"
#include "core/curve/nurbs.hpp"

namespace bahnwerk::blending {

namespace {

constexpr int most_rounds = 8;
constexpr double site_share = 0.96;  // of the tolerance at the sites; the rest is for what lies between them
constexpr double site_step = 0.25;   // of H
constexpr double slowest = 0.05;     // smallest |f'|: below it the curve all but turns round in a point

/// All joints of the run, and places between them so that none is further from the next than H/4.
std::vector<TubeSite> sites_of(const Stretch& stretch, const RunRange& range, const BendScale& scale, double radius,
                               const std::vector<double>& extra) {
  std::vector<double> places;
  const double tiny = 1e-9 * (range.b - range.a);
  double last = range.a;
  const auto fill_to = [&](double t) {
    // H changes slowly: the smaller one of both sides of a step is never far off.
    while (true) {
      double step = site_step * scale.at(last);
      step = std::min(step, site_step * scale.at(std::min(t, last + step)));
      if (!(last + 1.5 * step < t)) break;
      last += step;
      places.push_back(last);
    }
    if (t - last > 0.75 * site_step * scale.at(t)) places.push_back(0.5 * (last + t));
    last = t;
  };
  for (std::size_t i = stretch.find(range.a, 0) + 1; i < stretch.elements.size(); ++i) {
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
  for (const double t : places) sites.push_back({t, point_of(stretch, t), radius});
  return sites;
}

/// Moves the nearest inner break onto each border.
void snap(std::vector<double>& breaks, const std::vector<double>& borders) {
  std::size_t taken = 0;
  for (const double t : borders) {
    auto i = static_cast<std::size_t>(std::upper_bound(breaks.begin(), breaks.end(), t) - breaks.begin());
    if (i == 0 || i >= breaks.size()) continue;
    if (i > 1 && t - breaks[i - 1] < breaks[i] - t) --i;
    if (i <= taken || i + 1 >= breaks.size()) continue;
    breaks[i] = t;
    taken = i;
  }
}

TubeEnd end_of(const Stretch& stretch, double t, bool clamped) {
  const Element& e = stretch.elements[stretch.find(t, 0)];
  const double along = std::clamp(t - e.begin, 0.0, e.length);
  return {clamped, e.at(along)};
}

struct Finding {
  bool turning = false;        ///< the curve all but turns round in a point, at `places`
  std::vector<double> places;  ///< otherwise: outside, between sites
};

/// Looks between the sites and at the speed.
Finding inspect(const Stretch& stretch, const TubeProblem& problem, const TubeSpline& spline, double tolerance,
                const std::function<void()>& breathe) {
  Finding found;
  std::vector<double> slow;
  std::size_t span = 0;
  double last = problem.breaks.front();
  for (std::size_t i = 0; i <= problem.sites.size(); ++i) {
    if ((i & 8191) == 8191 && breathe) breathe();
    const double next = i < problem.sites.size() ? problem.sites[i].t : problem.breaks.back();
    double worst = tolerance, place = -1, least = slowest, halt = -1;
    for (int k = 1; k <= 4; ++k) {
      const double t = last + (next - last) * k / 4;
      while (span + 2 < problem.breaks.size() && t >= problem.breaks[span + 1]) ++span;
      const Jet f = spline.at(span, t);
      const double off = norm(f.value - point_of(stretch, t));
      if (k < 4 && !(off <= worst)) worst = off, place = t;
      if (const double speed = norm(f.d1); !(speed >= least)) least = speed, halt = t;
    }
    if (place >= 0) found.places.push_back(place);
    if (halt >= 0 && (slow.empty() || halt - slow.back() > problem.scale[span])) slow.push_back(halt);
    last = next;
  }
  found.turning = !slow.empty();
  if (found.turning) found.places = std::move(slow);
  return found;
}

}  // namespace

SmoothedRun smooth_run(const Stretch& stretch, const RunRange& range, const std::vector<double>& borders,
                       double tolerance, std::size_t dimension, const std::function<void()>& breathe) {
  SmoothedRun run;
  BendScale scale(stretch, range.a, range.b, tolerance, breathe);
  std::vector<double> extra;
  TubeProblem problem;
  problem.dimension = dimension;
  problem.begin = end_of(stretch, range.a, range.clamped_begin);
  problem.end = end_of(stretch, range.b, range.clamped_end);
  for (int round = 0; round < most_rounds; ++round) {
    problem.breaks = scale.breaks();
    snap(problem.breaks, borders);
    problem.scale.clear();
    for (std::size_t k = 0; k + 1 < problem.breaks.size(); ++k)
      problem.scale.push_back(2 * (problem.breaks[k + 1] - problem.breaks[k]));
    problem.sites = sites_of(stretch, range, scale, site_share * tolerance, extra);
    const TubeSpline spline = smooth_in_tube(problem, breathe);
    if (!spline.inside) {
      run.troubles.clear();
      for (const TubeSite& site : problem.sites) {
        const auto k = static_cast<std::size_t>(std::upper_bound(problem.breaks.begin(), problem.breaks.end(), site.t) -
                                                problem.breaks.begin());
        if (!(norm(spline.at(k - 1, site.t).value - site.p) < site.radius)) run.troubles.push_back(site.t);
      }
      scale.refine(run.troubles);
      continue;
    }
    const Finding finding = inspect(stretch, problem, spline, tolerance, breathe);
    if (finding.places.empty()) {
      for (Rational& piece : Nurbs(spline_degree, spline.points, {}, spline.knots).pieces())
        run.pieces.push_back(std::move(piece));
      run.breaks = problem.breaks;
      run.done = run.pieces.size() + 1 == run.breaks.size();
      return run;
    }
    run.troubles = finding.places;
    if (finding.turning) return run;
    extra.insert(extra.end(), finding.places.begin(), finding.places.end());
  }
  return run;
}

}  // namespace bahnwerk::blending
