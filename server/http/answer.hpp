#pragma once
/// Answers that several handlers use.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "api/problem.hpp"
#include "server/http/message.hpp"

namespace bahnwerk::server {
class StoredText;  // server/store/store.hpp

/// Returns the problem of a fault of the HTTP message or of the connection, by its status (400 bad-request, 408
/// request-timeout, 413 payload-too-large, 417, 431, 501, 503 too-many-connections, 505; anything else internal).
api::Problem http_problem(int status, const std::string& detail);

Response json_answer(int status, const nlohmann::ordered_json& document);
Response text_answer(int status, std::string type, std::string body);
/// Answers a stored text, 200, in pieces.
Response text_answer(std::string type, std::unique_ptr<StoredText> text);
Response problem_answer(const api::Problem& problem, std::string_view instance);
Response http_error_answer(int status, const std::string& detail, std::string_view instance);
/// Returns the answer to the exception of a handler; to be called inside a catch block. An exception other than Problem
/// and StoreError gives 500 without its text, which is logged.
Response answer_from_current_exception(const Request& request);

/// Runs `work` and replies with its result, or with the answer to its exception.
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
