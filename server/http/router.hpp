#pragma once
/// Maps method and path to a handler. HEAD is answered by GET's handler (the connection omits the body), OPTIONS and
/// wrong methods with the list of right ones.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.hpp"

namespace bahnwerk::server {

/// What a route asks of its caller where keys are needed: open nothing, any a key, the others a key with that scope or
/// `admin`. A job named by {id} has to be the caller's own, except for `admin`. page: as read, but people are asked for
/// their key. metrics: as admin, but programs of this machine need no key.
enum class Access { open, any, read, submit, admin, page, metrics };

/// Decides for the router who may call a handler.
class Gate {
 public:
  virtual ~Gate() = default;
  /// Finds out who asks; returns the answer to a request that is refused whatever job it is about.
  virtual std::optional<Response> refuse(Access access, Request& request) const = 0;
  /// Calls the handler if the caller may have the job that the request is about. May answer later.
  virtual void pass(const RequestPtr& request, const Reply& reply, const Handler& handler) const = 0;
};

class Router {
 public:
  /// Adds a pattern of literal segments and {name}s, e.g. "/v1/jobs/{id}". Literals have precedence over names. `query`
  /// are the parameters allowed behind the `?`, each at most once and with a value; anything else is a
  /// schema-violation.
  void add(std::string_view method, std::string_view pattern, Access access, Handler handler,
           std::vector<std::string_view> query = {});
  /// Sets route and parameters of the request, then calls the handler; not-found, method-not-allowed and
  /// schema-violation otherwise.
  void operator()(const RequestPtr& request, const Reply& reply) const;
  void guard(const Gate& gate) { gate_ = &gate; }  ///< asks it before every handler; it outlives this object
  struct Entry {
    std::string method, pattern;
    Access access;
  };
  std::vector<Entry> entries() const;  ///< returns what was added, for tests that have to know all routes

 private:
  struct Method {
    Access access;
    Handler handler;
    std::vector<std::string_view> query;
  };
  struct Route {
    std::string pattern;
    std::vector<std::string> segments;
    std::map<std::string, Method, std::less<>> methods;
    bool matches(const std::vector<std::string>& path, Pairs& parameters) const;
    std::string allow() const;
  };
  std::vector<Route> routes_;
  const Gate* gate_ = nullptr;
};

}  // namespace bahnwerk::server
