#pragma once
/// Sections that follow a classical law: their pieces from the states at their ends [VDI 2143].
///
/// A symmetric law f with Cv = f'(1/2) is two halves: from velocity v0 the first one reaches v_m at the inflection λ,
/// the second one goes from there to v1. With p(u) = 2 f(u/2)/Cv, u from 0 at the section's end to 1 at λ,
///     s = s0 + λT (v0 u + (v_m − v0) p(u)),   s = s1 − (1 − λ)T (v1 u + (v_m − v1) p(u)),
///     v_m = Cv h/T − (Cv − 1)(λ v0 + (1 − λ) v1):
/// rest-to-rest for v0 = v1 = 0, motion-to-motion else. `polynomial_345` without λ takes accelerations at its ends, too
/// (the polynomial of degree 5 through both states), `polynomial_4567` accelerations and jerks.
#include <optional>
#include <vector>

#include "core/cam/problem.hpp"
#include "core/cam/spline/spline_system.hpp"

namespace bahnwerk::cam {

/// State in which a law begins or ends: position, velocity, acceleration, jerk.
struct SectionEnds {
  double from[4]{}, to[4]{};
};
/// Returns a section of the law between `begin` and `end`, s, with its inflection at the fraction λ of its length;
/// none: 0.5, or that of half_law.hpp. `fractions` are those of `sine_straight_combination`.
GivenSection classical_section(ClassicalLaw law, std::optional<double> inflection, double begin, double end,
                               const SectionEnds& ends, const SineStraight& fractions = {});

/// Returns one entry per section, none where the section is a polynomial; an empty list where no point names a law.
/// States at the ends are the numbers of the points; a velocity that is not given is that of a straight section beside
/// it, else 0, as are higher derivatives. Throws InvalidInput: a position that is no number, a value or range that the
/// law does not keep, laws that do not join as the point's continuity asks, an inflection of a straight line.
std::vector<std::optional<GivenSection>> classical_sections(const MotionLawProblem& problem,
                                                            const std::vector<double>& breaks);

}  // namespace bahnwerk::cam
