// The spec of kind "contour" → contour, machine, planning.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kinds/contour/contour.hpp"
#include "api/limits_input.hpp"
#include "api/text/base64.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/dxf.hpp"
#include "core/contour/gcode.hpp"
#include "core/contour/polyline.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;
using Place = std::vector<std::string>;

Vec vec(const json& point) {
  Vec v;
  for (std::size_t k = 0; k < point.size(); ++k) v[k] = point[k].get<double>();
  return v;
}

std::vector<Vec> vecs(const json& points) {
  std::vector<Vec> list;
  list.reserve(points.size());
  for (const auto& point : points) list.push_back(vec(point));
  return list;
}

/// Returns the feed, mm/s; infinity if only the axes limit it.
double feed(const json& block) {
  const auto at = block.find("feed");
  return at == block.end() || at->is_null() ? unlimited : at->get<double>();
}

/// Checks, before any geometry is built, that every point has as many coordinates as the first one.
class DimensionCheck {
 public:
  explicit DimensionCheck(std::size_t dimension) : dimension_(dimension) {}

  void point(const json& value, const Place& place) { count(value.size(), "coordinates", place); }
  void points(const json& list, Place place) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (list[i].size() == dimension_) continue;
      place.push_back(std::to_string(i));
      point(list[i], place);
      place.pop_back();
    }
  }
  void segment(const json& segment, const Place& place);
  void fault(Place place, std::string message) {
    if (faults_.size() < max_faults) faults_.push_back({std::move(place), std::move(message)});
  }
  void finish() {
    if (!faults_.empty()) throw InvalidInput(std::move(faults_));
  }

 private:
  static constexpr std::size_t max_faults = 100;
  std::size_t dimension_;
  std::vector<InputFault> faults_;

  void count(std::size_t n, const char* what, const Place& place) {
    if (n != dimension_)
      fault(place,
            "has " + std::to_string(n) + " " + what + ", the contour's first point has " + std::to_string(dimension_));
  }
  static Place below(Place place, std::initializer_list<const char*> inner) {
    place.insert(place.end(), inner.begin(), inner.end());
    return place;
  }
};

void DimensionCheck::segment(const json& segment, const Place& place) {
  const auto member = segment.begin();  // exactly one, says the schema
  const std::string& form = member.key();
  const json& value = member.value();
  if (form == "line") {
    if (value.size() != dimension_) point(value, below(place, {"line"}));
  } else if (form == "arc") {
    for (const char* end : {"to", "center"})
      if (value[end].size() != dimension_) point(value[end], below(place, {"arc", end}));
    if (!value.contains("normal")) return;
    if (dimension_ == 2)
      fault(below(place, {"arc", "normal"}), "only an arc in space has a normal");
    else if (!(norm(vec(value["normal"])) > 1e-9))
      fault(below(place, {"arc", "normal"}), "must not be zero");
  } else if (form == "polynomial") {
    const auto& rows = value["coefficients"];
    if (rows.size() != dimension_) count(rows.size(), "rows", below(place, {"polynomial", "coefficients"}));
  } else if (form == "nurbs") {
    points(value["points"], below(place, {"nurbs", "points"}));
  }
}

void add_segment(ContourBuilder& builder, const json& segment) {
  const auto member = segment.begin();  // exactly one, says the schema
  const std::string& form = member.key();
  const json& value = member.value();
  if (form == "line") {
    builder.line(vec(value));
  } else if (form == "arc") {
    const bool counter_clockwise = value["direction"] == "ccw";
    if (value.contains("normal"))
      builder.arc(vec(value["to"]), vec(value["center"]), counter_clockwise, vec(value["normal"]));
    else
      builder.arc(vec(value["to"]), vec(value["center"]), counter_clockwise);
  } else if (form == "polynomial") {
    auto rows = value["coefficients"].get<std::vector<std::vector<double>>>();
    std::size_t longest = 0;
    for (const auto& row : rows) longest = std::max(longest, row.size());
    for (auto& row : rows) row.resize(longest, 0.0);
    builder.polynomial(rows);
  } else if (form == "dwell") {
    builder.dwell(value.get<double>());
  } else {
    auto points = vecs(value["points"]);
    std::vector<double> weights(points.size(), 1.0);
    if (value.contains("weights")) weights = value["weights"].get<std::vector<double>>();
    builder.nurbs(value["degree"].get<int>(), std::move(points), std::move(weights),
                  value["knots"].get<std::vector<double>>());
  }
}

Contour from_points(const json& contour, Progress progress) {
  const auto& points = contour["points"];
  const std::size_t dimension = points[0].size();
  DimensionCheck check(dimension);
  check.points(points, {"contour", "points"});
  check.finish();
  return polyline(dimension, vecs(points), contour.value("closed", false), feed(contour), progress);
}

Contour from_blocks(const json& contour, Progress progress) {
  const std::size_t dimension = contour["start"].size();
  const auto& blocks = contour["blocks"];
  DimensionCheck check(dimension);
  std::size_t total = 0;
  Place place{"contour", "blocks", "", "segments", ""};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    place[2] = std::to_string(b);
    const auto& segments = blocks[b]["segments"];
    total += segments.size();
    for (std::size_t s = 0; s < segments.size(); ++s) {
      place[4] = std::to_string(s);
      check.segment(segments[s], place);
    }
  }
  if (total > max_segments)
    check.fault({"contour", "blocks"},
                "has " + std::to_string(total) + " segments, at most " + std::to_string(max_segments) + " are allowed");
  check.finish();

  ContourBuilder builder(dimension, vec(contour["start"]));
  constexpr std::size_t segments_per_report = 256;  // units of up to 0.1 ms each
  std::size_t read = 0;
  for (const auto& block : blocks) {
    builder.block(block["mode"] == "cut" ? Mode::cut : Mode::position, feed(block));
    for (const auto& segment : block["segments"]) {
      if (++read % segments_per_report == 0) progress.report("reading", 0);
      add_segment(builder, segment);
    }
  }
  return builder.finish();
}

/// Returns the index of "G54" … "G59.3".
std::size_t work_offset(const std::string& name) {
  const auto digit = [](char c) { return static_cast<std::size_t>(c - '0'); };
  return name.size() > 3 ? 5 + digit(name[4]) : digit(name[2]) - 4;
}

/// Returns tool radii by D number.
std::map<int, double> cutter_radius(const json& document) {
  std::map<int, double> list;
  std::vector<InputFault> faults;
  for (const auto& [number, radius] : document.items()) {
    if (number.empty() || number.size() > 6 || number.find_first_not_of("0123456789") != std::string::npos)
      faults.push_back({{"contour", "cutter_radius", number}, "is not the number of a D word, 0 to 999999"});
    else
      list[std::stoi(number)] = radius.get<double>();
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return list;
}

Contour from_gcode(const json& contour, Progress progress) {
  GcodeOptions options;
  options.feed = feed(contour);
  if (contour.contains("offsets"))
    for (const auto& [name, at] : contour["offsets"].items()) options.work_offsets[work_offset(name)] = vec(at);
  if (contour.contains("reference_points"))
    for (const auto& [name, at] : contour["reference_points"].items())
      (name == "G28" ? options.g28 : options.g30) = vec(at);
  if (contour.contains("cutter_radius")) options.cutter_radius = cutter_radius(contour["cutter_radius"]);
  options.steps = contour.value("steps", options.steps);
  options.absolute_centres = contour.value("arc_centers", "relative") == "absolute";
  options.g70_g71_units = contour.contains("g70_g71");
  if (contour.contains("initial_motion"))
    options.initial_motion = contour["initial_motion"] == "G0" ? GcodeMotion::rapid : GcodeMotion::line;
  options.max_segments = max_segments;
  return read_gcode(contour["gcode"].get_ref<const std::string&>(), options, progress);
}

/// The text "AutoCAD Binary DXF" in base64.
constexpr const char* binary_drawing = "QXV0b0NBRCBCaW5hcnkgRFhG";

Contour from_dxf(const json& contour, Progress progress) {
  DxfOptions options;
  options.feed = feed(contour);
  options.max_curves = max_segments;
  options.tolerance = contour.value("chain", options.tolerance);
  if (contour.value("order", "as_drawn") == "nearest") options.order = DxfOrder::nearest;
  if (contour.contains("layers")) options.layers = contour["layers"].get<std::vector<std::string>>();
  if (contour.contains("unit")) options.millimetres_per_unit = contour["unit"].get<double>();
  options.hatch = contour.value("hatch", "skip") == "cut";
  const std::string& text = contour["dxf"].get_ref<const std::string&>();
  if (!text.starts_with(binary_drawing)) return read_dxf(text, options, progress);
  const auto bytes = from_base64(text);
  if (!bytes) throw InvalidInput({{{"contour", "dxf"}, "line 1: begins as a binary drawing in base64, but is none"}});
  return read_dxf(*bytes, options, progress);
}

}  // namespace

Contour geometry(const json& spec, Progress progress) {
  const auto& contour = spec["contour"];
  if (contour.contains("points")) return from_points(contour, progress);
  if (contour.contains("gcode")) return from_gcode(contour, progress);
  if (contour.contains("dxf")) return from_dxf(contour, progress);
  return from_blocks(contour, progress);
}

Contour geometry(const json& spec) {
  Progress silent;
  return geometry(spec, silent);
}

ContourPlanning planning(const json& spec) {
  ContourPlanning planning;
  if (!spec.contains("planning")) return planning;
  const auto& document = spec["planning"];
  if (document.contains("method"))
    planning.method = value_of<PlanningMethod>(document["method"].get<std::string>(), planning_methods);
  planning.braking_reserve = document.value("braking_reserve", planning.braking_reserve);
  planning.stop_at_mode_change = document.value("mode_change", "pass") == "stop";
  planning.what_if = document.value("what_if", false);
  if (document.contains("machine_study")) {
    const auto& study = document["machine_study"];
    planning.machine_study = study.is_object() || study.get<bool>();
  }
  if (document.contains("corner")) {
    const auto& corner = document["corner"];
    if (corner.contains("angle")) planning.corner_angle = corner["angle"].get<double>() * std::numbers::pi / 180;
    if (corner.value("mode", "stop") == "blend") planning.corner_mode = CornerMode::blend;
    planning.blend_tolerance = corner.value("tolerance", 0.0);
  }
  if (document.contains("path")) {
    planning.along = read_limits(document["path"]);
  }
  return planning;
}

}  // namespace bahnwerk::api::contour
