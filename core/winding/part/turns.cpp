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

namespace {

/// Returns the mean of the places of turn `i`.
Point middle(const Layout& layout, std::size_t i, std::size_t parallel) {
  Point sum{};
  for (std::size_t k = i * parallel; k < (i + 1) * parallel; ++k) sum = sum + layout.wires[k];
  return (1 / static_cast<double>(parallel)) * sum;
}

}  // namespace

std::vector<Turn> turns_of(const std::vector<LayingRegions>& coils, const NeedleLayout& layouts, std::size_t turns,
                           double radius, std::size_t parallel) {
  std::size_t least = layouts[0].wires.size();
  for (const Layout& layout : layouts) least = std::min(least, layout.wires.size());
  if (parallel == 0 || turns > least / parallel) {
    char text[120];
    std::snprintf(text, sizeof text, "the coil has %zu turns of %zu wires, slots and winding heads take %zu wires",
                  turns, parallel, least);
    throw Infeasible(text);
  }
  const std::vector<int> wire_layer = layers(layouts[0].wires, radius);
  // The layer of a turn with several wires in hand is that of its first wire.
  const auto layer = [&](std::size_t turn) { return wire_layer[turn * parallel]; };
  std::vector<Turn> list;
  list.reserve(coils.size() * turns);
  for (std::size_t coil = 0; coil < coils.size(); ++coil)
    for (std::size_t i = 0; i < turns; ++i) {
      Turn turn{
          .coil = coil, .number = i, .at = {}, .layer = layer(i), .layer_jump = i > 0 && layer(i) != layer(i - 1)};
      for (std::size_t j = 0; j < 4; ++j) {
        const Point place = middle(layouts[j], i, parallel);
        // The first slot is entered from the winding head of the turn before.
        const Point before =
            j > 0 ? middle(layouts[j - 1], i, parallel) : middle(layouts[3], i > 0 ? i - 1 : 0, parallel);
        turn.at[j] = {coils[coil].at[j].begin.place(place), coils[coil].at[j].end.place(place),
                      coils[coil].held((j + 3) % 4, before)};
      }
      list.push_back(turn);
    }
  return list;
}

}  // namespace bahnwerk::winding
