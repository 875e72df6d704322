#include "server/http/answer.hpp"

#include <array>
#include <new>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "server/runtime/log.hpp"
#include "server/runtime/memory.hpp"
#include "server/store/failure.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t longest_instance = 500;  ///< bytes of the target that an answer repeats
constexpr std::size_t short_text = 16 << 10;   // bytes; cheaper to send at once

std::string dump(const ordered_json& document) {
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Response problem_response(int status, const ordered_json& document) {
  Response response;
  response.status = status;
  response.set("Content-Type", "application/problem+json");
  response.set("Cache-Control", "no-store");
  response.body = dump(document);
  return response;
}

}  // namespace

Response json_answer(int status, const ordered_json& document) {
  return text_answer(status, "application/json", dump(document));
}

Response text_answer(int status, std::string type, std::string body) {
  Response response;
  response.status = status;
  response.set("Content-Type", std::move(type));
  response.body = std::move(body);
  return response;
}

Response text_answer(std::string type, std::unique_ptr<StoredText> text) {
  if (text->size() <= short_text) {
    std::string body;
    while (text->next(body)) {
    }
    return text_answer(200, std::move(type), std::move(body));
  }
  Response response;
  response.set("Content-Type", std::move(type));
  response.length = text->size();
  response.stream = [source = std::shared_ptr<StoredText>(std::move(text))](std::string& piece) {
    return source->next(piece);
  };
  return response;
}

Response problem_answer(const api::Problem& problem, std::string_view instance) {
  // Slugs that otherwise only occur in a job's `error` have no status of their own; over HTTP they are the server's
  // fault.
  const int status = problem.type().status == 0 ? 500 : problem.type().status;
  Response response =
      problem_response(status, ordered_json(problem.document(api::shortened(instance, longest_instance))));
  response.problem = problem.type().slug;
  if (status == 429 || status == 503 || status == 507) response.set("Retry-After", status == 429 ? "5" : "10");
  return response;
}

api::Problem http_problem(int status, const std::string& detail) {
  static constexpr std::array<std::pair<int, std::string_view>, 8> slugs{{{400, "bad-request"},
                                                                          {408, "request-timeout"},
                                                                          {413, "payload-too-large"},
                                                                          {417, "expectation-failed"},
                                                                          {431, "header-too-large"},
                                                                          {501, "not-implemented"},
                                                                          {503, "too-many-connections"},
                                                                          {505, "http-version-not-supported"}}};
  for (const auto& [code, slug] : slugs)
    if (code == status) return {slug, detail};
  return {"internal", detail};
}

Response http_error_answer(int status, const std::string& detail, std::string_view instance) {
  return problem_answer(http_problem(status, detail), instance);
}

Response answer_from_current_exception(const Request& request) {
  const auto internal = [&](const char* detail) {
    return problem_answer(api::Problem("internal", detail), request.target);
  };
  try {
    throw;
  } catch (const api::Problem& problem) {
    return problem_answer(problem, request.target);
  } catch (const StoreReadOnly&) {
    return problem_answer(
        api::Problem("store-unavailable", "The store can only be read now: its server is a standby. Try again."),
        request.target);
  } catch (const StoreError& error) {
    log_failure("store_failed", error, {{"request", request.id}, {"path", request.path}});
    if (error.full)
      return problem_answer(
          api::Problem("storage-full", "The store has no space left; nothing of this request was kept."),
          request.target);
    if (error.busy)
      return problem_answer(
          api::Problem(
              "store-unavailable",
              "The store cannot be used now: another program has locked it, or its server is away. Try again."),
          request.target);
    return internal("The store failed; nothing of this request was kept.");
  } catch (const std::bad_alloc&) {
    open_memory_reserve();
    log::error("out_of_memory", {{"request", request.id}, {"path", request.path}});
    return problem_answer(
        api::Problem("out-of-memory", "The memory that the service may use does not suffice for this answer now."),
        request.target);
  } catch (const std::exception& error) {
    log::error("handler_failed", {{"request", request.id}, {"path", request.path}, {"detail", error.what()}});
    return internal("The server failed on this request; its log says more under the request id.");
  }
}

}  // namespace bahnwerk::server
