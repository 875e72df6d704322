/// An exported path against tests/reference/nurbs_joints.py, which shares no code.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <numbers>

#include "core/geometry/spline/link.hpp"
#include "core/geometry/spline/nurbs_path.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "tests/core/geometry/spline/spline_support.hpp"
#include "tests/source.hpp"

namespace bahnwerk {
namespace {

struct Circle {
  double from, to;
  Vec centre;
  double radius;
};

void write(const std::string& file, const NurbsPath& path, std::size_t continuity, const std::vector<Circle>& circles) {
  std::ofstream out(file);
  out.precision(17);
  const auto list = [&](const auto& values) {
    out << '[';
    for (std::size_t i = 0; i < values.size(); ++i) out << (i > 0 ? "," : "") << values[i];
    out << ']';
  };
  out << "{\"degree\":" << path.degree << ",\"points\":[";
  std::vector<double> weights;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    out << (i > 0 ? "," : "");
    list(projected(path.points[i]));
    weights.push_back(path.points[i][spline_dimension]);
  }
  out << "],\"weights\":";
  list(weights);
  out << ",\"knots\":";
  list(path.knots);
  out << ",\"joints\":[";
  for (double u = 1; u < path.end(); ++u)
    out << (u > 1 ? "," : "") << "{\"parameter\":" << u << ",\"continuity\":" << continuity << '}';
  out << "],\"circles\":[";
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const auto& c = circles[i];
    out << (i > 0 ? "," : "") << "{\"from\":" << c.from << ",\"to\":" << c.to << ",\"centre\":[" << c.centre.x << ','
        << c.centre.y << ',' << c.centre.z << "],\"radius\":" << c.radius << '}';
  }
  out << "]}";
}

/// What the independent evaluation returns.
constexpr int as_claimed = 0, not_as_claimed = 3;
int evaluated(const std::string& file) {
  const int status = std::system(("python3 " + test::source("tests/reference/nurbs_joints.py") + " " + file).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// One turn of a stator coil: slot, head, slot, head, with links that swivel the needle past an extra point.
NurbsPath turn(std::size_t k, std::vector<Circle>& circles) {
  const double span = 0.9, inner = 40, outer = 52;
  const auto at = [](double radius, double angle, double z, double phi, double psi) {
    return SplinePoint{radius * std::cos(angle), radius * std::sin(angle), z, phi, psi};
  };
  const auto down = BezierPiece::line(at(inner, 0, 30, 0, 0), at(inner, 0, -30, 0, 0));
  const auto low = spline_arc(at(outer, 0.2, -41, 0.2, 1.5), {}, {0, 0, 1}, span - 0.4, {0, 0, 0, span - 0.4, 0}, k);
  const auto up = BezierPiece::line(at(inner, span, -30, span, 0), at(inner, span, 30, span, 0));
  const auto high =
      spline_arc(at(outer, span - 0.2, 41, span - 0.2, -1.5), {}, {0, 0, -1}, span - 0.4, {0, 0, 0, 0.4 - span, 0}, k);
  const auto one = [&](const SplineJet& from, const SplineJet& to) {
    return link(k, {from, to}, {{1.5, 0.2, 0, 0}, {1.1, -0.3, 0.4, 0}, {}});
  };
  // Through a point that is passed straight on.
  const auto joined = [&](const BezierPiece& a, const BezierPiece& b, const SplinePoint& point,
                          const SplinePoint& way) {
    const SplineJet middle{point, way};
    return std::vector{one(a.at(1), middle), one(middle, b.at(0))};
  };
  std::vector<BezierPiece> pieces{down};
  const auto add = [&](const std::vector<BezierPiece>& more) { pieces.insert(pieces.end(), more.begin(), more.end()); };
  const auto arc = [&](const std::vector<BezierPiece>& more, double z) {
    circles.push_back(
        {static_cast<double>(pieces.size()), static_cast<double>(pieces.size() + more.size()), {0, 0, z}, outer});
    add(more);
  };
  add(joined(down, low.front(), at(46, 0, -41, 0, 1.5), {20, 0, 0, 0, 0}));
  arc(low, -41);
  add(joined(low.back(), up, at(46, span, -41, span, 1.5), at(-20, span, 0, 0, 0)));
  add({up});
  add(joined(up, high.front(), at(46, span, 41, span, -1.5), at(20, span, 0, 0, 0)));
  arc(high, 41);
  return united(pieces);
}

TEST(Export, IndependentEvaluationFindsTheSameJointsAndCircles) {
  for (std::size_t k = 1; k <= 4; ++k) {
    std::vector<Circle> circles;
    const auto path = turn(k, circles);
    const std::string file = ::testing::TempDir() + "spline_path_" + std::to_string(k) + ".json";
    write(file, path, k, circles);
    EXPECT_EQ(evaluated(file), as_claimed) << k;
  }
}

TEST(Export, IndependentEvaluationSeesWhatIsTooMuch) {
  std::vector<Circle> circles;
  const auto path = turn(2, circles);
  const std::string file = ::testing::TempDir() + "spline_path_claims.json";
  write(file, path, 3, circles);
  EXPECT_EQ(evaluated(file), not_as_claimed);
  circles.front().radius += 1e-9;
  write(file, path, 2, circles);
  EXPECT_EQ(evaluated(file), not_as_claimed);
}

}  // namespace
}  // namespace bahnwerk
