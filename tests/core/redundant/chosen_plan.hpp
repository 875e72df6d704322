#pragma once
/// The first plan of the list of candidates.
#include <stdexcept>
#include <utility>

#include "core/base/progress.hpp"
#include "core/redundant/methods/candidates.hpp"

namespace bahnwerk::test {

inline RedundancyResult chosen(const RedundancyTask& task, const RedundancyOptions& options) {
  Progress progress;
  PlanChoice choice(task, options, progress);
  if (!choice.next()) throw std::logic_error("no candidate has a plan");
  return std::move(choice.plan());
}

}  // namespace bahnwerk::test
