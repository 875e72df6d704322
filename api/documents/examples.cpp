#include "api/documents/examples.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/kind.hpp"
#include "api/problem.hpp"
#include "api/schema/embedded.hpp"
#include "api/schema/schema.hpp"
#include "api/text/json_text.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view machines_folder = "machines/";
constexpr std::string_view in_space = "thread.ngc";  // the one program that moves z

std::string last_name(std::string_view path) {
  const auto slash = path.rfind('/');
  return std::string(slash == path.npos ? path : path.substr(slash + 1));
}

std::string_view example_text(std::string_view path) {
  for (const EmbeddedFile& file : embedded_examples())
    if (file.name == path) return file.text;
  return {};
}

Example example(const EmbeddedFile& file) {
  Example out;
  out.name = last_name(file.name);
  const bool program = out.name.ends_with(".ngc"), drawing = out.name.ends_with(".dxf");
  if (!program && !drawing) {
    out.text = file.text;
  } else {
    ordered_json document = ordered_json::parse(example_text(out.name == in_space ? "parts/mill" : "parts/laser"));
    document["name"] = out.name;
    document["reference"] = out.name;
    document["spec"]["contour"] = {{program ? "gcode" : "dxf", file.text}};
    out.text = document.dump(2);
  }
  const ordered_json document = ordered_json::parse(out.text);
  out.kind = document.at("kind");
  out.title = document.value("name", out.name);
  return out;
}

template <class T>
void sort_by_name(std::vector<T>& list) {
  std::sort(list.begin(), list.end(), [](const T& a, const T& b) { return a.name < b.name; });
}

/// Returns the schema of `spec.machine` of a kind.
Schema machine_schema(const char* kind) {
  ordered_json schema = ordered_json::parse(embedded(kind));
  ordered_json machine = schema["properties"]["machine"];
  machine["$schema"] = schema["$schema"];
  if (schema.contains("$defs")) machine["$defs"] = schema["$defs"];
  return Schema(machine.dump());
}

}  // namespace

std::span<const Example> examples() {
  static const std::vector<Example> list = [] {
    std::vector<Example> all;
    for (const EmbeddedFile& file : embedded_examples())
      if (!file.name.starts_with(machines_folder)) all.push_back(example(file));
    sort_by_name(all);
    return all;
  }();
  return list;
}

ordered_json examples_document() {
  ordered_json list = ordered_json::array();
  for (const Example& each : examples())
    list.push_back({{"name", each.name},
                    {"kind", each.kind},
                    {"title", each.title},
                    {"bytes", each.text.size()},
                    {"document", "/v1/examples/" + each.name}});
  return {{"examples", std::move(list)}};
}

MachineFile read_machine(std::string_view name, std::string_view text) {
  static const Schema contour = machine_schema("contour");
  static const Schema winding = machine_schema("winding");
  const nlohmann::json machine = parse_json(text);
  const bool winds = machine.is_object() && machine.contains("type");
  if (auto errors = (winds ? winding : contour).validate(machine); !errors.empty()) {
    std::string detail = summary(errors, Schema::max_faults);
    throw Problem("schema-violation", detail, std::move(errors));
  }
  return {std::string(name), winds ? "winding" : "contour", machine.at(winds ? "type" : "kinematics"), false,
          std::string(text)};
}

std::vector<MachineFile> shipped_machines() {
  std::vector<MachineFile> all;
  for (const EmbeddedFile& file : embedded_examples())
    if (file.name.starts_with(machines_folder)) all.push_back(read_machine(last_name(file.name), file.text));
  sort_by_name(all);
  return all;
}

ordered_json machines_document(std::span<const MachineFile> machines) {
  ordered_json list = ordered_json::array();
  for (const MachineFile& each : machines)
    list.push_back({{"name", each.name},
                    {"kind", each.kind},
                    {"type", each.type},
                    {"own", each.own},
                    {"document", "/v1/machines/" + each.name}});
  return {{"machines", std::move(list)}};
}

}  // namespace bahnwerk::api
