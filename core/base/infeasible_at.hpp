#pragma once
/// No motion satisfies the limits, and it is known which members of the document are in the way.
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk {

struct InfeasibleAt : Infeasible {
  InfeasibleAt(const std::string& what, std::vector<InputFault> list) : Infeasible(what), faults(std::move(list)) {}
  std::vector<InputFault> faults;  ///< one at least; places as those of InvalidInput
};

}  // namespace bahnwerk
