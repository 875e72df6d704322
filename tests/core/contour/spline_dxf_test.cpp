/// Written splines are read back by the reader of drawings, which shares no code with the writer.
#include "core/drawing/spline_dxf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/contour/dxf.hpp"
#include "core/geometry/spline/link.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

/// Piece n of the drawing is span n of the path, parameter included.
void expect_same(const Contour& read, std::size_t first, const NurbsPath& path) {
  const auto spans = static_cast<std::size_t>(path.end() - path.begin());
  ASSERT_LE(first + spans, read.path.size());
  for (std::size_t n = 0; n < spans; ++n) {
    const Curve& curve = read.path[first + n].curve();
    // Lines are read as such, whatever the weights of their ends: only these are compared.
    for (int i = 0; i <= 8; i += path.degree == 1 ? 8 : 1) {
      const double f = i / 8.0, u = path.begin() + static_cast<double>(n) + f;
      const Vec at = curve.at(curve.begin() + f * (curve.end() - curve.begin())).value;
      EXPECT_LT(norm(at - place(path.at(u)[0])), 1e-11) << n << ' ' << f;
    }
  }
}

/// Down a slot, round a winding head, up again.
NurbsPath half_turn(double radius) {
  const double span = 0.9;
  const auto at = [](double r, double angle, double z, double psi) {
    return SplinePoint{r * std::cos(angle), r * std::sin(angle), z, angle, psi};
  };
  const auto down = BezierPiece::line(at(radius, 0, 30, 0), at(radius, 0, -30, 0));
  const auto head = spline_arc(at(52, 0.2, -41, 1.5), {}, {0, 0, 1}, span - 0.4, {0, 0, 0, span - 0.4, 0}, 3);
  const auto up = BezierPiece::line(at(radius, span, -30, 0), at(radius, span, 30, 0));
  std::vector<BezierPiece> pieces{down};
  const auto add = [&](const std::vector<BezierPiece>& more) { pieces.insert(pieces.end(), more.begin(), more.end()); };
  const auto join = [&](const BezierPiece& to) {
    add({link(3, {pieces.back().at(1), to.at(0)}, {{1.5, 0.2, 0, 0}, {1.1, -0.3, 0.4, 0}, {}})});
  };
  join(head.front());
  add(head);
  join(up);
  add({up});
  return united(pieces);
}

TEST(SplineDxf, ReadsBackAsTheSameCurves) {
  const std::vector<NurbsPath> paths{half_turn(40), half_turn(43)};
  ASSERT_EQ(paths[0].degree, 7u);
  const Contour read = read_dxf(splines_as_dxf(paths));
  EXPECT_EQ(read.dimension, 3u);
  EXPECT_TRUE(read.notes.empty()) << read.notes.front();
  expect_same(read, 0, paths[0]);
  // Between both a move.
  expect_same(read, read.path.size() - 5, paths[1]);
  // The arc is exact.
  const Curve& arc = read.path[2].curve();
  for (int i = 0; i <= 20; ++i) {
    const Vec p = arc.at(arc.begin() + i / 20.0 * (arc.end() - arc.begin())).value;
    EXPECT_NEAR(std::hypot(p.x, p.y), 52, 1e-11);
  }
}

TEST(SplineDxf, AnyDegreeAndWeights) {
  Random random(7);
  for (std::size_t degree = 1; degree <= 9; ++degree) {
    std::vector<BezierPiece> pieces;
    HomogeneousPoint last = homogeneous({0, 0, 0, 0, 0}, 1);
    for (int n = 0; n < 6; ++n) {
      std::vector<HomogeneousPoint> points{last};
      for (std::size_t i = 1; i <= degree; ++i)
        points.push_back(homogeneous({30.0 * n + random.uniform(0, 30), random.uniform(-40, 40), random.uniform(-9, 9),
                                      random.uniform(-1, 1), random.uniform(-1, 1)},
                                     degree == 4 ? 1 : std::exp(random.uniform(-2, 2))));
      last = points.back();
      pieces.emplace_back(points);
    }
    const NurbsPath path = united(pieces);
    const std::string text = splines_as_dxf(std::vector<NurbsPath>{path}, "layer_1-b");
    EXPECT_EQ(text.find("\n 41\n", text.find("ENTITIES")) == text.npos, degree == 4) << "weights of 1 are left out";
    DxfOptions options;
    options.layers = {"layer_1-b"};
    const Contour read = read_dxf(text, options);
    expect_same(read, 0, path);
  }
}

TEST(SplineDxf, LayersThatNeedEscapingAreRefused) {
  for (const char* name : {"", "a b", "a\n0\nEOF", "ä"})
    EXPECT_THROW(splines_as_dxf({}, name), std::invalid_argument) << name;
  EXPECT_NE(splines_as_dxf({}).find("AC1015"), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk
