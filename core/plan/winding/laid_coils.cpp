#include "core/plan/winding/laid_coils.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

// Number of wires beyond those wound for which the stability of the pile is decided: 400 take about 0.5 s, 1200 about
// 10 s.
constexpr std::size_t most_decided = 400;

InvalidInput fault(std::vector<std::string> place, std::string message) {
  return InvalidInput(std::vector<InputFault>{{std::move(place), std::move(message)}});
}

class Laying {
 public:
  Laying(const WindingRequest& request, WindingPlan& plan, Progress progress)
      : request_(request), plan_(plan), progress_(progress) {}

  template <class Part>
  void lay(const Part& part) {
    const winding::Slot slot = winding::checked_slot(part);
    std::vector<winding::LayingRegions> regions;
    for (const winding::Coil& coil : request_.coils) regions.push_back(winding::coil_regions(part, slot, coil));
    const Progress laying = progress_.part(0, coils_laid).named("layout");
    plan_.layout = winding::needle(regions.front(), request_.wire.radius(), slot.tension_point, laying);
    const std::size_t places = plan_.layout[0].wires.size(), parallel = request_.parallel, most = places / parallel;
    if (places == 0) throw fault({"wire"}, "does not fit into the slot");
    if (most == 0)
      throw fault({"coil", "parallel"}, "are " + std::to_string(parallel) +
                                            " wires in hand; the layout of this wire has places for " +
                                            std::to_string(places));
    if (request_.turns > most)
      throw fault({"coil", "turns"}, "need " + std::to_string(request_.turns * parallel) +
                                         " places; the layout of this wire has " + std::to_string(places));
    plan_.turns = winding::turns_of(regions, plan_.layout, request_.turns > 0 ? request_.turns : most,
                                    request_.wire.radius(), parallel);
    decide_windable(slot);
    if (request_.law == FeedLaw::bspline && plan_.turns.size() > max_spline_turns)
      throw fault({"feed", "law"}, too_many_spline_turns(plan_.turns.size()));
  }

 private:
  /// Decides whether the layout can be wound, as kind fill_factor does.
  void decide_windable(const winding::Slot& slot) {
    const std::size_t wanted = plan_.turns.size() / request_.coils.size() * request_.parallel;
    std::array<winding::Layout, 2> layouts{plan_.layout[0], plan_.layout[2]};
    for (winding::Layout& layout : layouts) {
      const std::size_t count = std::min(layout.wires.size(), std::max(wanted, most_decided));
      layout.wires.resize(count), layout.tension_points.resize(count);
    }
    winding::LaidCoil coil{slot, request_.wire.radius(), layouts[0], slot.tension_point,
                           winding::Needle{request_.needle.width, winding::Needle::Stand::middle, request_.parallel,
                                           request_.model.pivot_limit.has_value()}};
    coil.back = &layouts[1];
    const Progress verdict = progress_.part(coils_laid, coils_laid).named("layout");
    plan_.windable = winding::windable(coil, request_.hold, verdict);
  }

  const WindingRequest& request_;
  WindingPlan& plan_;
  Progress progress_;
};

}  // namespace

void lay_coils(const WindingRequest& request, WindingPlan& plan, Progress progress) {
  std::visit([&](const auto& part) { Laying(request, plan, progress).lay(part); }, request.part);
}

}  // namespace bahnwerk
