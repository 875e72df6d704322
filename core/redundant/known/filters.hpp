#pragma once
/// Linear filters of sampled positions.
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Returns the coefficients of a low-pass filter, a sinc with a Hamming window: `taps` symmetric coefficients that sum
/// up to 1, with the cut-off `cutoff`, Hz, for samples `step` s apart [Bock 3.3 takes 61 taps, 1 Hz, 1 ms]. If the
/// cut-off is below half a period per window, the filter is the window itself. `taps` must be odd, so that the group
/// delay (taps − 1)/2 is a whole number of samples.
std::vector<double> low_pass(std::size_t taps, double cutoff, double step);

/// Returns the filtered samples without delay, y_i = Σ h_j x_{i + j − D} with D = (taps − 1)/2. Beyond both ends x is
/// constant. O(n · taps).
std::vector<double> filtered(const std::vector<double>& x, const std::vector<double>& taps);

/// Returns the response y of the first-order lag T y′ + y = x at the sample times, which are `step` s apart, with y =
/// x_0 at first. It is exact for an x that is linear between samples. O(n).
std::vector<double> lagged(const std::vector<double>& x, double time_constant, double step);

}  // namespace bahnwerk
