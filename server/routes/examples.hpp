#pragma once
/// The machines that a service offers.
#include <string>
#include <vector>

#include "api/documents/examples.hpp"

namespace bahnwerk::server {

/// Returns the shipped machines and those of the JSON files of a folder, sorted by name; a file replaces the shipped
/// machine of its name. A file that is not a machine is logged with its fault and left out. Throws std::runtime_error
/// for a folder that cannot be read; an empty name means that there is none.
std::vector<api::MachineFile> offered_machines(const std::string& folder);

}  // namespace bahnwerk::server
