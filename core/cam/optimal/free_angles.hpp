#pragma once
/// Angles in ranges: J of the optimal law as a function of the points' times, made small by sequential linear programs.
///
/// At given times the program is convex (spline_program.hpp). Its rows depend on the times through the sections'
/// lengths: a joint program in coefficients and small changes of the times, linear at the last law, gives the next
/// times inside a trust region; the program at these times gives their true J. Several seeded starts; the least J is
/// taken.
#include <cstdint>
#include <vector>

#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {

struct FreeAngles {
  SplineResult spline;                ///< result from the best start; its `breaks` are the times
  std::vector<double> start_results;  ///< J that each start ended in
  int programs = 0;
};
/// Descends from several starts, which `seed` determines, and returns the least J.
FreeAngles optimise_angles(const LawTask& task, const LawBasis& basis, std::uint64_t seed, Progress progress);
/// Descends once, from times that are known to be good, say those of another degree.
FreeAngles refine_angles(const LawTask& task, const LawBasis& basis, const std::vector<double>& times,
                         Progress progress);

}  // namespace bahnwerk::cam
