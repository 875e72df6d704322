#pragma once
/// The methods that find the path's parameter u for every cycle of the controller: u[k+1] from u[k], so that the tip
/// covers the length of the time law in the cycle [Herrmann 3.3.3, 4.4.1].
///
/// exact    u where the arc length is that of the law: the arc length's inverse
/// taylor1  u + v T/|s′|, the first order of (3.108)
/// taylor2  and half of (3.112) T² (printed without the half)
/// quartic  the curve is expanded to second order, numerator and denominator separately (4.65), and the step is the
///           one whose chord has the cycle's length (4.64): the root of a quartic, appendix B
#include "core/base/named.hpp"

namespace bahnwerk {

enum class Interpolator { exact, taylor1, taylor2, quartic };
inline constexpr Named<Interpolator> interpolators[] = {{Interpolator::exact, "exact"},
                                                        {Interpolator::taylor1, "taylor1"},
                                                        {Interpolator::taylor2, "taylor2"},
                                                        {Interpolator::quartic, "quartic"}};

}  // namespace bahnwerk
