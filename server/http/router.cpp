#include "server/http/router.hpp"

#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

std::vector<std::string> split(std::string_view pattern) {
  std::vector<std::string> parts;
  pattern.remove_prefix(1);
  while (!pattern.empty()) {
    const std::size_t slash = pattern.find('/');
    parts.emplace_back(pattern.substr(0, slash));
    pattern = slash == std::string_view::npos ? std::string_view() : pattern.substr(slash + 1);
  }
  return parts;
}

}  // namespace

bool Router::Route::matches(const std::vector<std::string>& path, Pairs& parameters) const {
  if (path.size() != segments.size()) return false;
  parameters.clear();
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (segments[i].starts_with('{')) {
      if (path[i].empty()) return false;
      parameters.emplace_back(segments[i].substr(1, segments[i].size() - 2), path[i]);
    } else if (segments[i] != path[i]) {
      return false;
    }
  }
  return true;
}

std::string Router::Route::allow() const {
  std::string list;
  for (const auto& [method, handler] : methods)
    list += (list.empty() ? "" : ", ") + method + (method == "GET" ? ", HEAD" : "");
  return list + ", OPTIONS";
}

void Router::add(std::string_view method, std::string_view pattern, Handler handler) {
  for (Route& route : routes_) {
    if (route.pattern != pattern) continue;
    route.methods.emplace(method, std::move(handler));
    return;
  }
  Route route{std::string(pattern), split(pattern), {}};
  route.methods.emplace(method, std::move(handler));
  routes_.push_back(std::move(route));
}

void Router::operator()(const RequestPtr& request, const Reply& reply) const {
  const Route* found = nullptr;
  Pairs parameters;
  for (const Route& route : routes_) {
    if (!route.matches(request->segments, parameters)) continue;
    const bool literal = parameters.empty();
    if (found && !literal) continue;
    found = &route;
    request->parameters = parameters;
    if (literal) break;
  }
  if (!found) throw api::Problem("not-found", "There is nothing at " + request->path + ".");
  request->route = found->pattern;
  const auto handler = found->methods.find(request->method == "HEAD" ? "GET" : request->method);
  if (handler != found->methods.end()) return handler->second(request, reply);
  Response response;
  if (request->method == "OPTIONS") {
    response.status = 204;
  } else {
    response = problem_answer(api::Problem("method-not-allowed", request->method + " is not possible here; see Allow."),
                              request->target);
  }
  response.set("Allow", found->allow());
  reply(std::move(response));
}

}  // namespace bahnwerk::server
