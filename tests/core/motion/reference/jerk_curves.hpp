#pragma once
// The ten curves of jerk.csv with what a direct solution in time found (jerk.py).
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/contour/builder.hpp"
#include "core/machine/machine.hpp"
#include "tests/source.hpp"

namespace bahnwerk::reference {

struct JerkCurve {
  std::string text;
  Contour contour;
  Machine machine;
  double coarse = 0, fine = 0;                           ///< s, with all and with half of the interval
  double expected() const { return 2 * fine - coarse; }  ///< its error falls like the interval
};

inline std::vector<JerkCurve> jerk_curves() {
  std::vector<JerkCurve> curves;
  std::ifstream file(test::source("tests/core/motion/reference/jerk.csv"));
  for (std::string text; std::getline(file, text);) {
    if (text.empty() || text[0] == '#') continue;
    std::vector<double> f;
    std::stringstream fields(text);
    for (std::string x; std::getline(fields, x, ',');) f.push_back(std::stod(x));
    EXPECT_EQ(f.size(), 20u);
    if (f.size() != 20) continue;
    ContourBuilder b(2, {f[0], f[6], 0});
    b.block(Mode::cut, unlimited);
    b.polynomial({{f.begin(), f.begin() + 6}, {f.begin() + 6, f.begin() + 12}});
    JerkCurve curve{text, b.finish(), {}, f[18], f[19]};
    curve.machine.axes = {{"x", f[12], f[14], f[16]}, {"y", f[13], f[15], f[17]}};
    curves.push_back(std::move(curve));
  }
  EXPECT_EQ(curves.size(), 10u);
  return curves;
}

}  // namespace bahnwerk::reference
