#pragma once
/// Sine and cosine of one angle at once, of numbers of any kind: each alone takes nearly as long as both.
#include <cmath>

namespace bahnwerk {

template <class T>
struct SineCosine {
  T sine, cosine;
};

inline SineCosine<double> sine_cosine(double angle) { return {std::sin(angle), std::cos(angle)}; }

}  // namespace bahnwerk
