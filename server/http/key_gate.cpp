#include "server/http/key_gate.hpp"

#include <algorithm>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "server/http/answer.hpp"
#include "server/http/forwarded.hpp"
#include "server/http/same_site.hpp"

namespace bahnwerk::server {
namespace {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// Returns what follows "Bearer " [RFC 6750, 2.1; the scheme's name has no case].
std::optional<std::string> bearer(const Request& request) {
  const auto header = request.header("authorization");
  if (!header) return std::nullopt;
  constexpr std::string_view scheme = "bearer ";
  const auto same = [](char small, char c) { return c == small || (c >= 'A' && c <= 'Z' && c - 'A' + 'a' == small); };
  if (header->size() < scheme.size() || !std::equal(scheme.begin(), scheme.end(), header->begin(), same)) return "";
  return std::string(trimmed(std::string_view(*header).substr(scheme.size())));
}

/// Returns the key in a browser's cookie. A request that changes something gets by with it only where its Origin, which
/// browsers set and pages cannot, is this service: pages of others, and programs that say none, change nothing with it.
std::optional<std::string> cookie(const Request& request) {
  const bool reads = request.method == "GET" || request.method == "HEAD";
  const auto origin = request.header("origin");
  if (!reads && !(origin && same_origin(*origin, request.authority))) return std::nullopt;
  const std::string all = request.header("cookie").value_or("");
  for (std::string_view rest = all; !rest.empty();) {
    const std::size_t end = rest.find_first_of(";,");
    const std::string_view item = trimmed(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (item.starts_with(key_cookie) && item.substr(key_cookie.size()).starts_with('='))
      return std::string(item.substr(key_cookie.size() + 1));
  }
  return std::nullopt;
}

bool has_scope(Access access, const Scopes& scopes) {
  if (scopes.admin) return true;
  switch (access) {
    case Access::open:
    case Access::any:
      return true;
    case Access::read:
    case Access::page:
      return scopes.read;
    case Access::submit:
      return scopes.submit;
    case Access::admin:
    case Access::metrics:
      break;
  }
  return false;
}

std::string_view scope_of(Access access) {
  return access == Access::submit ? "submit" : access == Access::read || access == Access::page ? "read" : "admin";
}

Response unauthorized(const Request& request, bool wrong) {
  Response response =
      problem_answer(api::Problem("unauthorized", wrong ? "The key is not valid: it is misspelt, or was removed."
                                                        : "This service needs a key: Authorization: Bearer bw_…"),
                     request.target);
  response.set("WWW-Authenticate",
               std::string("Bearer realm=\"bahnwerk\"") + (wrong ? ", error=\"invalid_token\"" : ""));
  return response;
}

api::Problem no_job(const std::string& id) { return {"not-found", "There is no job " + api::shortened(id) + "."}; }

}  // namespace

std::optional<Response> KeyGate::refuse(Access access, Request& request) const {
  if (access == Access::open) return std::nullopt;
  const bool here = access == Access::metrics && from_this_machine(request);
  if (!keys_.known()) {  // whether a key is needed is not known either
    if (here) return std::nullopt;
    return problem_answer(api::Problem("store-unavailable", "The store is away, and with it the keys. Try again."),
                          request.target);
  }
  if (!keys_.demanded()) return std::nullopt;
  const auto header = bearer(request);
  const auto given = header ? header : cookie(request);
  request.key = given ? keys_.find(*given) : nullptr;
  if (!request.key) {
    if (here && !given) return std::nullopt;
    if (access == Access::page && !header) return login_(request, given.has_value());
    return unauthorized(request, given.has_value());
  }
  if (here || has_scope(access, request.key->key.scopes)) return std::nullopt;
  const std::string scope(scope_of(access));
  Response response = problem_answer(
      api::Problem("forbidden", "The key " + request.key->key.name + " has not the scope " + scope + "."),
      request.target);
  response.set("WWW-Authenticate", "Bearer realm=\"bahnwerk\", error=\"insufficient_scope\", scope=\"" + scope + "\"");
  return response;
}

void KeyGate::pass(const RequestPtr& request, const Reply& reply, const Handler& handler) const {
  const auto owner = sees_only(*request);
  const auto named = [](const auto& parameter) { return parameter.first == "id"; };
  if (!owner || std::none_of(request->parameters.begin(), request->parameters.end(), named))
    return handler(request, reply);
  if (const auto known = owner_at_hand(request->parameter("id"))) {
    if (*known != *owner) throw no_job(request->parameter("id"));
    return handler(request, reply);
  }
  pool_.post([this, request, reply, owner, &handler] {
    try {
      const std::string& id = request->parameter("id");
      const auto job = store_.get(id, false);
      if (job) keep_owner(id, job->owner.value_or(""));
      if (!job || job->owner != owner) throw no_job(id);
      handler(request, reply);
    } catch (...) {
      reply(answer_from_current_exception(*request));
    }
  });
}

std::optional<std::string> KeyGate::owner_at_hand(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = owners_.find(id);
  return found == owners_.end() ? std::nullopt : std::optional(found->second);
}

void KeyGate::keep_owner(const std::string& id, std::string owner) const {
  constexpr std::size_t most = 4096;
  const std::lock_guard lock(mutex_);
  if (owners_.size() >= most) owners_.clear();
  owners_.insert_or_assign(id, std::move(owner));
}

std::optional<std::string> sees_only(const Request& request) {
  if (!request.key || request.key->key.scopes.admin) return std::nullopt;
  return request.key->key.name;
}

}  // namespace bahnwerk::server
