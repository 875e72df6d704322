#pragma once
/// Compensation of the following error [Bock 3.4]: the coarse drives receive the head's motion although they cannot
/// follow it, and the fine axes move by the coarse axes' following error. Drives are modelled as first-order lags with
/// the transfer functions G_c and G_f and the time constants T_c (coarse) and T_f (fine).
///
/// The plan is the motion of coarse axes that lag by T_c; the limits of the reference are such that this motion and the
/// following error keep the limits of coarse and fine axes. The simulation computes the tool's true position, since the
/// fine drive lags as well: the tool's transfer function is 1 − (1 − G_c)(1 − G_f), which overshoots. (The step
/// response in 3.4.1 of the source has a wrong sign; as printed it would begin at 2.) With the prefilter V = 1 + G_c −
/// G_c/G_f before the fine drive it is G_f, that of the fine axis alone.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Returns the overshoot of the tool's unit step response without prefilter: r^((1 + r)/(1 − r)) with r = T_f/T_c ∈ (0,
/// 1). Both lags are in s.
double step_overshoot(double coarse_lag, double fine_lag);
/// Returns the radius of the circle that the tool describes for a reference circle of radius 1 at the angular velocity
/// `rate`, rad/s.
double circle_gain(double coarse_lag, double fine_lag, double rate, bool prefilter);

/// The prefilter V(σ) = 1 + G_c − G_c/G_f = (1 + (T_c − T_f) σ)/(1 + T_c σ) of the fine drive [Bock 3.4.2]. A
/// controller filters the head's setpoints with it and subtracts the coarse axis' position.
struct Prefilter {
  double numerator[2];    ///< coefficients of σ⁰ (without unit) and σ¹ (s)
  double denominator[2];  ///< coefficients of σ⁰ (without unit) and σ¹ (s)
  /// Discrete form y_i = b_0 x_i + b_1 x_{i−1} − a_1 y_{i−1} with one sample per cycle; exact for an x that is linear
  /// between samples.
  double b[2], a1;
};
/// Returns the prefilter for the lags and the cycle time, all in s.
Prefilter prefilter(double coarse_lag, double fine_lag, double cycle_time);

/// Plans with the options' lags and simulates the drives. Throws as
/// search_reference() does.
Expected<RedundancyResult, NoPlan> plan_lag_compensation(const RedundancyTask& task, const RedundancyOptions& options,
                                                         Progress progress);

}  // namespace bahnwerk
