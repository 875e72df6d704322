#pragma once
/// A winder whose stroke is vertical: the needle's holder hangs from the frame, the part stands on a turntable that can
/// shift [Herrmann 2.3.1, appendix A].
///
/// Axes: q1 stroke, q2 feed, mm; q3 swivels the needle, q4 turns the table, rad; q5 shifts the table, mm. In a frame
/// that turns with the table and has z upwards from its face, along its axis, the needle's pose is [Herrmann table A.1]
///
///   (x, y) = R(−q4) (q2 − o − l cos q3 − a_lower, a_upper − q5),   z = d_upper − d_lower − q1 − l sin q3,
///   φ = π − q4,   ψ = q3.
#include <cmath>

#include "core/machine/formula_kinematics.hpp"

namespace bahnwerk {

/// Sizes, mm; the source gives no values for o_tool and l_tool, whose defaults are assumed.
struct VerticalWinderSizes {
  double d_upper = 700, a_upper = 500;  ///< upper base: height, and place along the shift
  double d_lower = 100, a_lower = 500;  ///< turntable: height, and place along the feed
  double o_tool = 80;                   ///< o_Tool: distance from the holder's axis to the swivel's
  double l_tool = 40;                   ///< l_Tool: distance from the swivel's axis to the needle's tip
  PartPlace part;                       ///< place of the part on the table
};

class VerticalWinder final : public FormulaKinematics<VerticalWinder> {
 public:
  static constexpr std::size_t swivel = 2;
  /// `limits` are those of q1 … q5, angles in rad. Throws std::invalid_argument for another count.
  VerticalWinder(const VerticalWinderSizes& sizes, const std::vector<Limits>& limits)
      : FormulaKinematics(numbered_axes<5>(limits, {false, false, true, true, false})), sizes_(sizes) {}

  template <class T>
  std::array<T, 5> solve(const NeedleOf<T>& part) const {
    const NeedleOf<T> n = sizes_.part.placed(part);
    const auto [s, c] = sine_cosine(n.phi);
    const auto [swivel_s, swivel_c] = sine_cosine(n.psi);
    const double l = sizes_.l_tool;
    const T forth = c * n.x + s * n.y, aside = c * n.y - s * n.x;  // components along the needle's azimuth and across
    return {T(sizes_.d_upper - sizes_.d_lower) - n.z - l * swivel_s,
            T(sizes_.a_lower + sizes_.o_tool) + l * swivel_c - forth, n.psi, T(std::numbers::pi) - n.phi,
            T(sizes_.a_upper) + aside};
  }
  void check(const ToolPose&, const AxisArray&) const {}  // every pose has its axes; their ranges limit the reach
  ToolPose forward(const AxisArray& q) const override {
    const double phi = std::numbers::pi - q[3], c = std::cos(phi), s = std::sin(phi),
                 forth = sizes_.a_lower + sizes_.o_tool + sizes_.l_tool * std::cos(q[2]) - q[1],
                 aside = q[4] - sizes_.a_upper;
    return sizes_.part.taken_back({{c * forth - s * aside, s * forth + c * aside,
                                    sizes_.d_upper - sizes_.d_lower - q[0] - sizes_.l_tool * std::sin(q[2])},
                                   phi,
                                   q[2]});
  }

 private:
  VerticalWinderSizes sizes_;
};

}  // namespace bahnwerk
