#include "api/problem.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "api/pointer.hpp"
#include "core/base/errors.hpp"
#include "core/base/infeasible_at.hpp"
#include "core/base/number_text.hpp"
#include "core/base/unreachable_at.hpp"

namespace bahnwerk::api {
namespace {

constexpr std::array<ProblemType, 37> catalogue{{
    // Problems of requests.
    {"invalid-json", 400, "The body is not valid JSON",
     "The body has to be one JSON document (RFC 8259) in UTF-8: no NaN or Infinity, no duplicate keys, no comments, "
     "nothing behind the "
     "last bracket, at most 64 levels of nesting. `detail` names the line and column where reading stopped."},
    {"schema-violation", 422, "The document does not follow its schema",
     "Every entry of `errors` points at one field and says what was expected there. The schema itself is served under "
     "/v1/schemas/job for the envelope and /v1/schemas/{kind} for `spec`; for a query parameter the pointer starts "
     "with /query."},
    {"semantic-violation", 422, "The document is semantically invalid",
     "Every entry of `errors` points at one field whose value contradicts another one or the geometry: a gap between "
     "two segments, an "
     "arc whose radii differ, coordinates of the wrong dimension. Correct the field and post the document again."},
    {"unknown-kind", 422, "There is no such kind of job",
     "`kind` names what is to be planned. GET /v1/kinds lists the kinds that this server knows."},
    {"not-found", 404, "There is nothing at this address",
     "The job was deleted, never existed, or the path is misspelled. GET /v1/jobs lists the jobs, GET /openapi.json "
     "every path."},
    {"method-not-allowed", 405, "This address does not take that method",
     "The `Allow` header lists the methods that the address takes; GET /openapi.json describes them."},
    {"not-acceptable", 406, "None of the media types asked for can be produced",
     "Ask with another `Accept` header. Setpoints come as application/json, text/csv, application/x-ndjson or "
     "application/octet-stream; everything else as application/json."},
    {"unsupported-media-type", 415, "The body's media type is not supported",
     "Post job documents with `Content-Type: application/json`, plain or with `Content-Encoding: gzip`."},
    {"idempotency-conflict", 409, "The idempotency key was used with another body",
     "An `Idempotency-Key` belongs to exactly one document. Use a new key for a new document; repeat the identical "
     "body to get the job "
     "that the key already created."},
    {"job-not-failed", 409, "The job has neither failed nor been cancelled",
     "A job is planned once more by `retry` when it has failed or was cancelled. Wait for its end, or post the "
     "document "
     "as a new job."},
    {"job-not-finished", 409, "The job has not ended yet",
     "A result and setpoints exist only once the job has succeeded, and a running job cannot be deleted. Wait for the "
     "job "
     "(GET /v1/jobs/{id} with `Prefer: wait=30`) or cancel it first."},
    {"precondition-failed", 412, "The resource is not in the state that the request asks for",
     "`If-Match` names another ETag than the job has now, or `If-None-Match` the one it has. Read the job again and "
     "decide anew; nothing was changed."},
    {"no-result", 409, "The job ended without a result",
     "The job failed or was cancelled, so it has neither a result nor setpoints and never will have. `error` is the "
     "job's own problem document: it says why and what to change."},
    {"payload-too-large", 413, "The body is too large",
     "The document is longer than this server accepts. Split the contour into several jobs or describe it with curves "
     "instead of many "
     "short lines."},
    {"too-many-jobs", 429, "Too many jobs are waiting",
     "The queue is full. Repeat the request after the number of seconds given in `Retry-After`; nothing was stored."},
    {"unauthorized", 401, "The request carries no valid credentials",
     "Send a key that the operator of this server gave you: `Authorization: Bearer bw_…`. Keys are made by `bahnwerk "
     "key "
     "add`; one that was removed is not valid any more."},
    {"forbidden", 403, "This request is not allowed",
     "`detail` says why: the key has not the scope that this operation needs, the host that was asked is no name of "
     "this "
     "service "
     "(`--allowed-host`), or a page of another site sent the request. Ask the operator of this server."},
    {"draining", 503, "The server is about to stop and takes no more jobs",
     "Repeat the request after the number of seconds given in `Retry-After`, or ask another instance; nothing was "
     "stored."},
    {"storage-full", 507, "The server's storage is full",
     "Nothing of the request was kept. Repeat it after the number of seconds given in `Retry-After`; the operator has "
     "to free space or to delete jobs that are no longer needed."},
    {"store-unavailable", 503, "The server's store does not answer",
     "The database cannot be reached at the moment. Repeat the request after the number of seconds given in "
     "`Retry-After`; the operator finds the reason in the server's log."},
    {"out-of-memory", 503, "The server has no memory for this answer now",
     "Plans and other answers take the memory that the server may use. Repeat the request after the number of seconds "
     "given in `Retry-After`; nothing was stored. If it happens often, the operator can raise `--max-memory` or lower "
     "the number of workers."},
    {"too-many-connections", 503, "Too many connections are open",
     "Close connections that are no longer needed, use one connection for several requests, and repeat the request "
     "after the number of seconds given in `Retry-After`."},
    {"bad-request", 400, "The HTTP request is malformed",
     "The target, a header or the framing of the message does not follow HTTP/1.1 (RFC 9112); `detail` says what. The "
     "connection is closed after this answer."},
    {"request-timeout", 408, "The request did not arrive in time",
     "The header or the body was not complete within the server's time limits. Send it again without pauses."},
    {"expectation-failed", 417, "The expectation of the request cannot be met",
     "The only value of `Expect` that this server knows is `100-continue`."},
    {"header-too-large", 431, "The request's header is too large",
     "Shorten the target and the header lines; together they may take 32 KiB."},
    {"not-implemented", 501, "The request uses a part of HTTP that this server does not implement",
     "Of the transfer codings only `chunked` is known; compress a body with `Content-Encoding: gzip` instead."},
    {"http-version-not-supported", 505, "The HTTP version is not supported",
     "Send the request as HTTP/1.1 or HTTP/1.0; later versions are not spoken here."},
    // Problems of planning, which appear in a job's `error`.
    {"infeasible", 0, "No motion satisfies the limits",
     "The limits contradict each other or the contour. `detail` names where. Loosen the limits or change the contour."},
    {"unreachable-pose", 0, "A pose lies outside what the machine reaches",
     "`detail` names the path length at which the machine cannot follow, of a winding also turn and region. Move the "
     "part or choose another machine."},
    {"tolerance-unreachable", 0, "A tolerance cannot be met",
     "`detail` names the best value reached. Widen the tolerance or allow the planner more freedom."},
    {"budget-exhausted", 0, "Time or memory ran out before the plan was finished",
     "`detail` says which. Time: post the job again with a larger `time_budget`, or without one; the server has a "
     "limit "
     "of its own (`--max-planning-time`). Memory: divide the job, or let wider limits hold."},
    {"deadline-exceeded", 0, "The deadline passed before the plan was finished",
     "Post the job again with a later `deadline`, a higher `priority`, or without a deadline."},
    {"verification-failed", 0, "The finished plan did not pass the independent verification",
     "The plan was computed but breaks a limit, so it was not released; `detail` names the checks. Where that is "
     "`needle clearance` the needle of a winding does not keep the distance asked for: a narrower needle, a pivot "
     "shift or other dimensions help. Anything else is a fault of the planner, not of the document: please report it "
     "together with the document."},
    {"cancelled", 0, "The job was cancelled",
     "Someone asked for it with POST /v1/jobs/{id}/cancel. Post the document again if needed."},
    {"worker-lost", 0, "The process that planned the job died repeatedly",
     "The job was given up after its process had ended three times while it planned this job and no other. Please "
     "report it together with the document."},
    {"internal", 500, "Something went wrong inside the server",
     "This is a fault of the server, not of the request. Report it with the value of `X-Request-Id` or the job's id."},
}};

std::vector<FieldError> fields(const std::vector<InputFault>& faults, std::string_view prefix) {
  std::vector<FieldError> errors;
  errors.reserve(faults.size());
  for (const auto& f : faults) errors.push_back({pointer(prefix, f.place), f.message});
  return errors;
}

Problem semantic(const InvalidInput& fault, std::string_view prefix) {
  std::vector<FieldError> errors = fields(fault.faults, prefix);
  std::string detail = errors.empty() ? std::string(fault.what()) : summary(errors);
  return {"semantic-violation", detail, std::move(errors)};
}

/// Returns the line of the program or drawing in which a fault is; the message of such a fault begins with it.
std::optional<std::size_t> line_of(std::string_view message) {
  constexpr std::string_view word = "line ";
  std::size_t line = 0;
  if (!message.starts_with(word)) return std::nullopt;
  const auto [end, error] = std::from_chars(message.data() + word.size(), message.data() + message.size(), line);
  return error == std::errc() ? std::optional(line) : std::nullopt;
}

/// Returns a length or an angle to a thousandth of its unit.
std::string rounded(double value) { return number_text(std::round(1000 * value) / 1000 + 0.0, 12); }

std::string pose(const UnreachablePose::Pose& p) {
  constexpr double degrees = 180 / 3.14159265358979323846;
  return "x " + rounded(p[0]) + ", y " + rounded(p[1]) + ", z " + rounded(p[2]) + " mm, phi " +
         rounded(p[3] * degrees) + ", psi " + rounded(p[4] * degrees) + " deg";
}

}  // namespace

std::span<const ProblemType> problem_types() { return catalogue; }

std::string summary(std::span<const FieldError> errors, std::size_t most) {
  const FieldError& first = errors.front();
  std::string text = (first.pointer.empty() ? "the document" : first.pointer) + ": " + first.message;
  if (errors.size() == 1) return text;
  return text + " (and " + (errors.size() >= most ? "at least " : "") + std::to_string(errors.size() - 1) + " more)";
}

const ProblemType& problem_type(std::string_view slug) {
  for (const auto& type : catalogue)
    if (type.slug == slug) return type;
  throw std::out_of_range("no problem type " + std::string(slug));
}

Problem::Problem(std::string_view slug, const std::string& detail, std::vector<FieldError> errors)
    : std::runtime_error(detail), type_(&problem_type(slug)), errors_(std::move(errors)) {}

Problem& Problem::because_of(std::string error) {
  error_ = std::move(error);
  return *this;
}

nlohmann::json Problem::document(std::string_view instance) const {
  nlohmann::json document{
      {"type", "/problems/" + std::string(type_->slug)}, {"title", type_->title}, {"detail", what()}};
  if (type_->status != 0) document["status"] = type_->status;
  if (!instance.empty()) document["instance"] = instance;
  if (!errors_.empty()) {
    auto& list = document["errors"] = nlohmann::json::array();
    for (const auto& error : errors_) {
      list.push_back({{"pointer", error.pointer}, {"message", error.message}});
      if (const auto line = line_of(error.message)) list.back()["line"] = *line;
    }
  }
  if (!error_.empty()) document["error"] = nlohmann::json::parse(error_);
  return document;
}

Problem problem_from_current_exception(std::string_view prefix) {
  try {
    throw;
  } catch (const Problem& problem) {
    return problem;
  } catch (const InvalidInput& fault) {
    return semantic(fault, prefix);
  } catch (const InfeasibleAt& fault) {
    return {"infeasible", fault.what(), fields(fault.faults, prefix)};
  } catch (const Infeasible& fault) {
    return {"infeasible", fault.what()};
  } catch (const UnreachablePose& fault) {
    const std::string where = std::string(fault.what()) + " (at path length " + rounded(fault.path_length) +
                              " mm, the tool at " + pose(fault.pose) + ")";
    const auto* placed = dynamic_cast<const UnreachableAt*>(&fault);
    const std::vector<std::string> place = placed ? placed->place : std::vector<std::string>{"machine"};
    return {"unreachable-pose", where, {{pointer(prefix, place), where}}};
  } catch (const ToleranceUnreachable& fault) {
    return {"tolerance-unreachable",
            std::string(fault.what()) + " (best value reached: " + number_text(fault.reached, 6) + ")"};
  } catch (const Stopped& stop) {
    switch (stop.reason) {
      case StopReason::cancelled:
        return {"cancelled", "The job was cancelled while it was planned."};
      case StopReason::deadline:
        return {"deadline-exceeded", "The deadline passed while the job was planned."};
      case StopReason::budget:
        return {"budget-exhausted", "The time budget ran out while the job was planned."};
    }
    return {"internal", "The planner was stopped."};
  } catch (const std::bad_alloc&) {
    return {"budget-exhausted",
            "The memory ran out while the job was planned: divide the job, or let wider limits hold."};
  } catch (...) {
    return {"internal",
            "The planner ended unexpectedly."};  // the exception's text may contain what no client should see
  }
}

}  // namespace bahnwerk::api
