// Any text either is a drawing or has faults, each with its line; reading never does anything else.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/errors.hpp"
#include "core/contour/dxf.hpp"

namespace {

void demand(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bahnwerk::DxfOptions options;
  options.max_curves = 1'000;
  options.hatch = true;
  if (size > 0 && data[size - 1] % 2 == 1) options.order = bahnwerk::DxfOrder::nearest;
  try {
    const bahnwerk::Contour contour = bahnwerk::read_dxf({reinterpret_cast<const char*>(data), size}, options);
    demand(contour.path.length() > 0 && !contour.blocks.empty());
    demand(contour.blocks.front().first == 0 && contour.blocks.back().last == contour.path.size());
    for (const auto& block : contour.blocks) demand(block.feed > 0 && block.first <= block.last);
    for (std::size_t i = 1; i < contour.path.size(); ++i) {
      const auto &before = contour.path[i - 1].curve(), &after = contour.path[i].curve();
      const bahnwerk::Vec a = before.at(before.end()).value, b = after.at(after.begin()).value;
      // Curves without length may be left out; where a curve turns back, its tangent counts as zero from 1e-12 of its
      // size on, which moves its ends by that much.
      const double extent = norm(a) + norm(b) + contour.path.length();
      demand(norm(a - b) <= 2e-6 + 1e-12 * extent);
    }
  } catch (const bahnwerk::InvalidInput& e) {
    demand(!e.faults.empty() && e.faults.size() <= 100);
    for (const auto& fault : e.faults) {
      demand(fault.place.size() == 2 && fault.place[0] == "contour" && fault.place[1] == "dxf");
      demand(std::string_view(fault.message).substr(0, 5) == "line ");
    }
  }
  return 0;
}
