#pragma once
/// The error of a task without a solution whose cause is known: it names the members of the document that exclude
/// every motion.
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk {

/// Infeasible, with the members of the document that are the cause.
struct InfeasibleAt : Infeasible {
  InfeasibleAt(const std::string& what, std::vector<InputFault> list) : Infeasible(what), faults(std::move(list)) {}
  std::vector<InputFault> faults;  ///< one fault at least; places have the form of InputFault::place
};

}  // namespace bahnwerk
