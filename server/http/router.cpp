#include "server/http/router.hpp"

#include <algorithm>

#include "api/pointer.hpp"
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

/// Throws Problem schema-violation with every fault: a parameter that is unknown, empty or given twice is a mistake of
/// the client, and a guess of what was meant would hide it.
void check_query(const Pairs& query, const std::vector<std::string_view>& known) {
  std::vector<api::FieldError> errors;
  for (std::size_t i = 0; i < query.size(); ++i) {
    const auto& [name, value] = query[i];
    const auto fault = [&, &key = name](std::string message) {
      errors.push_back({api::pointer("/query", {api::shortened(key)}), std::move(message)});
    };
    const auto same = [&, &key = name](const auto& other) { return other.first == key; };
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::string list;
      for (const auto each : known) list.append(list.empty() ? "; known are " : ", ").append(each);
      fault("unknown parameter" + (known.empty() ? "; this address takes none" : list));
    } else if (std::any_of(query.begin(), query.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      fault("given more than once");
    } else if (value.empty()) {
      fault("must have a value");
    }
    if (errors.size() == 20) break;
  }
  if (errors.empty()) return;
  std::string detail = "The query is not valid: " + api::summary(errors);
  throw api::Problem("schema-violation", std::move(detail), std::move(errors));
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

void Router::add(std::string_view method, std::string_view pattern, Access access, Handler handler,
                 std::vector<std::string_view> query) {
  Method entry{access, std::move(handler), std::move(query)};
  for (Route& route : routes_) {
    if (route.pattern != pattern) continue;
    route.methods.emplace(method, std::move(entry));
    return;
  }
  Route route{std::string(pattern), split(pattern), {}};
  route.methods.emplace(method, std::move(entry));
  routes_.push_back(std::move(route));
}

std::vector<Router::Entry> Router::entries() const {
  std::vector<Entry> list;
  for (const Route& route : routes_)
    for (const auto& [name, method] : route.methods) list.push_back({name, route.pattern, method.access});
  return list;
}

void Router::operator()(const RequestPtr& request, const Reply& reply) const {
  if (request->path == "*") {
    request->route = "*";
    Response response;
    response.status = 204;
    response.set("Allow", "GET, HEAD, POST, DELETE, OPTIONS");
    return reply(std::move(response));
  }
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
  if (!found) throw api::Problem("not-found", "There is nothing at " + api::shortened(request->path) + ".");
  request->route = found->pattern;
  const auto handler = found->methods.find(request->method == "HEAD" ? "GET" : request->method);
  if (handler != found->methods.end()) {
    const Method& method = handler->second;
    if (gate_)
      if (auto refusal = gate_->refuse(method.access, *request)) return reply(std::move(*refusal));
    // A form of a page sends its empty fields, too: they say nothing.
    if (method.access == Access::page)
      std::erase_if(request->query, [](const auto& parameter) { return parameter.second.empty(); });
    check_query(request->query, method.query);
    return gate_ ? gate_->pass(request, reply, method.handler) : method.handler(request, reply);
  }
  Response response;
  if (request->method == "OPTIONS") {
    response.status = 204;
  } else {
    response = problem_answer(
        api::Problem("method-not-allowed", api::shortened(request->method) + " is not possible here; see Allow."),
        request->target);
  }
  response.set("Allow", found->allow());
  reply(std::move(response));
}

}  // namespace bahnwerk::server
