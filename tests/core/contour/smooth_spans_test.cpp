#include "core/contour/blend/smooth_spans.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/blend/smooth_basis.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::blending {
namespace {

TEST(SmoothSpans, AreTheSpline) {
  Random random(11);
  for (const double far : {0.0, 1e5}) {  // mm from the origin
    std::vector<double> breaks{0};
    for (int k = 0; k < 30; ++k) breaks.push_back(breaks.back() + random.uniform(0.05, 0.4));
    TubeSpline spline;
    spline.knots = clamped_knots(breaks);
    for (std::size_t i = 0; i + 1 < breaks.size() + 5; ++i) {
      const double x = 0.2 * static_cast<double>(i);
      spline.points.push_back({far + x, far + random.uniform(-0.1, 0.1), std::sin(x)});
    }
    const SpanPolynomials spans(spline);
    const double size = far + 10;
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
      for (const double x : {0.0, 0.1, 0.5, 0.83, 1.0}) {
        const double h = breaks[k + 1] - breaks[k], t = breaks[k] + x * h;
        const Jet expected = spline.at(k, t);
        const SpanPolynomials::Place found = spans.at(k, t);
        EXPECT_LE(norm(found.value - expected.value), 2e-15 * size) << k << " " << x;
        EXPECT_LE(norm(found.slope - expected.d1), 2e-14 * size / h) << k << " " << x;
      }
  }
}

}  // namespace
}  // namespace bahnwerk::blending
