#pragma once
/// The outcome of planning a document.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/progress.hpp"
#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {
struct ViewFacts;  // api/views/view_facts.hpp

/// A planned document: what a job stores, and what the command line writes.
struct PlannedJob {
  nlohmann::ordered_json result;                          ///< the result document, with the setpoints' summary
  std::unique_ptr<SetpointSource> setpoints;              ///< nullptr if the kind has none
  std::shared_ptr<const ViewFacts> view_facts = nullptr;  ///< what the views of the setpoints need of the document
  bool verified = false;
  std::string failure = {};  ///< the failed checks of a plan that is not verified, as text for a person
};

/// Returns the result document as text, and asks `progress` meanwhile (stage "storing", every 256 KiB): it may have
/// hundreds of megabytes.
std::string result_text(const PlannedJob& planned, Progress progress);

}  // namespace bahnwerk::api
