#include "core/probe/spline/spline_run.hpp"

#include <algorithm>
#include <cmath>

#include "core/probe/straight/straight.hpp"

namespace bahnwerk::probe {
namespace {

constexpr int rounds = 24;
constexpr double least_share = 0.04;  // of velocity at a point: below it the head rests there

/// Limits that hold along every direction.
ProfileLimits limits_anywhere(const ProbeProblem& problem) {
  ProfileLimits limits;
  limits.velocity = problem.speed;
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    limits.acceleration = std::min(limits.acceleration, problem.axis(k).acceleration);
    limits.jerk = std::min(limits.jerk, problem.axis(k).jerk);
    limits.snap = std::min(limits.snap, problem.axis(k).snap);
  }
  return limits;
}

}  // namespace

SplineRun::SplineRun(const ProbeProblem& problem, std::size_t first, std::size_t last, bool jerks)
    : problem_(problem),
      first_(first),
      jerks_(jerks),
      rounding_(coordinate_rounding(problem)),
      length_(last - first),
      time_(last - first),
      share_(last - first + 1, 1.0),
      ends_(last - first + 1) {
  for (std::size_t i = 0; i < intervals(); ++i)
    length_[i] = norm(problem.points[first + i + 1] - problem.points[first + i]);
  for (std::size_t i = 0; i <= intervals(); ++i) ends_[i].x = problem.points[first + i];
}

void SplineRun::start() {
  double total = 0;
  for (const double length : length_) total += length;
  const ProfileLimits limits = limits_anywhere(problem_);
  const Profile profile = straight_profile(total, 0, 0, limits);
  reach_ = std::min(direct_distance(0, problem_.speed, limits), total / 4);
  double way = 0, before = 0;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < intervals(); ++i) {
    way += length_[i];
    double t = profile.duration;
    if (i + 1 < intervals()) {
      while (piece + 1 < profile.count && profile.piece[piece + 1].s <= way) ++piece;
      const ProfilePiece& p = profile.piece[piece];
      double low = 0, high = p.duration;
      for (int step = 0; step < 50; ++step) (p.at((low + high) / 2).s < way ? low : high) = (low + high) / 2;
      t = p.t0 + (low + high) / 2;
    }
    time_[i] = std::max(t - before, 1e-3 * length_[i] / problem_.speed);
    before = t;
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
  for (std::size_t i = 1; i < n; ++i)
    ends_[i].j = jerks_ ? (ends_[i + 1].a - ends_[i - 1].a) / (time_[i - 1] + time_[i]) : Vec{};
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
  const int depth = resolution < 1e-3 ? 40 : 3;
  Strains out;
  const double slow = 0.5;  // below it nothing matters
  out.time = peak_of(
      v, [&](Vec w) { return norm(w) / problem_.speed; }, slow, resolution, depth);
  const auto take = [&](const Bezier& of, const Strain& strain, double order) {
    const double peak = peak_of(of, strain, std::pow(out.time, order), resolution, depth);
    out.time = std::max(out.time, std::pow(peak, 1 / order));
  };
  take(a, axis[0], 2);
  take(j, axis[1], 3);
  take(s, axis[2], 4);
  const double allowed = problem_.tolerance + rounding_;
  const auto distance = [&](Vec p) { return distance_from_edge(p, ends_[i].x, ends_[i + 1].x) / allowed; };
  out.tube = peak_of(x, distance, 0.25, resolution, depth);
  return out;
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

/// Reduces what the points at the ends of intervals outside of the tube prescribe; whether there were any.
bool SplineRun::reduce(const std::vector<Strains>& strains) {
  bool any = false;
  std::vector<double> factor(share_.size(), 1.0);
  for (std::size_t i = 0; i < intervals(); ++i) {
    if (strains[i].tube <= 1) continue;
    any = true;
    const double by = std::clamp(0.97 / std::sqrt(strains[i].tube), 0.4, 0.97);
    factor[i] = std::min(factor[i], by), factor[i + 1] = std::min(factor[i + 1], by);
  }
  for (std::size_t i = 1; i < intervals(); ++i) {
    share_[i] *= factor[i];
    if (share_[i] < least_share) rests_.push_back(first_ + i);
  }
  return any;
}

bool SplineRun::solve(ProgressScope& progress) {
  start();
  std::vector<double> best_time, best_share;
  double best = unlimited;
  for (int round = 0; round < rounds; ++round) {
    make_ends();
    std::vector<Strains> now(intervals());
    double worst = 0, sum = 0;
    for (std::size_t i = 0; i < intervals(); ++i) {
      now[i] = strains(i, 0.02);
      worst = std::max(worst, now[i].time), sum += time_[i];
      progress.work(4);
    }
    if (!reduce(now)) {
      if (worst * sum < best) best = worst * sum, best_time = time_, best_share = share_;
    } else if (!rests_.empty()) {
      return false;
    }
    std::vector<double> factor(intervals());
    for (std::size_t i = 0; i < intervals(); ++i) factor[i] = now[i].time;
    smooth(factor);
    for (std::size_t i = 0; i < intervals(); ++i) time_[i] *= std::pow(std::clamp(factor[i], 0.8, 4.0), 0.8);
  }
  if (best_time.empty()) {
    // The tube is too narrow for what is still prescribed at the point that is left with least.
    std::size_t least = 1;
    for (std::size_t i = 1; i < intervals(); ++i)
      if (share_[i] < share_[least]) least = i;
    rests_.push_back(first_ + least);
    return false;
  }
  time_ = std::move(best_time), share_ = std::move(best_share);
  make_ends();
  // Time scaled as a whole leaves the path as it is.
  double scale = 0;
  bool inside = true;
  for (std::size_t i = 0; i < intervals(); ++i) {
    const Strains exact = strains(i, 1e-10);
    scale = std::max(scale, exact.time);
    inside = inside && exact.tube <= 1;
    progress.work(16);
  }
  if (!inside) {
    rests_.push_back(first_ + intervals() / 2);
    return false;
  }
  scale *= 1 + 1e-12;
  for (double& t : time_) t *= scale;
  for (SepticEnd& e : ends_) e.v = e.v / scale, e.a = e.a / (scale * scale), e.j = e.j / (scale * scale * scale);
  return true;
}

double SplineRun::duration() const {
  double sum = 0;
  for (const double t : time_) sum += t;
  return sum;
}

}  // namespace bahnwerk::probe
