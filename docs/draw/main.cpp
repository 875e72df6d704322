// draw DIR            writes the documentation's pictures into DIR
// draw --convergence  prints the tables of docs/methods/contour.md: duration over the angle of the grid
// draw --fill         prints the table of docs/methods/fill_factor.md: wires by every algorithm
#include <cstdio>
#include <exception>
#include <string>

#include "docs/draw/pictures.hpp"

namespace {

void run(const std::string& what) {
  using namespace bahnwerk::draw;
  if (what == "--convergence") return convergence_tables();
  if (what == "--fill") return fill_table();
  speeds_on_circle(what + "/speed_circle.svg");
  speeds_on_window(what + "/speed_window.svg");
  bracket_in_colour(what + "/bracket.svg");
  use_on_window(what + "/axis_use.svg");
  machines_along_the_bracket(what + "/contour_machines.svg");
  straight_moves(what + "/straight_moves.svg");
  plate_in_colour(what + "/plate.svg");
  use_on_plate(what + "/plate_use.svg");
  corner_enlarged(what + "/corner_blend.svg");
  fill_pictures(what);
  needle_access(what + "/needle_access.svg");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw DIR | draw --convergence | draw --fill\n");
    return 2;
  }
  try {
    run(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
