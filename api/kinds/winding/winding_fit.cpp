// Checks that the quantities of a spec of kind "winding" fit each other, so that impossible requests are refused before
// planning.
#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "api/kinds/winding/winding_input.hpp"
#include "core/winding/laying/access.hpp"
#include "core/winding/margin.hpp"
#include "core/winding/part/part.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using winding::RotorPart;
using winding::StatorPart;

// With a second number the first one has as many digits as distinguish both.
std::string mm(double length) { return short_number(length) + " mm"; }
std::string mm(double length, double other) { return short_number(length, other) + " mm"; }
std::string newtons(double force, double other) { return short_number(force, other) + " N"; }

class Fit {
 public:
  Fit(const json& spec, const WindingRequest& request, const winding::Slot& slot, Faults& faults)
      : spec_(spec),
        request_(request),
        faults_(faults),
        stator_(std::get_if<StatorPart>(&request.part)),
        clear_(std::visit([&](const auto& part) { return winding::clear_way(part, slot); }, request.part)),
        outer_(request.wire.outer) {}

  void check() {
    opening();
    pull();
    bend();
    if (!stator_) return;
    bore();
    tools();
  }

 private:
  void add(std::vector<std::string> place, std::string message) {
    faults_.push_back({std::move(place), std::move(message)});
  }

  bool given_in(const char* object, const char* member) const {
    return spec_.contains(object) && spec_[object].contains(member) && !spec_[object][member].is_null();
  }
  /// Returns "" if the document gives the value itself.
  const char* usual(const char* object, const char* member) const {
    return given_in(object, member) ? "" : " (the default)";
  }

  /// Compares with the tolerance that the layouts have, as kind fill_factor does.
  static bool exceeds(double size, double clear) { return size > clear + winding::verify_margin; }

  void opening() {
    const double width = request_.needle.width, keep = request_.least_clearance;
    const auto way = [&](double size) {
      return stator_ ? "the slot's clear opening of " + mm(clear_, size) +
                           (stator_->drawn ? "" : " (opening_width less twice tip_corner_radius)")
                     : "the gap of " + mm(clear_, size) + " between the coils of neighbouring poles";
    };
    if (exceeds(outer_, clear_))
      add({"wire"},
          "is " + mm(outer_, clear_) + " overall and does not pass " + way(outer_) + ": a thinner wire is needed");
    if (exceeds(width, clear_)) {
      add({"needle", "width"}, "is " + mm(width, clear_) + usual("needle", "width") + ": the needle does not pass " +
                                   way(width) + ": a narrower needle is needed");
    } else if (const double beside = (clear_ - width) / 2; keep > 0 && exceeds(keep, beside)) {
      add({"needle", "clearance"}, "is " + mm(keep, beside) + ": a needle of " + mm(width) + " leaves " +
                                       mm(beside, keep) + " on either side in " + way(width));
    }
    const std::size_t wires = request_.parallel;
    const double bundle = winding::bundle_diameter(wires, outer_);
    if (!exceeds(width, bundle))
      add({"needle", "width"}, "is " + mm(width, bundle) + usual("needle", "width") + ": " +
                                   (wires > 1 ? "coil.parallel wires of " + mm(outer_) +
                                                    " overall, which are led inside the needle in a "
                                                    "bundle of " +
                                                    (wires > winding::exact_bundle ? "at least " : "") +
                                                    mm(bundle, width) + ", do not run in it"
                                              : "the wire of " + mm(outer_, width) +
                                                    " overall, which is led inside the needle, does not run in it"));
  }

  void pull() {
    const double strength = wire_strength(spec_), bears = winding::breaking_pull(request_.wire, strength),
                 force = request_.tension.force, permitted = request_.tension.permitted;
    const auto wire = [&](double pull) {
      return "a wire of " + mm(request_.wire.copper) + " copper bears " + newtons(bears, pull) + " at " +
             short_number(strength) + " N/mm²";
    };
    if (force > bears)
      add({"pull", "force"}, "is " + newtons(force, bears) + ": " + wire(force) + " (pull.strength) and breaks");
    else if (permitted < force)
      add({"pull", "force"}, "is " + newtons(force, permitted) + ", more than pull.permitted, " +
                                 newtons(permitted, force) + ": set it lower, or permit more");
    if (given_in("pull", "permitted") && permitted > bears)
      add({"pull", "permitted"}, "is " + newtons(permitted, bears) + ": " + wire(permitted) + " (pull.strength)");
    if (const double range = request_.tension.range; range > 0 && range < force)
      add({"pull", "brake_range"}, "is " + newtons(range, force) + ", less than pull.force, " + newtons(force, range) +
                                       ": the brake cannot hold the wire at it");
    const double moment = request_.model.pull.bending_moment,
                 most = winding::bending_moment(request_.wire, strength) * (1 + 1e-9);
    if (given_in("pull", "bending_moment") && moment > most)
      add({"pull", "bending_moment"}, "is " + short_number(moment, most) + " N mm: " + short_number(strength) +
                                          " N/mm² (pull.strength) all over the wire's section make " +
                                          short_number(most, moment) + " N mm");
  }

  void bend() {
    const winding::Pull& pull = request_.model.pull;
    if (pull.bend_radius < outer_)
      add({"pull", "bend_radius"},
          "is " + mm(pull.bend_radius, outer_) + usual("pull", "bend_radius") + ": a wire of " +
              mm(outer_, pull.bend_radius) +
              " overall is not bent in a smaller circle than round a mandrel of its own diameter");
    const double circle = std::max(pull.bend_radius, stretched()), most = turn_height() / 2;
    if (circle >= most)
      add(bends(),
          bend_in_words() + ": a turn is no higher than " + mm(2 * most) + ", its bends are smaller than half");
  }

  /// Returns the height of a turn along the part's axis, mm.
  double turn_height() const {
    return std::visit(
        [](const auto& part) {
          if constexpr (std::is_same_v<std::decay_t<decltype(part)>, StatorPart>)
            return part.heads.stack + 2 * part.heads.tool_height;
          else
            return part.heads.stack + 2 * part.heads.cap_height;
        },
        request_.part);
  }

  /// Returns the radius of the circle in which the wire's stiffness bends it, mm.
  double stretched() const { return request_.model.pull.bending_moment / request_.model.pull.force; }
  std::vector<std::string> bends() const {
    if (stretched() <= request_.model.pull.bend_radius) return {"pull", "bend_radius"};
    return {"pull", given_in("pull", "bending_moment") ? "bending_moment" : "force"};
  }
  std::string bend_in_words() const {
    if (stretched() > request_.model.pull.bend_radius) return "bends the wire in a circle of " + mm(stretched());
    return "is " + mm(request_.model.pull.bend_radius);
  }

  /// Checks that the needle, and the wire between it and its place, fit into the bore.
  void bore() {
    const double bore = winding::bore(*stator_);
    const auto in = [&](double length) {
      return " the bore of " + mm(bore, length) + " (twice base_radius less height)";
    };
    if (request_.needle.length >= bore)
      add({"needle", "length"}, "is " + mm(request_.needle.length, bore) + usual("needle", "length") +
                                    ": the needle does not fit across" + in(request_.needle.length));
    if (request_.swivel_length >= bore)
      add({"machine", "l_tool"}, "is " + mm(request_.swivel_length, bore) + usual("machine", "l_tool") +
                                     ": the swivel's axis lies beyond" + in(request_.swivel_length));
    const winding::Pull& pull = request_.model.pull;
    if (std::max(pull.bend_radius, stretched()) >= bore / 2) {
      add(bends(), bend_in_words() + ": the bend does not fit into half of" + in(0));
    } else if (pull.free_length >= bore) {
      add({"pull", "free_length"},
          "is " + mm(pull.free_length, bore) + ": the free wire does not fit across" + in(pull.free_length));
    }
    const winding::StatorSlot& slot = stator_->slot;
    const double apart = std::abs(stator_->heads.base_radius - slot.base_radius);
    if (apart > slot.liner + 0.01 * slot.base_radius)
      add({"part", "base_radius"}, "is " + mm(stator_->heads.base_radius) + ": the slot's own base_radius is " +
                                       mm(slot.base_radius) + ", and both are of one base, with and without its liner");
  }

  void tools() {
    const winding::StatorHeads& heads = stator_->heads;
    if (request_.tool.height < heads.tool_height)
      add({"tool", "height"}, "is " + mm(request_.tool.height) + ": the wire lies at part.tool_height, " +
                                  mm(heads.tool_height) + ", above the post");
    // Tools stand behind every slot. The default size is never reduced, because the source gives none.
    const double pitch = stator_->pitch(), width = request_.tool.width, thickness = request_.tool.thickness,
                 room = 2 * (heads.tool_radius - thickness) * std::tan(pitch / 2);
    const bool wide = given_in("tool", "width"), thick = given_in("tool", "thickness");
    if (stator_->slots > 2 && width >= room && (wide || thick))
      add({"tool", wide ? "width" : "thickness"}, "is " + mm(wide ? width : thickness) + ": posts of " + mm(width) +
                                                      " behind neighbouring slots meet, they are " +
                                                      mm(std::max(room, 0.0)) + " apart at their inner ends");
  }

  const json& spec_;
  const WindingRequest& request_;
  Faults& faults_;
  const StatorPart* stator_;
  double clear_, outer_;
};

}  // namespace

void check_fit(const json& spec, const WindingRequest& request, const winding::Slot& slot, Faults& faults) {
  Fit(spec, request, slot, faults).check();
}

}  // namespace bahnwerk::api::winding_kind
