#pragma once
/// Answers that many handlers give.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "api/problem.hpp"
#include "server/http/message.hpp"

namespace bahnwerk::server {

/// A fault of the HTTP message itself, or of the connection: the problem of that status (400 bad-request, 408
/// request-timeout, 413 payload-too-large, 417, 431, 501, 503 too-many-connections, 505; anything else internal).
api::Problem http_problem(int status, const std::string& detail);

Response json_answer(int status, const nlohmann::ordered_json& document);
Response text_answer(int status, std::string type, std::string body);
Response problem_answer(const api::Problem& problem, std::string_view instance);
Response http_error_answer(int status, const std::string& detail, std::string_view instance);
/// For whatever a handler threw; call inside a catch block. What is not a Problem or StoreError answers 500 without its
/// text, which goes to the log.
Response answer_from_current_exception(const Request& request);

/// Runs `work` and replies with what it returns, or with the answer to what it throws.
template <class Work>
void reply_with(const Request& request, const Reply& reply, Work&& work) {
  Response response;
  try {
    response = work();
  } catch (...) {
    response = answer_from_current_exception(request);
  }
  reply(std::move(response));
}

}  // namespace bahnwerk::server
