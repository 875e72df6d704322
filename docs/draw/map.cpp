#include "docs/draw/map.hpp"

#include <algorithm>
#include <vector>

namespace bahnwerk::draw {

namespace {

constexpr int colours = 24;
constexpr double step = 0.25;  // mm, at most

}  // namespace

void coloured_cuts(Chart& chart, const Contour& contour, const TimeLaw& law, double fastest, double width) {
  std::vector<bool> cut(contour.path.size());
  for (const Block& block : contour.blocks)
    for (std::size_t i = block.first; i < block.last; ++i) cut[i] = block.mode == Mode::cut;
  // Stretches of one colour, each begun where the last one ended.
  Line stretch;
  int colour = -1;
  const auto flush = [&] {
    if (colour >= 0) chart.line(stretch, {Chart::colour((colour + 0.5) / colours), width, "", 1, true});
  };
  for (const LawPiece& p : law.pieces()) {
    if (!cut[p.segment]) {
      flush();
      stretch.clear();
      colour = -1;
      continue;
    }
    const Segment& segment = contour.path[p.segment];
    const int steps = 1 + static_cast<int>((p.s_end - p.s) / step);
    for (int i = 0; i <= steps; ++i) {
      const LawState at = p.at(p.duration * i / steps);
      const Vec x = segment.at(std::min(std::max(at.s, p.s), p.s_end)).value;
      const int now = std::min(colours - 1, static_cast<int>(at.v / fastest * colours));
      stretch.push_back({x[0], x[1]});
      if (now == colour) continue;
      flush();
      stretch = {{x[0], x[1]}};
      colour = now;
    }
  }
  flush();
}

void plain(Chart& chart, const Contour& contour, const Style& style, const std::string& label) {
  Line line;
  for (std::size_t i = 0; i < contour.path.size(); ++i) {
    const Segment& segment = contour.path[i];
    const int steps = segment.straight() ? 1 : 64;
    for (int j = i == 0 ? 0 : 1; j <= steps; ++j) {
      const Vec x = segment.at(segment.s0() + segment.length() * j / steps).value;
      line.push_back({x[0], x[1]});
    }
  }
  chart.line(line, style, label);
}

}  // namespace bahnwerk::draw
