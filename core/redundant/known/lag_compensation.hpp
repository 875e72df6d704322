#pragma once
/// Compensation of the following error [Bock 3.4]: the coarse drives get the head's motion although they cannot follow
/// it, and the fine ones their following error. Drives are first-order lags, T_c of the coarse and T_f of the fine
/// axes.
///
/// Planned is the motion of coarse axes that lag by T_c, with limits of the reference such that this motion and the
/// following error hold the limits of coarse and fine axes. Simulated is where the tool really is: the fine drive lags,
/// too, and the tool's transfer function is 1 − (1 − G_c)(1 − G_f), which overshoots (the source's step response in
/// 3.4.1 has a wrong sign: it would begin at 2). With the prefilter V = 1 + G_c − G_c/G_f before the fine drive it is
/// G_f, that of the fine axis alone.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Tells by how much the tool overshoots a unit step without the prefilter: r^((1 + r)/(1 − r)) with r = T_f/T_c ∈ (0,
/// 1).
double step_overshoot(double coarse_lag, double fine_lag);
/// Returns the radius of the circle that the tool makes of one of radius 1 that it goes round with `rate` rad/s.
double circle_gain(double coarse_lag, double fine_lag, double rate, bool prefilter);

/// V(σ) = 1 + G_c − G_c/G_f = (1 + (T_c − T_f) σ)/(1 + T_c σ) before the fine drive [Bock 3.4.2]: what a controller
/// needs to filter the head's setpoints, from which it takes the coarse axis' place.
struct Prefilter {
  double numerator[2];    ///< of powers of σ: 1, s
  double denominator[2];  ///< the same
  /// y_i = b_0 x_i + b_1 x_{i−1} − a_1 y_{i−1} with one value per cycle: exact where x is linear in between.
  double b[2], a1;
};
Prefilter prefilter(double coarse_lag, double fine_lag, double cycle_time);

RedundancyResult plan_lag_compensation(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                       double from, double to);

}  // namespace bahnwerk
