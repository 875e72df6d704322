#pragma once
/// Motion laws of cams for tests.
#include <numbers>

#include "core/cam/classical/classical_sections.hpp"
#include "core/cam_profile/follower_law.hpp"

namespace bahnwerk::cam::test {

/// Rise, dwell, return and dwell by one classical law, angles in deg; a dwell of 0 deg is none.
inline CamLaw rise_and_return(ClassicalLaw law, double stroke, double rise, double dwell, double back, double rest) {
  std::vector<double> breaks;
  std::vector<LawPiece> pieces;
  double at = 0;
  std::size_t section = 0;
  const auto add = [&](double angle, double from, double to, ClassicalLaw which) {
    if (angle <= 0) return;
    const auto given = classical_section(which, {}, at / 360, (at + angle) / 360, {{from}, {to}});
    for (std::size_t i = 0; i < given.bernstein.size(); ++i)
      breaks.push_back(given.breaks[i]), pieces.push_back({section, given.bernstein[i]});
    at += angle, ++section;
  };
  add(rise, 0, stroke, law), add(dwell, stroke, stroke, ClassicalLaw::straight);
  add(back, stroke, 0, law), add(rest, 0, 0, ClassicalLaw::straight);
  breaks.push_back(at / 360);
  return {std::move(breaks), std::move(pieces), true};
}
inline constexpr double deg = std::numbers::pi / 180;

}  // namespace bahnwerk::cam::test
