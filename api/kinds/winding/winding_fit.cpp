// Whether the quantities of a spec of kind "winding" fit each other: what no plan could do is refused before planning.
#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

#include "api/kinds/winding/winding_input.hpp"
#include "core/winding/part/part.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using winding::RotorPart;
using winding::StatorPart;

std::string mm(double length) { return short_number(length) + " mm"; }
std::string newtons(double force) { return short_number(force) + " N"; }

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
  /// "" where the document says the value itself.
  const char* usual(const char* object, const char* member) const {
    return given_in(object, member) ? "" : " (the default)";
  }

  void opening() {
    const std::string way = stator_ ? "the slot's clear opening of " + mm(clear_) +
                                          (stator_->drawn ? "" : " (opening_width less twice tip_corner_radius)")
                                    : "the gap of " + mm(clear_) + " between the coils of neighbouring poles";
    const double width = request_.needle.width, keep = request_.least_clearance;
    if (outer_ > clear_)
      add({"wire"}, "is " + mm(outer_) + " overall and does not pass " + way + ": a thinner wire is needed");
    if (width > clear_) {
      add({"needle", "width"}, "is " + mm(width) + usual("needle", "width") + ": the needle does not pass " + way +
                                   ": a narrower needle is needed");
    } else if (keep > 0 && width + 2 * keep > clear_) {
      add({"needle", "clearance"}, "is " + mm(keep) + ": a needle of " + mm(width) + " leaves " +
                                       mm((clear_ - width) / 2) + " on either side in " + way);
    }
    if (outer_ >= width)
      add({"needle", "width"}, "is " + mm(width) + usual("needle", "width") + ": the wire of " + mm(outer_) +
                                   " overall, which is led inside the needle, does not run in it");
  }

  void pull() {
    const double strength = wire_strength(spec_), bears = winding::breaking_pull(request_.wire, strength),
                 force = request_.tension.force, permitted = request_.tension.permitted;
    const std::string wire = "a wire of " + mm(request_.wire.copper) + " copper bears " + newtons(bears) + " at " +
                             short_number(strength) + " N/mm²";
    if (force > bears)
      add({"pull", "force"}, "is " + newtons(force) + ": " + wire + " (pull.strength) and breaks");
    else if (permitted < force)
      add({"pull", "force"}, "is more than pull.permitted: set it lower, or permit more");
    if (given_in("pull", "permitted") && permitted > bears)
      add({"pull", "permitted"}, "is " + newtons(permitted) + ": " + wire + " (pull.strength)");
    if (request_.tension.range > 0 && request_.tension.range < force)
      add({"pull", "brake_range"},
          "is less than pull.force, " + newtons(force) + ": the brake cannot hold the wire at it");
    const double moment = request_.model.pull.bending_moment,
                 most = winding::bending_moment(request_.wire, strength) * (1 + 1e-9);
    if (given_in("pull", "bending_moment") && moment > most)
      add({"pull", "bending_moment"}, "is " + short_number(moment) + " N mm: " + short_number(strength) +
                                          " N/mm² (pull.strength) all over the wire's section make " +
                                          short_number(most) + " N mm");
  }

  void bend() {
    const winding::Pull& pull = request_.model.pull;
    if (pull.bend_radius < outer_)
      add({"pull", "bend_radius"},
          "is " + mm(pull.bend_radius) + usual("pull", "bend_radius") + ": a wire of " + mm(outer_) +
              " overall is not bent in a smaller circle than round a mandrel of its own diameter, " + mm(outer_));
  }

  /// The needle, and the wire between it and its place, stand across the bore.
  void bore() {
    const double bore = winding::bore(*stator_);
    const std::string in = " the bore of " + mm(bore) + " (twice base_radius less height)";
    if (request_.needle.length >= bore)
      add({"needle", "length"},
          "is " + mm(request_.needle.length) + usual("needle", "length") + ": the needle does not fit across" + in);
    if (request_.swivel_length >= bore)
      add({"machine", "l_tool"},
          "is " + mm(request_.swivel_length) + usual("machine", "l_tool") + ": the swivel's axis lies beyond" + in);
    const winding::Pull& pull = request_.model.pull;
    const double stretched = pull.bending_moment / pull.force;
    if (std::max(pull.bend_radius, stretched) >= bore / 2) {
      const bool moment = stretched > pull.bend_radius;
      add({"pull", moment ? (given_in("pull", "bending_moment") ? "bending_moment" : "force") : "bend_radius"},
          (moment ? "bends the wire in a circle of " + mm(stretched) : "is " + mm(pull.bend_radius)) +
              ": the bend does not fit into half of" + in);
    } else if (pull.free_length >= bore) {
      add({"pull", "free_length"}, "is " + mm(pull.free_length) + ": the free wire does not fit across" + in);
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
