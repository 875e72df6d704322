#include "core/motion/law/path_motion.hpp"

#include <array>

namespace bahnwerk {

MotionState PathMotion::in_piece(std::size_t piece, double t) const { return driven(piece, along(piece, t)); }

MotionState PathMotion::driven(std::size_t piece, const LawState& x) const {
  const AxisJet q = path_->at(law_.pieces()[piece].segment, x.s);
  const double v2 = x.v * x.v, v3 = v2 * x.v;
  MotionState state;
  for (std::size_t k = 0, n = axes(); k < n; ++k) {  // number by number: copying the array would wait for its stores
    state[0][k] = q.value[k];
    state[1][k] = q.d1[k] * x.v;
    state[2][k] = q.d2[k] * v2 + q.d1[k] * x.a;
    state[3][k] = q.d3[k] * v3 + 3 * x.v * x.a * q.d2[k] + q.d1[k] * x.j;
  }
  return state;
}

void PathMotion::write_driven(std::size_t piece, const LawState& x, double* out) const {
  std::array<double, 4 * max_axes> q;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled as far as it is read
  path_->write_at(law_.pieces()[piece].segment, x.s, q.data());
  const double v2 = x.v * x.v;
  const auto drive = [&](std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      out[k] = q[k];
      out[n + k] = q[n + k] * x.v;
      out[2 * n + k] = q[2 * n + k] * v2 + q[n + k] * x.a;
    }
  };
  switch (axes()) {  // unrolled for the usual machines
    case 2:
      return drive(2);
    case 3:
      return drive(3);
    default:
      return drive(axes());
  }
}

MotionState PathMotion::final_state() const {
  MotionState state;
  if (const std::size_t segments = path_->size(); segments > 0)
    state[0] = path_->at_parameter(segments - 1, (*path_)[segments - 1].curve().end()).value;
  return state;
}

}  // namespace bahnwerk
