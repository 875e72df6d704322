#pragma once
/// Maps method and path to a handler. HEAD is answered by GET's handler (the connection omits the body), OPTIONS and
/// wrong methods with the list of right ones.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.hpp"

namespace bahnwerk::server {

class Router {
 public:
  /// Adds a pattern of literal segments and {name}s, e.g. "/v1/jobs/{id}". Literals have precedence over names. `query`
  /// are the parameters allowed behind the `?`, each at most once and with a value; anything else is a
  /// schema-violation.
  void add(std::string_view method, std::string_view pattern, Handler handler,
           std::vector<std::string_view> query = {});
  /// Sets route and parameters of the request, then calls the handler; not-found, method-not-allowed and
  /// schema-violation otherwise.
  void operator()(const RequestPtr& request, const Reply& reply) const;

 private:
  struct Method {
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
};

}  // namespace bahnwerk::server
