#pragma once
/// Verifies what a drive has to bring about for a law against its limits and against what is reported.
#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/cam_profile/given_drive.hpp"

namespace bahnwerk {

struct LawToVerify;

struct LoadToVerify {
  cam::DriveLoad load;
  cam::LoadLimits limits;
  double peak = 0;  ///< largest |force| or |torque| as reported
  double rms = 0;   ///< as reported
};

/// Appends checks, `at` s:
///   drive <force|torque>       enclosed peak beyond the given limit, or beyond the reported one
///   drive rms <force|torque>   root of the mean square by Simpson's rule beyond the limit or the reported one
/// Without friction the force is one polynomial per piece; friction is added with the signs that s′ takes in parts of
/// the piece. Tolerances: 1e-6 of the value; 1e-3 of the root of the mean square, whose friction jumps.
void verify_load(const LawToVerify& law, const LoadToVerify& load, Progress progress, Verification& out);

}  // namespace bahnwerk
