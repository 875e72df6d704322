#pragma once
/// What the fine axes do: the head's motion less that of the coarse axes.
#include <memory>
#include <utility>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk::test {

inline std::shared_ptr<const Motion> fine_motion(std::shared_ptr<const Motion> head, const Motion& coarse) {
  std::vector<SplineMotion::Piece> opposite(coarse.pieces());
  for (std::size_t i = 0; i < coarse.pieces(); ++i) {
    opposite[i].end = coarse.end(i);
    for (std::size_t k = 0; k < coarse.axes(); ++k) {
      Polynomial p;
      coarse.polynomial(i, k, p);
      opposite[i].axes.push_back(-1.0 * p);
    }
  }
  return std::make_shared<const SumOfMotions>(std::move(head),
                                              std::make_shared<const SplineMotion>(std::move(opposite)));
}

}  // namespace bahnwerk::test
