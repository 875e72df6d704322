#pragma once
/// Filters of sampled positions that make a coarse axis' motion from the head's.
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Returns a low-pass of a windowed sinc (Hamming): `taps` coefficients that are symmetric and add up to 1, cut-off
/// `cutoff` Hz at `step` s per sample [Bock 3.3, which takes 61 taps, 1 Hz, 1 ms]. Below half a period per window it is
/// the window. `taps` is odd, so the group delay (taps − 1)/2 is whole samples.
std::vector<double> low_pass(std::size_t taps, double cutoff, double step);

/// Σ h_j x_{i + j − D} with D = (taps − 1)/2: without delay. Beyond both ends x stays as it is there. O(n · taps).
std::vector<double> filtered(const std::vector<double>& x, const std::vector<double>& taps);

/// Returns the answer of a first-order lag T y′ + y = x of samples `step` s apart, between which x is linear: exact. y
/// starts at x_0. O(n).
std::vector<double> lagged(const std::vector<double>& x, double time_constant, double step);

}  // namespace bahnwerk
