#pragma once
/// Documents planned as a worker plans them; every result is held against the schema of its kind's results.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "api/documents/job.hpp"
#include "api/kind.hpp"
#include "core/base/progress.hpp"
#include "tests/api/checked.hpp"

namespace bahnwerk::api::test {

/// Plans specs of one kind.
class SpecPlanner {
 public:
  explicit SpecPlanner(std::string_view kind) : kind_(kind) {}
  PlannedJob operator()(const nlohmann::json& spec, Progress progress) const {
    return checked(find_kind(kind_)->plan(spec, progress));
  }
  PlannedJob operator()(const nlohmann::json& spec) const {
    Progress silent;
    return (*this)(spec, silent);
  }

 private:
  std::string_view kind_;
};

/// Plans the text of a job document.
inline PlannedJob planned_document(const std::string& text) {
  Progress silent;
  const JobRequest request = parse_job(text);
  return checked(plan_job(request.kind, request.document, silent));
}

}  // namespace bahnwerk::api::test
