#include "api/kinds/fill_factor/fill_factor.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "api/kinds/kind_frame.hpp"
#include "api/slot/windable_result.hpp"
#include "api/verification.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/plan/fill_drawings.hpp"

namespace bahnwerk::api::fill_factor {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json point(Point p) { return {p.x, p.y}; }

/// Returns points of the slot's coordinates in those of the document.
ordered_json points(std::span<const Point> list, const winding::Placement& at) {
  ordered_json out = ordered_json::array();
  for (const Point& p : list) out.push_back(point(at.place(p)));
  return out;
}

/// Returns the edges in order, each from the end of the one before; an edge with "from" begins a loop.
ordered_json outline(const Region& region, const winding::Placement& at) {
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < region.edges().size(); ++i) {
    const Edge& edge = region.edges()[i];
    ordered_json piece = ordered_json::object();
    if (region.begins_loop(i)) piece["from"] = point(at.place(edge.from));
    if (edge.straight()) {
      piece["line"] = point(at.place(edge.to));
    } else {
      piece["arc"] = {{"to", point(at.place(edge.to))},
                      {"center", point(at.place(edge.centre))},
                      {"direction", edge.turn > 0 ? "ccw" : "cw"}};
    }
    list.push_back(std::move(piece));
  }
  return list;
}

ordered_json wire(const winding::Wire& wire) {
  return {{"copper", wire.copper}, {"outer", wire.outer}, {"tolerance", wire.tolerance}};
}

ordered_json spread(const FilledLayout& filled) {
  std::map<std::size_t, std::size_t> often;
  double sum = 0;
  for (const std::size_t count : filled.sampled) {
    ++often[count];
    sum += static_cast<double>(count);
  }
  ordered_json histogram = ordered_json::array();
  for (const auto& [count, times] : often) histogram.push_back({{"count", count}, {"samples", times}});
  return {{"samples", filled.sampled.size()},
          {"least", often.begin()->first},
          {"mean", sum / static_cast<double>(filled.sampled.size())},
          {"most", often.rbegin()->first},
          {"histogram", std::move(histogram)}};
}

ordered_json layout(const FilledLayout& filled, double slot_area, const winding::Placement& drawn) {
  const auto& turns = filled.turns;
  ordered_json out = {{"algorithm", name(filled.algorithm)},
                      {"wire", wire(filled.wire)},
                      {"count", filled.count()},
                      {"bound", filled.bound},
                      {"electrical_fill", filled.electrical},
                      {"mechanical_fill", filled.mechanical},
                      {"allowed_overlap", filled.overlap},
                      {"max_overlap", filled.overlaps.deepest},
                      {"total_overlap_area", filled.overlaps.area},
                      {"producible", filled.can_be_wound()},
                      {"blocked_by", blocked_by(filled.windable, filled.wanted())},
                      {"slips", slips(filled.windable, filled.wanted())},
                      {"windable", windable(filled.windable, turns.parallel, filled.count())},
                      {"turns",
                       {{"serial", turns.serial},
                        {"parallel", turns.parallel},
                        {"wires", turns.wires},
                        {"loss", turns.fits ? ordered_json(turns.loss) : ordered_json(nullptr)},
                        {"fits", turns.fits},
                        {"electrical_fill", electrical_fill(turns.wires, filled.wire, slot_area)}}},
                      {"resistance_per_metre", filled.resistance},
                      {"positions", points(filled.layout.wires, drawn)}};
  if (!filled.layout.tension_points.empty()) out["pulls"] = points(filled.layout.tension_points, drawn);
  if (!filled.regions.empty()) {
    ordered_json regions = ordered_json::object();
    for (std::size_t k = 0; k < filled.regions.size(); ++k) {
      const winding::Placement at = k == 1 ? drawn : winding::Placement{};  // the other regions are heads
      regions[region_name(k)] = {{"positions", points(filled.regions[k].wires, at)},
                                 {"pulls", points(filled.regions[k].tension_points, at)}};
    }
    out["regions"] = std::move(regions);
  }
  if (!filled.sampled.empty()) out["robustness"] = spread(filled);
  return out;
}

ordered_json drawings(const FillRequest& request, const FillPlan& plan, Progress progress) {
  ordered_json out = ordered_json::object();
  for (const std::size_t best : plan.best) {
    const FilledLayout& filled = plan.layouts[best];
    progress.report("drawing", 1);
    out[std::string(name(filled.algorithm)) + ".svg"] = layout_drawing(request, filled);
  }
  if (request.wires.size() > 1) out["fill_factors.svg"] = fill_factor_chart(plan, "Fill factors of the slot");
  return out;
}

ordered_json summary(const FilledLayout& filled) {
  return {{"algorithm", name(filled.algorithm)},
          {"wire", wire(filled.wire)},
          {"count", filled.count()},
          {"electrical_fill", filled.electrical},
          {"mechanical_fill", filled.mechanical},
          {"producible", filled.can_be_wound()},
          {"windable", windable(filled.windable, filled.turns.parallel, filled.count())}};
}

/// Returns the best layout that can be wound and holds the requested turns.
ordered_json best_producible(const FillPlan& plan) {
  const FilledLayout* best = nullptr;
  for (const FilledLayout& filled : plan.layouts)
    if (filled.can_be_wound() && filled.count() > 0 && filled.turns.fits &&
        (!best || filled.electrical > best->electrical))
      best = &filled;
  return best ? summary(*best) : ordered_json(nullptr);
}

struct Asked {
  FillRequest fill;
  bool drawings = true;
};

ordered_json details(const Asked& asked, const FillPlan& plan, Progress progress) {
  const winding::Slot& given = asked.fill.slot;
  const double area = given.iron.area();  // area of all coil sides
  ordered_json layouts = ordered_json::array(), best = ordered_json::array();
  for (const FilledLayout& filled : plan.layouts) {
    progress.report("writing", 1);
    layouts.push_back(layout(filled, area / static_cast<double>(asked.fill.sides), asked.fill.drawn));
  }
  for (const std::size_t i : plan.best) best.push_back(summary(plan.layouts[i]));
  ordered_json slot = {{"area", area},
                       {"room_area", given.usable_area.area()},
                       {"outline", outline(given.iron, asked.fill.drawn)},
                       {"room", outline(given.usable_area, asked.fill.drawn)}};
  if (given.opening) slot["clear_opening"] = given.opening->clear;
  if (!given.taken.empty()) slot["taken"] = outline(given.taken, asked.fill.drawn);
  return {{"slot", std::move(slot)}, {"best", std::move(best)}, {"layouts", std::move(layouts)}};
}

struct FillFactorKind {
  static constexpr std::string_view name = "fill_factor";
  static constexpr std::string_view title = "How many round wires a slot takes, by winding styles";

  static Asked read(const json& spec, Progress progress) {
    return {request(spec, progress), spec.value("drawings", true)};
  }

  static PlanningTime expected_time(const Asked& asked) {
    const FillRequest& fill = asked.fill;
    const bool sampled = fill.sampling.samples > 0;
    return {bahnwerk::expected_time(fill), sampled ? "/spec/robustness/samples" : "/spec",
            std::string(sampled ? "robustness.samples, " : "") +
                "the number of wires, and effort for the algorithm potential, shorten it in proportion"};
  }

  static FillPlan plan(const Asked& asked, Progress progress) { return plan_fill(asked.fill, progress); }

  static KindReport report(const Asked& asked, const FillPlan& plan, Progress progress) {
    KindReport out;
    out.summary = summary(plan.layouts[plan.top]);
    out.summary["best_producible"] = best_producible(plan);
    out.verification = verification(plan.verification, "mm");  // places are wires, named by their diameter
    out.bound = bound(plan.bound);
    out.details = details(asked, plan, progress);
    if (asked.drawings) out.drawings = drawings(asked.fill, plan, progress);
    return out;
  }
};

}  // namespace
}  // namespace bahnwerk::api::fill_factor

namespace bahnwerk::api {
Kind describe_fill_factor() { return kind_of<fill_factor::FillFactorKind>(); }
}  // namespace bahnwerk::api
