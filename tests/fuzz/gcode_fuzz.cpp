// Any text either is a part program or has faults, each with its line; reading never does anything else.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/errors.hpp"
#include "core/contour/gcode.hpp"

namespace {

void demand(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bahnwerk::GcodeOptions options;
  options.max_segments = 2'000;
  options.steps = 2'000;
  options.cutter_radius = {{1, 2.0}, {2, -0.5}, {3, 0.01}};
  options.work_offsets[1] = bahnwerk::Vec{10, 20, 1};
  options.g30 = bahnwerk::Vec{0, 0, 50};
  try {
    const bahnwerk::Contour contour = bahnwerk::read_gcode({reinterpret_cast<const char*>(data), size}, options);
    demand(contour.path.length() > 0 && !contour.blocks.empty());
    demand(contour.blocks.front().first == 0 && contour.blocks.back().last == contour.path.size());
    for (std::size_t i = 0; i < contour.blocks.size(); ++i) {
      const auto& block = contour.blocks[i];
      // A block may hold nothing but dwells, where a switch comes between two of them.
      const bool dwells = std::any_of(contour.rests.begin(), contour.rests.end(),
                                      [&](const bahnwerk::Rest& rest) { return rest.block == i; });
      demand(block.feed > 0 && block.first <= block.last && (block.first < block.last || dwells));
    }
    // It never jumps.
    for (std::size_t i = 1; i < contour.path.size(); ++i) {
      const auto &before = contour.path[i - 1].curve(), &after = contour.path[i].curve();
      const bahnwerk::Vec end = before.at(before.end()).value, begin = after.at(after.begin()).value;
      demand(norm(end - begin) <= 1e-6 + 1e-9 * (norm(end) + contour.path[i - 1].length() + contour.path[i].length()));
    }
  } catch (const bahnwerk::InvalidInput& e) {
    demand(!e.faults.empty() && e.faults.size() <= 100);
    for (const auto& fault : e.faults) {
      demand(fault.place.size() == 2 && fault.place[1] == "gcode");
      demand(std::string_view(fault.message).substr(0, 5) == "line ");
    }
  }
  return 0;
}
