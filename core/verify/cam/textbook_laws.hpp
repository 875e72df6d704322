#pragma once
/// Compares sections that name a classical law with its textbook formula.
#include <optional>

#include "core/base/verification.hpp"
#include "core/cam/problem.hpp"

namespace bahnwerk {

struct LawToVerify;

namespace verify {

/// Returns f(z) of a law from rest to rest with its inflection at λ (none: the law's own), f(0) = 0, f(1) = 1
/// [VDI 2143]. `fractions` are those of `sine_straight_combination`.
double textbook_law(cam::ClassicalLaw law, double z, std::optional<double> inflection,
                    const cam::SineStraight& fractions = {});

/// Adds `classical law`: the largest distance, in parts of the stroke, of every section that names a law and rests at
/// both ends (or is straight), at 200 places each. Nothing where no section does.
void check_textbook_laws(const cam::MotionLawProblem& problem, const LawToVerify& law, Verification& out);

}  // namespace verify
}  // namespace bahnwerk
