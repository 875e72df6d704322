#pragma once
/// A winder whose stroke is horizontal: one axis turns the part in a spindle, the other four move the needle [Herrmann
/// 2.3.2, appendix A].
///
/// Axes: q1 shifts across, q2 feed, q3 stroke, mm; q4 turns the spindle, q5 swivels the needle, rad. In a frame
/// that turns with the spindle and has z along its axis, the needle's pose is
///
///   (x, y) = R(−q4) (q2 + l − l cos q5, q1),   z = q3 + z_B − l sin q5,   φ = π − q4,   ψ = q5.
///
/// q5 = 0 gives [Herrmann appendix A], whose machine has no swivel; it may be fitted with one [2.3.2], which leaves the
/// tip in place when the needle does not swivel. A range of q5 from 0 to 0 describes the machine without it.
#include <cmath>

#include "core/machine/formula_kinematics.hpp"

namespace bahnwerk {

/// Sizes, mm; the source gives no values.
struct HorizontalWinderSizes {
  double z_part = 0;   ///< z_B: distance along the spindle from q3 = 0 to the part
  double l_tool = 40;  ///< l_Tool: distance from the swivel's axis to the needle's tip
  PartPlace part;      ///< place of the part in the spindle
};

class HorizontalWinder final : public FormulaKinematics<HorizontalWinder> {
 public:
  static constexpr std::size_t swivel = 4;
  /// `limits` are those of q1 … q5, angles in rad. Throws std::invalid_argument for another count.
  HorizontalWinder(const HorizontalWinderSizes& sizes, const std::vector<Limits>& limits)
      : FormulaKinematics(numbered_axes<5>(limits, {false, false, false, true, true})), sizes_(sizes) {}

  template <class T>
  std::array<T, 5> solve(const NeedleOf<T>& part) const {
    const NeedleOf<T> n = sizes_.part.placed(part);
    const auto [s, c] = sine_cosine(n.phi);
    const auto [swivel_s, swivel_c] = sine_cosine(n.psi);
    const double l = sizes_.l_tool;
    const T forth = c * n.x + s * n.y, aside = c * n.y - s * n.x;  // components along the needle's azimuth and across
    return {-aside, l * swivel_c - T(l) - forth, n.z - T(sizes_.z_part) + l * swivel_s, T(std::numbers::pi) - n.phi,
            n.psi};
  }
  void check(const ToolPose&, const AxisArray&) const {}  // every pose has its axes; their ranges limit the reach
  ToolPose forward(const AxisArray& q) const override {
    const double phi = std::numbers::pi - q[3], c = std::cos(phi), s = std::sin(phi), l = sizes_.l_tool,
                 forth = l * std::cos(q[4]) - l - q[1], aside = -q[0];
    return sizes_.part.taken_back(
        {{c * forth - s * aside, s * forth + c * aside, q[2] + sizes_.z_part - l * std::sin(q[4])}, phi, q[4]});
  }

 private:
  HorizontalWinderSizes sizes_;
};

}  // namespace bahnwerk
