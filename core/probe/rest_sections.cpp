#include "core/probe/rest_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bahnwerk::probe {
namespace {

/// A part of a plan from rest at point `from` to rest at point `to`.
struct RestSection {
  std::size_t plan = 0, from = 0, to = 0;
  double begin = 0, end = 0;  // s
};

/// Joins sections one behind the other.
class SectionWriter {
 public:
  explicit SectionWriter(const ProbeProblem& problem) : problem_(problem), position_(problem.points.front()) {
    out_.times.push_back(0);
  }

  void add(const ProbeMotion& plan, const RestSection& section) {
    const SplineMotion& spline = *plan.motion;
    const double begin = sum_.value();
    if (section.from > 0) {
      out_.times.push_back(begin);
      out_.phases.push_back({ProbePhaseKind::rest, begin, begin, section.from});
    }
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * spline.duration();
    std::size_t piece = piece_at(spline, section.begin - rounding);
    const std::size_t end = piece_at(spline, section.end - rounding);
    const Vec shift = shift_to(spline, piece, section.from);
    for (; piece < end; ++piece) {
      sum_.add(plan.durations[piece]);
      out_.durations.push_back(plan.durations[piece]);
      out_.joints.push_back(plan.joints[piece]);
      SplineMotion::Piece copy{sum_.value(), std::vector<Polynomial>(problem_.dimension())};
      const double last = pieces_.empty() ? 0 : pieces_.back().end;
      for (std::size_t k = 0; k < problem_.dimension(); ++k) {
        spline.polynomial(piece, k, copy.axes[k]);
        copy.axes[k][0] += shift[k];
        position_[k] = evaluate(copy.axes[k], copy.end - last);
      }
      pieces_.push_back(std::move(copy));
    }
    const auto moved = [&](double t) { return begin + (t - section.begin); };
    for (std::size_t i = section.from + 1; i < section.to; ++i) out_.times.push_back(moved(plan.times[i]));
    auto phase = std::lower_bound(plan.phases.begin(), plan.phases.end(), section.begin - rounding,
                                  [](const ProbePhase& p, double t) { return p.begin < t; });
    for (; phase != plan.phases.end() && phase->end <= section.end + rounding; ++phase)
      if (phase->kind != ProbePhaseKind::rest)
        out_.phases.push_back({phase->kind, moved(phase->begin), moved(phase->end), phase->point});
  }

  ProbeMotion finish() {
    out_.times.push_back(sum_.value());
    out_.motion = std::make_shared<const SplineMotion>(std::move(pieces_));
    return std::move(out_);
  }

 private:
  /// The number of the first piece that begins at t or later.
  static std::size_t piece_at(const SplineMotion& spline, double t) {
    std::size_t low = 0, high = spline.pieces();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (spline.begin(middle) < t)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }
  /// Sections begin where the one before has ended, or at the point itself where rounding alone is between.
  Vec shift_to(const SplineMotion& spline, std::size_t piece, std::size_t point) {
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    Vec shift{};
    for (std::size_t k = 0; k < problem_.dimension(); ++k) {
      Polynomial p;
      spline.polynomial(piece, k, p);
      const double x = problem_.points[point][k];
      if (std::abs(x - position_[k]) <= rounding * std::abs(x)) position_[k] = x;
      shift[k] = std::abs(p[0] - position_[k]) > rounding * std::abs(p[0]) ? position_[k] - p[0] : 0;
    }
    return shift;
  }

  const ProbeProblem& problem_;
  ProbeMotion out_;
  std::vector<SplineMotion::Piece> pieces_;
  TimeSum sum_;
  Vec position_;
};

}  // namespace

ProbeMotion quickest_sections(const ProbeProblem& problem, std::vector<ProbeMotion> plans) {
  std::vector<RestSection> sections;
  for (std::size_t plan = 0; plan < plans.size(); ++plan) {
    RestSection next{plan, 0, 0, 0, 0};
    const auto close = [&](std::size_t point, double t) {
      next.to = point, next.end = t;
      sections.push_back(next);
      next.from = point, next.begin = t;
    };
    for (const ProbePhase& phase : plans[plan].phases)
      if (phase.kind == ProbePhaseKind::rest) close(phase.point, phase.begin);
    close(problem.points.size() - 1, plans[plan].duration());
  }
  std::stable_sort(sections.begin(), sections.end(),
                   [](const RestSection& a, const RestSection& b) { return a.to < b.to; });
  std::vector<double> time(problem.points.size(), unlimited);
  std::vector<const RestSection*> by(problem.points.size(), nullptr);
  time[0] = 0;
  for (const RestSection& s : sections) {
    const double sum = time[s.from] + (s.end - s.begin);
    if (sum < time[s.to]) time[s.to] = sum, by[s.to] = &s;
  }
  std::vector<const RestSection*> path;
  for (std::size_t i = problem.points.size() - 1; i > 0; i = by[i]->from) path.push_back(by[i]);
  std::reverse(path.begin(), path.end());
  const std::size_t first = path.front()->plan;
  if (std::all_of(path.begin(), path.end(), [&](const RestSection* s) { return s->plan == first; }))
    return std::move(plans[first]);
  SectionWriter writer(problem);
  for (const RestSection* s : path) writer.add(plans[s->plan], *s);
  return writer.finish();
}

}  // namespace bahnwerk::probe
