// The same random contour, written in every style a program may have: absolute or incremental, mm or inches, arcs by
// centre or by radius. All have to be read as the same curve.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/numeric/random.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

struct Style {
  bool incremental, inch, radius, absolute_centre;
};

struct Piece {
  Vec to, centre;
  bool arc = false, counter_clockwise = false;
  double radius = 0, sweep = 0;
};

/// Lines, arcs and helices end to end, in mm.
std::vector<Piece> contour(Random& random) {
  std::vector<Piece> pieces;
  Vec at{10, 20, 0};
  for (int i = 0; i < 20; ++i) {
    Piece piece;
    if (random.chance(0.5)) {
      piece.to = {random.uniform(-100, 100), random.uniform(-100, 100), at.z};
    } else {
      piece.arc = true;
      piece.counter_clockwise = random.chance(0.5);
      piece.radius = random.uniform(1, 80);
      // Away from half and whole turns, where R alone cannot tell the centre well.
      piece.sweep = random.chance(0.5) ? random.uniform(0.2, 2.9) : random.uniform(3.4, 6.0);
      const double begin = random.uniform(0, 2 * std::numbers::pi);
      const double end = begin + (piece.counter_clockwise ? piece.sweep : -piece.sweep);
      piece.centre = at - piece.radius * Vec{std::cos(begin), std::sin(begin), 0};
      piece.to = piece.centre + piece.radius * Vec{std::cos(end), std::sin(end), 0};
      piece.to.z = at.z + (random.chance(0.3) ? random.uniform(-5, 5) : 0);
    }
    at = piece.to;
    pieces.push_back(piece);
  }
  return pieces;
}

std::string written(const std::vector<Piece>& pieces, Style style) {
  std::string text = "G21 G90 G0 X10 Y20 Z0\n";
  text += style.inch ? "G20 " : "G21 ";
  text += style.incremental ? "G91 " : "G90 ";
  text += style.absolute_centre ? "G90.1\n" : "G91.1\n";
  char line[256];
  Vec at{10, 20, 0};
  for (const Piece& piece : pieces) {
    const double scale = style.inch ? 1 / 25.4 : 1;
    const Vec to = scale * (style.incremental ? piece.to - at : piece.to);
    const Vec centre = scale * (style.absolute_centre ? piece.centre : piece.centre - at);
    std::snprintf(line, sizeof line, "%s X%.12f Y%.12f Z%.12f",
                  piece.arc ? piece.counter_clockwise ? "G3" : "G2" : "G1", to.x, to.y, to.z);
    text += line;
    if (piece.arc && style.radius)
      std::snprintf(line, sizeof line, " R%.12f\n", scale * (piece.sweep > std::numbers::pi ? -1 : 1) * piece.radius);
    else if (piece.arc)
      std::snprintf(line, sizeof line, " I%.12f J%.12f\n", centre.x, centre.y);
    else
      std::snprintf(line, sizeof line, "\n");
    text += line;
    at = piece.to;
  }
  return text;
}

TEST(GcodeStyles, AllStylesGiveOneContour) {
  Random random(7);
  for (int run = 0; run < 200; ++run) {
    const auto pieces = contour(random);
    for (unsigned bits = 0; bits < 16; ++bits) {
      const Style style{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
      const Contour c = read_gcode(written(pieces, style));
      ASSERT_EQ(c.path.size(), pieces.size());
      Vec at{10, 20, 0};
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const Vec way = piece.to - at;
        const double length = piece.arc ? std::hypot(piece.radius * piece.sweep, way.z) : norm(way);
        // Twelve decimals; R tells the centre only to their square root near half a turn.
        ASSERT_NEAR(c.path[i].length(), length, 1e-8) << written(pieces, style) << i;
        ASSERT_LT(norm(end_of(c.path[i]) - piece.to), 1e-9);
        if (piece.arc) {
          ASSERT_NEAR(arc_of(c.path[i]).sweep(), piece.counter_clockwise ? piece.sweep : -piece.sweep, 1e-8);
        }
        at = piece.to;
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk
