#pragma once
/// Documents of windings, and of the machines for them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>

#include "api/kind.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api::winding_kind {

inline constexpr double degree = std::numbers::pi / 180;

inline nlohmann::json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/winding/" + name + ".json"));
}
inline nlohmann::json machine(const std::string& name) {
  return test::read_json(test::source("examples/machines/" + name + ".json"));
}

/// The plan of a spec, whose result follows its schema.
inline const test::SpecPlanner planned("winding");

/// The problem that a job with this spec ends with.
inline std::string problem_of(const nlohmann::json& spec, std::string_view slug) {
  try {
    Progress silent;
    find_kind("winding")->plan(spec, silent);
  } catch (...) {
    const Problem problem = problem_from_current_exception();
    EXPECT_EQ(problem.type().slug, slug);
    return problem.what();
  }
  ADD_FAILURE() << "planned";
  return {};
}

}  // namespace bahnwerk::api::winding_kind
