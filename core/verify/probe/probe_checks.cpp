#include "core/verify/probe/probe_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/progress_scope.hpp"
#include "core/verify/motion/bernstein.hpp"
#include "core/verify/motion/motion_checks.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace verify {
namespace {

constexpr double resolution = 1e-9;         // resolution relative to a peak
constexpr double coordinate_share = 1e-12;  // error of a deviation relative to the largest coordinate
constexpr double end_tolerance = 1e-9;      // mm

/// Bernstein coefficients of up to three coordinates over a part of a piece.
struct Part {
  std::array<Bernstein, 3> c{};
  std::size_t n = 0, axes = 0;
  Vec at(std::size_t i) const { return {c[0][i], c[1][i], axes > 2 ? c[2][i] : 0.0}; }

  /// De Casteljau at the middle; this one becomes the left half.
  Part cut() {
    Part right = *this;
    for (std::size_t k = 0; k < axes; ++k)
      for (std::size_t step = 1; step < n; ++step) {
        for (std::size_t i = n - 1; i >= step; --i) c[k][i] = (c[k][i - 1] + c[k][i]) / 2;
        right.c[k][n - 1 - step] = c[k][n - 1];
      }
    return right;
  }
};

struct Span {
  Part part;
  double begin, end;
  int depth;
};

/// The largest value so far, from above, and one that is reached: they differ by no more than the resolution, however
/// many parts were searched.
struct Highest : Worst {
  double reached = 0;
};

class Enclosure {
 public:
  /// Raises `worst` to the largest f, which is convex, over the part: its coefficients bound it from above, its ends
  /// from below. Not a number stays.
  template <class F>
  void raise(const Part& part, double begin, double end, F&& f, Highest& worst) {
    spans_.clear();
    spans_.push_back({part, begin, end, 0});
    while (!spans_.empty()) {
      Span now = spans_.back();
      spans_.pop_back();
      double upper = 0;
      for (std::size_t i = 0; i < now.part.n; ++i) {
        const double value = f(now.part.at(i));
        if (!std::isfinite(value)) return worst.raise(std::nan(""), now.begin);
        upper = std::max(upper, value);
      }
      if (upper <= worst.reached * (1 + resolution)) {
        worst.raise(upper, now.begin);
        continue;
      }
      const double first = f(now.part.at(0)), last = f(now.part.at(now.part.n - 1)), lower = std::max(first, last);
      const double when = first >= last ? now.begin : now.end;
      worst.reached = std::max(worst.reached, lower);
      if (upper <= lower * (1 + resolution) || now.depth >= deepest) {
        worst.raise(upper, when);
        continue;
      }
      worst.raise(lower, when);
      const double middle = (now.begin + now.end) / 2;
      const Part right = now.part.cut();
      spans_.push_back({right, middle, now.end, now.depth + 1});
      spans_.push_back({now.part, now.begin, middle, now.depth + 1});
    }
  }

 private:
  static constexpr int deepest = 44;
  std::vector<Span> spans_;
};

class ProbeChecker {
 public:
  explicit ProbeChecker(const ProbeToVerify& in) : in_(in) {
    for (const Vec& p : in.problem.given) largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }

  std::vector<Check> run(ProgressScope& scope) {
    pieces(scope);
    points();
    const double T = in_.motion.duration();
    const Worst start{error(position(in_.motion.in_piece(0, 0)) - in_.problem.given.front()), 0},
        end{std::max(error(position(in_.motion.final_state()) - in_.problem.given.back()),
                     error(position(in_.motion.in_piece(in_.motion.pieces() - 1, T)) - in_.problem.given.back())),
            T};
    const double tube = in_.problem.tolerance;
    Check deviation = make_check("deviation", "mm", tube, deviation_);
    deviation.passed = deviation.value <= tube * (1 + limit_tolerance) + coordinate_share * largest_;
    return {make_check("speed", "mm/s", in_.problem.speed, speed_), std::move(deviation),
            make_check("points", "mm", in_.problem.point_tolerance, points_),
            make_check("start position", "mm", end_tolerance, start),
            make_check("end position", "mm", end_tolerance, end)};
  }

 private:
  static double error(Vec difference) { return norm(difference); }
  Vec position(const MotionState& x) const { return {x[0][0], x[0][1], in_.problem.dimension() > 2 ? x[0][2] : 0.0}; }

  void pieces(ProgressScope& scope) {
    const Motion& motion = in_.motion;
    if (!times_ascend()) {
      deviation_.raise(std::numeric_limits<double>::infinity(), 0);
      points_.raise(std::numeric_limits<double>::infinity(), 0);
    }
    std::size_t edge = 0;
    for (std::size_t i = 0; i < motion.pieces(); ++i) {
      scope.now(i, motion.pieces());
      std::array<Polynomial, 3> x;
      bool known = motion.axes() == in_.problem.dimension();
      for (std::size_t k = 0; known && k < motion.axes(); ++k) known = motion.polynomial(i, k, x[k]);
      const double begin = motion.begin(i), end = motion.end(i);
      if (!known) {
        speed_.raise(std::nan(""), begin);
        deviation_.raise(std::nan(""), begin);
        continue;
      }
      std::array<Polynomial, 3> v;
      for (std::size_t k = 0; k < motion.axes(); ++k) v[k] = derivative(x[k]);
      enclosure_.raise(
          part(v, end - begin), begin, end, [](Vec w) { return norm(w); }, speed_);
      if (!std::isfinite(deviation_.value)) continue;
      for (double from = begin; from < end;) {
        while (edge + 1 < in_.problem.edges() && in_.times[edge + 1] <= from) ++edge;
        const double to = edge + 1 < in_.problem.edges() ? std::min(end, in_.times[edge + 1]) : end;
        std::array<Polynomial, 3> here;
        for (std::size_t k = 0; k < motion.axes(); ++k) here[k] = from > begin ? shifted(x[k], from - begin, 1) : x[k];
        const Vec a = in_.problem.points[edge], b = in_.problem.points[edge + 1];
        enclosure_.raise(
            part(here, to - from), from, to, [&](Vec p) { return distance_from_edge(p, a, b); }, deviation_);
        from = to;
      }
    }
  }

  Part part(const std::array<Polynomial, 3>& x, double duration) const {
    Part out;
    out.axes = in_.motion.axes();
    for (std::size_t k = 0; k < out.axes; ++k) out.n = std::max(out.n, x[k].size());
    out.n = std::max<std::size_t>(out.n, 1);
    for (std::size_t k = 0; k < out.axes; ++k) {
      Polynomial p = x[k];
      p.resize(out.n, 0.0);
      bernstein(p, duration, 0, out.c[k]);
    }
    return out;
  }

  bool times_ascend() const {
    const auto& t = in_.times;
    return t.size() == in_.problem.points.size() && t.front() == 0 && t.back() == in_.motion.duration() &&
           std::is_sorted(t.begin(), t.end());
  }

  /// Checks each point of the document at the time of the point that it counts as.
  void points() {
    if (!std::isfinite(points_.value)) return;
    const ProbeProblem& p = in_.problem;
    std::size_t piece = 0;
    for (std::size_t i = 0; i < p.given.size(); ++i) {
      const std::size_t k = p.point_of.at(i);
      const bool next = i == 0 ? k == 0 : k == p.point_of[i - 1] || k == p.point_of[i - 1] + 1;
      const double t = next && k < in_.times.size() ? in_.times[k] : 0;
      if (!next || norm(p.given[i] - p.points.at(k)) > p.point_tolerance)
        return points_.raise(std::numeric_limits<double>::infinity(), t);
      points_.raise(error(position(in_.motion.evaluate(t, piece)) - p.given[i]), t);
    }
    if (p.point_of.back() + 1 != p.points.size()) points_.raise(std::numeric_limits<double>::infinity(), 0);
  }

  const ProbeToVerify& in_;
  Enclosure enclosure_;
  double largest_ = 0;
  Highest speed_, deviation_;
  Worst points_;
};

}  // namespace
}  // namespace verify

std::vector<Check> probe_checks(const ProbeToVerify& input, Progress progress) {
  MotionToVerify motion{input.motion, input.problem.machine.axes, 3};
  motion.unit = "mm";
  std::vector<Check> checks = motion_checks(motion, progress.part(0, 0.5));
  ProgressScope scope(progress.part(0.5, 1), "verify");
  for (Check& check : verify::ProbeChecker(input).run(scope)) checks.push_back(std::move(check));
  return checks;
}

}  // namespace bahnwerk
