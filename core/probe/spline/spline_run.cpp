#include "core/probe/spline/spline_run.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/bisection.hpp"
#include "core/probe/straight/straight.hpp"

namespace bahnwerk::probe {
namespace {

constexpr double least_share = 0.04;       // share of velocity at a point below which the head rests there
constexpr double quick_least_share = 0.3;  // least share where there are many points

/// Limits that hold along every direction.
Limits limits_anywhere(const ProbeProblem& problem) {
  Limits limits;
  limits.velocity = problem.speed;
  for (const AxisLimits& axis : problem.machine.axes) limits.lower_to(axis);
  return limits;
}

}  // namespace

bool has_many_points(const ProbeProblem& problem) { return problem.points.size() > 2000; }

SplineRun::SplineRun(const ProbeProblem& problem, std::size_t first, std::size_t last, bool rest_soon)
    : problem_(problem),
      first_(first),
      quick_(has_many_points(problem)),
      least_share_(rest_soon ? 1
                   : quick_  ? quick_least_share
                             : least_share),
      rounding_(coordinate_rounding(problem)),
      length_(last - first),
      time_(last - first),
      share_(last - first + 1, 1.0),
      ends_(last - first + 1),
      along_(last - first + 1) {
  for (std::size_t i = 0; i < intervals(); ++i)
    length_[i] = norm(problem.points[first + i + 1] - problem.points[first + i]);
  for (std::size_t i = 0; i <= intervals(); ++i) ends_[i].x = problem.points[first + i];
}

void SplineRun::start(double speed, double share) {
  double total = 0;
  for (const double length : length_) total += length;
  Limits limits = limits_anywhere(problem_);
  limits.scale(share);
  limits.velocity = speed;
  const Profile profile = straight_profile(total, 0, 0, limits);
  reach_ = std::min(direct_distance(0, speed, limits), total / 4);
  double way = 0, before = 0;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < intervals(); ++i) {
    way += length_[i];
    double t = profile.duration;
    along_[i + 1] = {};
    if (i + 1 < intervals()) {
      while (piece + 1 < profile.count && profile.piece[piece + 1].s <= way) ++piece;
      const ProfilePiece& p = profile.piece[piece];
      const Bisection when = bisect(0, p.duration, 0, 50, [&](double tau) { return p.at(tau).s < way; });
      const double tau = (when.low + when.high) / 2;
      t = p.t0 + tau;
      along_[i + 1] = p.at(tau);
    }
    time_[i] = std::max(t - before, 1e-3 * length_[i] / problem_.speed);
    before = t;
  }
}

void SplineRun::follow_profile() {
  const std::size_t n = intervals(), points = n < 4 ? 3 : 5;
  std::vector<double> at(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) at[i + 1] = at[i] + length_[i];
  for (std::size_t i = 1; i < n; ++i) {
    const std::size_t first = std::min(i - std::min(i, points / 2), n + 1 - points);
    // Newton's divided differences; Taylor coefficients at the point from there.
    std::array<double, 5> s{};
    std::array<Vec, 5> f{};
    for (std::size_t m = 0; m < points; ++m) s[m] = at[first + m] - at[i], f[m] = ends_[first + m].x - ends_[i].x;
    for (std::size_t step = 1; step < points; ++step)
      for (std::size_t m = points - 1; m >= step; --m) f[m] = (f[m] - f[m - 1]) / (s[m] - s[m - step]);
    std::array<Vec, 4> x{};  // Σ x_k (ℓ − ℓ_i)ᵏ
    for (std::size_t m = points; m-- > 0;) {
      for (std::size_t k = 3; k > 0; --k) x[k] = x[k - 1] - s[m] * x[k];
      x[0] = f[m] - s[m] * x[0];
    }
    // The chain rule.
    const ProfileState& p = along_[i];
    const Vec tangent = x[1], bend = 2 * x[2], change = 6 * x[3];
    ends_[i].v = p.v * tangent;
    ends_[i].a = p.a * tangent + (p.v * p.v) * bend;
    ends_[i].j = p.j * tangent + (3 * p.v * p.a) * bend + (p.v * p.v * p.v) * change;
  }
}

/// The parabola through three points.
void SplineRun::make_ends() {
  const std::size_t n = intervals();
  for (std::size_t i = 1; i < n; ++i) {
    const double h0 = time_[i - 1], h1 = time_[i];
    const Vec d0 = (ends_[i].x - ends_[i - 1].x) / h0, d1 = (ends_[i + 1].x - ends_[i].x) / h1;
    ends_[i].v = (h0 * d1 + h1 * d0) / (h0 + h1);
    ends_[i].a = (2 / (h0 + h1)) * (d1 - d0);
  }
  for (std::size_t i = 1; i < n; ++i) ends_[i].j = (ends_[i + 1].a - ends_[i - 1].a) / (time_[i - 1] + time_[i]);
  for (std::size_t i = 1; i < n; ++i) {
    const double s = share_[i];
    ends_[i].v = s * ends_[i].v;
    ends_[i].a = (s * s) * ends_[i].a;
    ends_[i].j = (s * s * s) * ends_[i].j;
  }
}

SplineRun::Strains SplineRun::strains(std::size_t i, double resolution) const {
  const double h = time_[i];
  const std::array<Strain, 3> axis = axis_strains(problem_);
  const Bezier x = septic(ends_[i], ends_[i + 1], h), v = derivative(x, h), a = derivative(v, h), j = derivative(a, h),
               s = derivative(j, h);
  const int depth = resolution < 1e-3 ? 40 : resolution < 0.05 ? 3 : 2;
  Strains out;
  const double slow = 0.5;  // a smaller share does not matter
  out.time = peak_of(
      v, [&](Vec w) { return norm(w) / problem_.speed; }, slow, resolution, depth);
  const auto take = [&](const Bezier& of, const Strain& strain, double order) {
    const double peak = peak_of(of, strain, std::pow(out.time, order), resolution, depth);
    out.time = std::max(out.time, std::pow(peak, 1 / order));
  };
  take(a, axis[0], 2);
  take(j, axis[1], 3);
  take(s, axis[2], 4);
  out.tube = tube_strain(x, i, resolution, depth);
  return out;
}

double SplineRun::tube_strain(const Bezier& x, std::size_t i, double resolution, int depth) const {
  const double allowed = problem_.tolerance + rounding_;
  const auto distance = [&](Vec p) { return distance_from_edge(p, ends_[i].x, ends_[i + 1].x) / allowed; };
  return peak_of(x, distance, 0.25, resolution, depth);
}

bool SplineRun::in_tube(ProgressScope& progress) const {
  for (std::size_t i = 0; i < intervals(); ++i) {
    progress.work(1);
    if (tube_strain(septic(ends_[i], ends_[i + 1], time_[i]), i, quick_ ? 0.1 : 0.02, quick_ ? 2 : 3) > 1) return false;
  }
  return true;
}

void SplineRun::smooth(std::vector<double>& factor) const {
  const std::size_t n = factor.size();
  if (!(reach_ > 0)) return;
  // The least function above it whose slope is 1/reach at most, …
  for (std::size_t i = 1; i < n; ++i)
    factor[i] = std::max(factor[i], factor[i - 1] - (length_[i] + length_[i - 1]) / 2 / reach_);
  for (std::size_t i = n - 1; i-- > 0;)
    factor[i] = std::max(factor[i], factor[i + 1] - (length_[i] + length_[i + 1]) / 2 / reach_);
  // … averaged, three times.
  std::vector<double> place(n + 1, 0), sum(n + 1, 0);
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t i = 0; i < n; ++i) {
      place[i + 1] = place[i] + length_[i];
      sum[i + 1] = sum[i] + length_[i] * factor[i];
    }
    const auto integral = [&](double at, std::size_t& hint) {
      while (hint + 1 < n && place[hint + 1] < at) ++hint;
      return sum[hint] + (at - place[hint]) * factor[hint];
    };
    std::vector<double> average(n);
    std::size_t low = 0, high = 0;
    const double half = reach_ / 8;
    for (std::size_t i = 0; i < n; ++i) {
      const double middle = place[i] + length_[i] / 2;
      const double from = std::max(0.0, middle - half), to = std::min(place[n], middle + half);
      average[i] = (integral(to, high) - integral(from, low)) / (to - from);
    }
    factor = std::move(average);
  }
}

/// Reduces what the points at the ends of intervals outside of the tube prescribe.
void SplineRun::reduce(const std::vector<Strains>& strains) {
  std::vector<double> factor(share_.size(), 1.0);
  for (std::size_t i = 0; i < intervals(); ++i) {
    if (strains[i].tube <= 1) continue;
    const double by = quick_ ? std::clamp(0.97 / strains[i].tube, 0.2, 0.97)
                             : std::clamp(0.97 / std::sqrt(strains[i].tube), 0.4, 0.97);
    factor[i] = std::min(factor[i], by), factor[i + 1] = std::min(factor[i + 1], by);
  }
  for (std::size_t i = 1; i < intervals(); ++i) {
    share_[i] *= factor[i];
    if (share_[i] < least_share_) rests_.push_back(first_ + i);
  }
}

bool SplineRun::look(std::vector<Strains>& strains, ProgressScope& progress) {
  double worst = 0, sum = 0;
  bool inside = true;
  for (std::size_t i = 0; i < intervals(); ++i) {
    strains[i] = this->strains(i, quick_ ? 0.1 : 0.02);
    worst = std::max(worst, strains[i].time), sum += time_[i];
    inside = inside && strains[i].tube <= 1;
    progress.work(4);
  }
  if (inside && worst * sum < best_.duration) best_ = {worst * sum, time_, ends_};
  return inside;
}

/// Where points are dense, a speed that changes as smoothly as the profile's is most of what there is to gain. The path
/// hardly depends on the profile: what the pieces at its full speed exceed lowers that speed, what the others exceed
/// lowers its share of the limits, until either uses what there is.
void SplineRun::search_profile(std::vector<Strains>& now, ProgressScope& progress) {
  constexpr int rounds = 10;
  constexpr double full = 0.9, least_of_limits = 0.02;
  double speed = problem_.speed, share = 0.5;
  for (int round = 0; round < rounds && intervals() > 1; ++round) {
    start(speed, share);
    follow_profile();
    if (!in_tube(progress) || !look(now, progress)) return;
    double top = 0, at_top = 0, elsewhere = 0;
    for (const ProfileState& p : along_) top = std::max(top, p.v);
    for (std::size_t i = 0; i < intervals(); ++i) {
      double& most = std::max(along_[i].v, along_[i + 1].v) > full * top ? at_top : elsewhere;
      most = std::max(most, now[i].time);
    }
    speed = std::min(top / at_top, problem_.speed);
    if (elsewhere > 0) share = std::clamp(share / (elsewhere * elsewhere * elsewhere), least_of_limits, 1.0);
  }
}

void SplineRun::search(ProgressScope& progress) {
  std::vector<Strains> now(intervals());
  search_profile(now, progress);
  start(problem_.speed, 1);
  const int rounds = quick_ ? 10 : 24;
  for (int round = 0; round < rounds; ++round) {
    make_ends();
    if (!look(now, progress)) {
      reduce(now);
      if (!rests_.empty()) break;
    }
    std::vector<double> factor(intervals());
    for (std::size_t i = 0; i < intervals(); ++i) factor[i] = now[i].time;
    smooth(factor);
    for (std::size_t i = 0; i < intervals(); ++i) time_[i] *= std::pow(std::clamp(factor[i], 0.8, 4.0), 0.8);
  }
  if (best_.duration < unlimited) rests_.clear();
  if (best_.duration < unlimited || !rests_.empty()) return;
  // The tube is too narrow for what is still prescribed at the point that is left with least.
  std::size_t least = 1;
  for (std::size_t i = 1; i < intervals(); ++i)
    if (share_[i] < share_[least]) least = i;
  rests_.push_back(first_ + least);
}

/// Limits are kept exactly: time scaled as a whole leaves the path as it is.
bool SplineRun::finish(ProgressScope& progress) {
  time_ = std::move(best_.time), ends_ = std::move(best_.ends);
  double scale = 0;
  bool inside = true;
  for (std::size_t i = 0; i < intervals(); ++i) {
    const Strains exact = strains(i, 1e-10);
    scale = std::max(scale, exact.time);
    inside = inside && exact.tube <= 1;
    progress.work(16);
  }
  if (!inside) return false;
  scale *= 1 + 2e-9;  // margin for rounding, and for enclosures of whoever checks
  for (double& t : time_) t *= scale;
  for (SepticEnd& e : ends_) e.v = e.v / scale, e.a = e.a / (scale * scale), e.j = e.j / (scale * scale * scale);
  return true;
}

bool SplineRun::solve(ProgressScope& progress) {
  search(progress);
  if (best_.duration < unlimited && finish(progress)) return true;
  if (rests_.empty()) rests_.push_back(first_ + intervals() / 2);
  return false;
}

double SplineRun::duration() const {
  double sum = 0;
  for (const double t : time_) sum += t;
  return sum;
}

}  // namespace bahnwerk::probe
