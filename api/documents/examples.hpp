#pragma once
/// The job documents and machines that come with the program, and machines of a plant.
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// A job document. A part program or drawing among the examples is one, too, on the laser or, in space, on the mill.
struct Example {
  std::string name;   ///< "bracket", "gear.ngc"
  std::string kind;   ///< kind of the job
  std::string title;  ///< name of the job
  std::string text;   ///< the document
};
/// Returns the examples in the order of their names.
std::span<const Example> examples();
nlohmann::ordered_json examples_document();

/// A machine, to be put into a job document as `spec.machine`.
struct MachineFile {
  std::string name;  ///< "robot"
  std::string kind;  ///< kind of the jobs that it plans: contour or winding
  std::string type;  ///< its kinematics, or its type
  bool own = false;  ///< whether it is the plant's
  std::string text;  ///< the JSON text
};
/// Checks a machine against the schema of its kind. Throws Problem invalid-json or schema-violation.
MachineFile read_machine(std::string_view name, std::string_view text);
/// Returns the machines that come with the program, in the order of their names.
std::vector<MachineFile> shipped_machines();
nlohmann::ordered_json machines_document(std::span<const MachineFile> machines);

}  // namespace bahnwerk::api
