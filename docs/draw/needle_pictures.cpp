// The pictures of docs/methods/winding_path.md.
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/base/progress.hpp"
#include "core/winding/drawing/clearance_drawing.hpp"
#include "docs/draw/pictures.hpp"

namespace bahnwerk::draw {

void needle_access(const std::string& file) {
  using namespace winding;
  // With the sizes that [Herrmann Fig. 4.16] names: 2.6 mm in an opening of 3.1 mm.
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const NeedleShape needle{2.6, 60};
  Progress silent;
  const double step = 0.1;
  const std::vector<DrawnClearance> maps{
      {"needle along the radius", clearance_map(part, slot, needle, std::nullopt, step, silent)},
      {"pivot shift up to 20°", clearance_map(part, slot, needle, 20 * std::numbers::pi / 180, step, silent)}};
  std::ofstream out(file, std::ios::binary);
  out << clearance_drawing(StatorIron(part, slot), maps, "Clearance of a needle of 2.6 mm by the place of its tip");
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file);
}

}  // namespace bahnwerk::draw
