#pragma once
/// A plan on trial: one candidate of several, or the answer to a question beside the job's own plan. Where it has no
/// plan, the job goes on.
#include <string>
#include <type_traits>

#include "core/base/errors.hpp"
#include "core/base/expected.hpp"

namespace bahnwerk {

/// Returns what `plan()` returns, or the text of the error for which it has none. Throws Stopped.
template <class Plan>
Expected<std::invoke_result_t<Plan>, std::string> trial(const Plan& plan) {
  try {
    return plan();
  } catch (const Stopped&) {
    throw;
  } catch (const PlanningError& none) {
    return std::string(none.what());
  }
}

}  // namespace bahnwerk
