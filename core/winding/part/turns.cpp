#include "core/winding/part/turns.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/errors.hpp"

namespace bahnwerk::winding {

std::vector<int> layers(const std::vector<Point>& wires, double radius, double touch) {
  const double reach = 2 * radius * (1 + touch), square = reach * reach;
  std::vector<int> found;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    int layer = 1;
    for (std::size_t k = 0; k < i; ++k) {
      const Point up = wires[i] - wires[k];
      const double apart = dot(up, up);
      if (apart <= square && up.y > 0 && 4 * up.y * up.y > apart) layer = std::max(layer, found[k] + 1);
    }
    found.push_back(layer);
  }
  return found;
}

std::vector<Turn> turns_of(const std::vector<LayingRegions>& coils, const NeedleLayout& layouts, std::size_t turns,
                           double radius) {
  std::size_t least = layouts[0].wires.size();
  for (const Layout& layout : layouts) least = std::min(least, layout.wires.size());
  if (turns > least) {
    char text[120];
    std::snprintf(text, sizeof text, "the coil has %zu turns, slots and winding heads take %zu", turns, least);
    throw Infeasible(text);
  }
  std::vector<Point> wires(layouts[0].wires.begin(), layouts[0].wires.begin() + static_cast<std::ptrdiff_t>(turns));
  const std::vector<int> layer = layers(wires, radius);
  std::vector<Turn> list;
  list.reserve(coils.size() * turns);
  for (std::size_t coil = 0; coil < coils.size(); ++coil)
    for (std::size_t i = 0; i < turns; ++i) {
      Turn turn{
          .coil = coil, .number = i, .at = {}, .layer = layer[i], .layer_jump = i > 0 && layer[i] != layer[i - 1]};
      for (std::size_t j = 0; j < 4; ++j) {
        const Point place = layouts[j].wires[i];
        // The first slot is entered from the head of the turn before.
        const Point before = j > 0 ? layouts[j - 1].wires[i] : layouts[3].wires[i > 0 ? i - 1 : 0];
        turn.at[j] = {coils[coil].at[j].begin.place(place), coils[coil].at[j].end.place(place),
                      coils[coil].held((j + 3) % 4, before)};
      }
      list.push_back(turn);
    }
  return list;
}

}  // namespace bahnwerk::winding
