#pragma once
/// The catalogue of problems [RFC 9457]: slug, HTTP status, title, and advice.
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

struct ProblemType {
  std::string_view slug;  ///< e.g. "schema-violation"; its page is /problems/<slug>
  int status;             ///< HTTP status; 0 for slugs that only occur in a job's `error`
  std::string_view title;
  std::string_view advice;  ///< one or two sentences for the slug's page: its meaning and what to change
};
std::span<const ProblemType> problem_types();
const ProblemType& problem_type(std::string_view slug);  ///< throws std::out_of_range for a slug not in the catalogue

/// A fault in a document, at an RFC 6901 pointer into the request.
struct FieldError {
  std::string pointer;
  std::string message;
};

/// Returns a summary such as "/spec/machine/axes/z: is required (and 2 more)": the first fault in full and the number
/// of others. `errors` is not empty; if it has `most` or more entries the list may have been cut, and the text says "at
/// least".
std::string summary(std::span<const FieldError> errors, std::size_t most = static_cast<std::size_t>(-1));

class Problem : public std::runtime_error {
 public:
  Problem(std::string_view slug, const std::string& detail, std::vector<FieldError> errors = {});
  const ProblemType& type() const { return *type_; }
  const std::vector<FieldError>& errors() const { return errors_; }
  /// Adds the member `error`: the problem document (JSON text) of the job that the request is about.
  Problem& because_of(std::string error);
  /// Returns the problem document; `instance` is the request path or the job's link, omitted if empty.
  nlohmann::json document(std::string_view instance = {}) const;

 private:
  const ProblemType* type_;
  std::vector<FieldError> errors_;
  std::string error_;
};

/// Converts the exception in flight to the problem that a job carries as `error`: InvalidInput → semantic-violation
/// with pointers below `prefix` ("/spec"), Infeasible → infeasible, UnreachablePose → unreachable-pose,
/// ToleranceUnreachable → its own slug, Stopped → cancelled, deadline-exceeded or budget-exhausted, anything else →
/// internal (without its text). It must be called inside a catch block.
Problem problem_from_current_exception(std::string_view prefix = "/spec");

}  // namespace bahnwerk::api
