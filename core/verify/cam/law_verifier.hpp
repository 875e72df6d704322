#pragma once
/// The independent verifier of a motion law: it sees what the user gave, the law's coefficients as they are published,
/// and the table of setpoints. It shares no evaluation with the solvers: derivatives are formed and enclosed by
/// formulas of its own, so every check holds between the rows, too.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/cam/problem.hpp"

namespace bahnwerk {

/// A law as it is published.
struct LawToVerify {
  std::vector<double> breaks;                  ///< s, one more than pieces
  std::vector<std::size_t> sections;           ///< the section of each piece
  std::vector<std::vector<double>> bernstein;  ///< Bernstein coefficients of each piece, over its local parameter 0 … 1
  std::vector<double> at;                      ///< chosen angles, one per point, master's unit
  double cycle_duration = 0;                   ///< s
  double objective = 0;                        ///< J as reported
  std::vector<double> peaks;                   ///< reported peaks by order
  std::optional<double> bound;                 ///< reported bound on J
  std::vector<double> rms;                     ///< reported RMS values by order, empty or from 0 to 3
};

/// Checks, each the worst of its kind, `at` s:
///   angles                      chosen angles out of their ranges or order, and sections that do not begin there
///   value <derivative>          distance of the law from a number, or beyond a range, at either side of a point
///   continuity <derivative>     largest jump at points, up to the order that each asks for
///   section limit <derivative>  how far the law leaves the limits of a section, anywhere inside (enclosed)
///   drive <derivative>          peak against what the drive can do
///   peak <derivative>           enclosed peak beyond the reported one
///   rms <derivative>            distance of the reported root of the mean square of acceleration and jerk from that
///                               of the coefficients
///   objective                   J from the enclosed peaks beyond the reported one
///   classical law               distance from the textbook's formula, rest to rest, in parts of the stroke
///   residual vibration          what a mode has left where the law is to be still, in parts of the peak acceleration
///   table <column>              distance of a row from the law
///   table section limit <derivative>   rows beyond the limits of their section
///   bound                       bound beyond J
/// Tolerances: 1e-9 of the derivative's size in the whole law, and what rounding of the coefficients may move it, 1e-4
/// of that size at most: the shorter a piece, the more its rounding moves a derivative, but not what is accepted.
/// O(pieces · degree²) and O(rows · degree²).
Verification verify_motion_law(const cam::MotionLawProblem& problem, const LawToVerify& law,
                               const SetpointSource& table, Progress progress);

}  // namespace bahnwerk
