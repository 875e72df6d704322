#include "core/cam/classical/classical_sections.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/cam/bernstein.hpp"
#include "core/cam/classical/half_law.hpp"
#include "core/cam/spline/spline_faults.hpp"

namespace bahnwerk::cam {
namespace {

/// The polynomial of degree 2k − 1 through k derivatives at both ends.
std::vector<double> hermite(int k, double duration, const SectionEnds& ends) {
  const int n = 2 * k - 1;
  std::vector<double> b(static_cast<std::size_t>(n + 1));
  // Forward differences at the begin: Δ^r b_0 = s^(r) T^r (n − r)!/n!; backward ones at the end.
  double scale = 1;
  std::vector<double> front, back;
  for (int r = 0; r < k; ++r) {
    front.push_back(ends.from[r] * scale), back.push_back(ends.to[r] * scale);
    scale *= duration / static_cast<double>(n - r);
  }
  for (int i = 0; i < k; ++i) {
    double forward = 0, backward = 0, binomial = 1;
    for (int r = 0; r <= i; ++r) {
      forward += binomial * front[static_cast<std::size_t>(r)];
      backward += (r % 2 == 0 ? binomial : -binomial) * back[static_cast<std::size_t>(r)];
      binomial *= static_cast<double>(i - r) / static_cast<double>(r + 1);
    }
    b[static_cast<std::size_t>(i)] = forward, b[static_cast<std::size_t>(n - i)] = backward;
  }
  return b;
}

std::string place_of(std::size_t section) { return std::to_string(section); }

/// States at the ends of a section and the faults in them.
class Ends {
 public:
  explicit Ends(const MotionLawProblem& problem, const std::vector<double>& breaks)
      : problem_(problem), breaks_(breaks) {}

  SectionEnds of(std::size_t section, std::vector<InputFault>& faults) const {
    SectionEnds ends;
    state(section, section, ends.from, faults);
    state(section, problem_.end_point(section), ends.to, faults);
    ends.to[0] += problem_.travel_at_end(section);
    return ends;
  }
  double slope(std::size_t section) const {
    return (problem_.end_position(section).min - problem_.points[section].value(0).min) /
           (breaks_[section + 1] - breaks_[section]);
  }

 private:
  void state(std::size_t section, std::size_t point, double* out, std::vector<InputFault>& faults) const {
    const MotionPoint& p = problem_.points[point];
    if (!p.value(0).fixed()) {
      faults.push_back({value_place(point, 0), "must be a number: section " + std::to_string(section) +
                                                   " follows a classical law, which begins and ends at given "
                                                   "positions"});
      return;
    }
    out[0] = p.value(0).min;
    if (problem_.points[section].law == ClassicalLaw::straight) {
      out[1] = slope(section);
      return;
    }
    for (int r = 1; r < 4; ++r)
      if (p.value(r).fixed()) out[r] = p.value(r).min;
    if (!p.value(1).fixed())
      if (const auto neighbour = other(section, point); neighbour && is_straight(*neighbour))
        out[1] = slope(*neighbour);
  }
  bool is_straight(std::size_t section) const {
    return problem_.points[section].law == ClassicalLaw::straight && problem_.points[section].value(0).fixed() &&
           problem_.points[problem_.end_point(section)].value(0).fixed();
  }
  std::optional<std::size_t> other(std::size_t section, std::size_t point) const {
    const std::size_t n = problem_.sections();
    if (point == section)
      return section > 0 ? std::optional(section - 1) : problem_.periodic ? std::optional(n - 1) : std::nullopt;
    return section + 1 < n     ? std::optional(section + 1)
           : problem_.periodic ? std::optional<std::size_t>(0)
                               : std::nullopt;
  }

  const MotionLawProblem& problem_;
  const std::vector<double>& breaks_;
};

double scale_of(const GivenSection& given, int order) {
  double least = given.bernstein.front().front(), most = least, shortest = given.breaks.back() - given.breaks.front();
  for (const auto& b : given.bernstein)
    for (const double c : b) least = std::min(least, c), most = std::max(most, c);
  for (std::size_t i = 0; i + 1 < given.breaks.size(); ++i)
    shortest = std::min(shortest, given.breaks[i + 1] - given.breaks[i]);
  return (order == 0 ? std::max(std::abs(least), std::abs(most)) : most - least) / std::pow(shortest, order);
}

}  // namespace

GivenSection classical_section(ClassicalLaw law, std::optional<double> inflection, double begin, double end,
                               const SectionEnds& ends, const SineStraight& fractions) {
  const double duration = end - begin;
  GivenSection out;
  if (law == ClassicalLaw::straight || (!inflection && law == ClassicalLaw::polynomial_345) ||
      (!inflection && law == ClassicalLaw::polynomial_4567)) {
    const int k = law == ClassicalLaw::straight ? 1 : law == ClassicalLaw::polynomial_345 ? 3 : 4;
    return {{begin, end}, {hermite(k, duration, ends)}};
  }
  const double lambda = inflection.value_or(0.5), h = ends.to[0] - ends.from[0];
  if (const std::vector<HalfLawPiece> whole = whole_law(law, inflection); !whole.empty()) {
    out.breaks.push_back(begin);
    for (const HalfLawPiece& piece : whole) {
      std::vector<double> b = piece.bernstein;
      for (double& c : b) c = ends.from[0] + h * c;
      out.bernstein.push_back(std::move(b));
      out.breaks.push_back(&piece == &whole.back() ? end : begin + piece.end * duration);
    }
    return out;
  }
  const std::vector<HalfLawPiece> half = half_law(law, fractions);
  const double cv = middle_velocity(half), v0 = ends.from[1], v1 = ends.to[1];
  const double vm = cv * h / duration - (cv - 1) * (lambda * v0 + (1 - lambda) * v1);
  // Coefficients of length · (v u + (vm − v) p(u)) over a piece of the half law, u = 2z.
  const auto coefficients = [&](const HalfLawPiece& piece, double length, double v) {
    std::vector<double> b = piece.bernstein;
    const double n = static_cast<double>(b.size() - 1);
    for (std::size_t k = 0; k < b.size(); ++k) {
      const double u = 2 * (piece.begin + (piece.end - piece.begin) * static_cast<double>(k) / n);
      b[k] = length * (v * u + (vm - v) * 2 * b[k] / cv);
    }
    return b;
  };
  const double first = lambda * duration, second = duration - first;
  out.breaks.push_back(begin);
  for (const HalfLawPiece& piece : half) {
    std::vector<double> b = coefficients(piece, first, v0);
    for (double& c : b) c += ends.from[0];
    out.bernstein.push_back(std::move(b));
    out.breaks.push_back(begin + 2 * piece.end * first);
  }
  for (auto piece = half.rbegin(); piece != half.rend(); ++piece) {
    std::vector<double> b = coefficients(*piece, second, v1);
    for (double& c : b) c = ends.to[0] - c;
    std::reverse(b.begin(), b.end());
    out.bernstein.push_back(std::move(b));
    out.breaks.push_back(piece + 1 == half.rend() ? end : end - 2 * piece->begin * second);
  }
  return out;
}

std::vector<std::optional<GivenSection>> classical_sections(const MotionLawProblem& problem,
                                                            const std::vector<double>& breaks) {
  const std::size_t n = problem.sections();
  const bool any = std::any_of(problem.points.begin(), problem.points.begin() + static_cast<std::ptrdiff_t>(n),
                               [](const MotionPoint& p) { return p.law.has_value(); });
  if (!any) return {};
  std::vector<InputFault> faults;
  std::vector<std::optional<GivenSection>> out(n);
  const Ends ends(problem, breaks);
  for (std::size_t s = 0; s < n; ++s) {
    const MotionPoint& point = problem.points[s];
    if (!point.law) continue;
    if (point.inflection && !has_inflection(*point.law))
      faults.push_back({{"points", place_of(s), "inflection"},
                        *point.law == ClassicalLaw::straight ? "a straight line has none: leave it out"
                                                             : "this law has its own: leave it out"});
    const std::size_t before = faults.size();
    const SectionEnds at = ends.of(s, faults);
    if (faults.size() == before)
      out[s] = classical_section(*point.law, point.inflection, breaks[s], breaks[s + 1], at, point.fractions);
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  constexpr double tolerance = 1e-9;
  // The laws are compared with what the points ask for, and with each other where two meet.
  for (std::size_t s = 0; s < n; ++s) {
    if (!out[s]) continue;
    for (const bool at_end : {false, true}) {
      const std::size_t p = at_end ? problem.end_point(s) : s;
      for (int r = 0; r < static_cast<int>(problem.points[p].values.size()); ++r) {
        const Range range = at_end && r == 0 ? problem.end_position(s) : problem.points[p].value(r);
        const double value = out[s]->end_value(at_end, r), slack = tolerance * scale_of(*out[s], r);
        if (value < range.min - slack || value > range.max + slack)
          faults.push_back({value_place(p, r),
                            std::string("the law ") + name_of<ClassicalLaw>(*problem.points[s].law, classical_laws) +
                                " of section " + std::to_string(s) + " has " + std::to_string(value) +
                                " here: leave this out or take another law"});
      }
      const std::size_t next = s + 1 < n ? s + 1 : 0;
      if (!at_end || (s + 1 == n && !problem.periodic) || !out[next]) continue;
      for (int r = 0; r <= problem.continuity(p); ++r) {
        const double more = r == 0 ? problem.travel_at_end(s) : 0;
        const double jump = std::abs(out[s]->end_value(true, r) - out[next]->end_value(false, r) - more);
        if (jump <= tolerance * std::max(scale_of(*out[s], r), scale_of(*out[next], r))) continue;
        faults.push_back({{"points", std::to_string(p), "continuity"},
                          "the laws before and behind this point differ by " + std::to_string(jump) + " in " +
                              order_name(r) + ": ask for continuity " + std::to_string(r - 1) +
                              ", or take other laws"});
        break;
      }
    }
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return out;
}

}  // namespace bahnwerk::cam
