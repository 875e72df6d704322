#pragma once
/// The error of a pose out of reach whose cause in the document is known.
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk {

/// UnreachablePose, with the member of the document that is the cause.
struct UnreachableAt : UnreachablePose {
  UnreachableAt(const std::string& what, const UnreachablePose& reached, std::vector<std::string> member)
      : UnreachablePose(what, reached.path_length, reached.pose), place(std::move(member)) {}
  std::vector<std::string> place;  ///< has the form of InputFault::place
};

}  // namespace bahnwerk
