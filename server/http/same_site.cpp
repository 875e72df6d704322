#include "server/http/same_site.hpp"

#include <algorithm>
#include <stdexcept>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "server/http/uri.hpp"

namespace bahnwerk::server {
namespace {

bool loopback(const std::string& host) {
  const bool address = host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string::npos;
  return address || host == "localhost" || host == "::1";
}

/// Returns the port of HOST[:PORT], or the one that the scheme has without it.
std::string port_of(const std::string& authority, const std::string& scheme) {
  const std::size_t colon = authority.rfind(':'), bracket = authority.rfind(']');
  const bool given = colon != std::string::npos && (bracket == std::string::npos || colon > bracket);
  const std::string port = given ? authority.substr(colon + 1) : "";
  return !port.empty() ? port : scheme == "https" ? "443" : "80";
}

bool allows(const AllowedHosts& hosts, const std::string& origin) {
  return std::find(hosts.origins.begin(), hosts.origins.end(), origin) != hosts.origins.end();
}

void check(const AllowedHosts& hosts, const Request& request) {
  const auto host = host_of(request.authority);
  if (!request.authority.empty() && !(host && hosts.contain(*host)))
    throw api::Problem("forbidden", "This service is not asked by the name " + api::in_quotes(request.authority) +
                                        "; its operator can allow it (--allowed-host, BAHNWERK_ALLOWED_HOST).");
  const bool safe = request.method == "GET" || request.method == "HEAD" || request.method == "OPTIONS";
  const auto origin = request.header("origin");
  if (!safe && origin && !same_origin(*origin, request.authority) && !allows(hosts, *origin))
    throw api::Problem("forbidden", "A page of " + api::in_quotes(*origin) + " may change nothing here.");
}

}  // namespace

bool same_origin(const std::string& origin, const std::string& authority) {
  const std::size_t end = origin.find("://");
  if (end == std::string::npos) return false;
  const std::string scheme = origin.substr(0, end), other = origin.substr(end + 3);
  const auto host = host_of(other);
  return host && host == host_of(authority) && port_of(other, scheme) == port_of(authority, scheme);
}

bool AllowedHosts::contain(const std::string& host) const {
  return any || loopback(host) || std::find(names.begin(), names.end(), host) != names.end();
}

AllowedHosts allowed_hosts(const std::string& listen, const std::string& bound, const std::vector<std::string>& given) {
  AllowedHosts hosts;
  for (const std::string& name : given) hosts.names.push_back(host_of(name).value_or(name));
  hosts.any = given.empty() && !loopback(host_of(bound).value_or(""));
  if (const auto own = host_of(listen)) hosts.names.push_back(*own);
  return hosts;
}

void check_origins(const std::vector<std::string>& origins) {
  for (const std::string& origin : origins) {
    const std::size_t end = origin.find("://");
    const bool good = (origin.starts_with("http://") || origin.starts_with("https://")) &&
                      host_of(std::string_view(origin).substr(end + 3)) &&
                      origin.find_first_of("/*", end + 3) == std::string::npos;
    if (!good)
      throw std::runtime_error("'" + origin + "' is no origin; expected for example https://planning.example.com");
  }
}

Middleware cors(const AllowedHosts& hosts) {
  return [&hosts](Handler next) -> Handler {
    return [&hosts, next = std::move(next)](RequestPtr request, Reply reply) {
      const auto origin = request->header("origin");
      if (hosts.origins.empty()) return next(std::move(request), std::move(reply));
      const bool allowed = origin && allows(hosts, *origin);
      const bool asks_before = request->method == "OPTIONS" && request->header("access-control-request-method");
      next(std::move(request), [reply = std::move(reply), origin, allowed, asks_before](Response response) {
        const auto vary = response.header("Vary");
        response.set("Vary", vary ? *vary + ", Origin" : "Origin");
        if (allowed) {
          response.set("Access-Control-Allow-Origin", *origin);
          response.set("Access-Control-Expose-Headers",
                       "ETag, Location, Preference-Applied, Retry-After, WWW-Authenticate, X-Columns, X-Request-Id");
        }
        if (allowed && asks_before) {
          response.set("Access-Control-Allow-Methods", response.header("Allow").value_or("GET"));
          response.set("Access-Control-Allow-Headers",
                       "Accept, Authorization, Content-Encoding, Content-Type, Idempotency-Key, If-Match, "
                       "If-None-Match, Last-Event-ID, Prefer, X-Request-Id, traceparent");
          response.set("Access-Control-Max-Age", "600");
        }
        reply(std::move(response));
      });
    };
  };
}

Middleware same_site(const AllowedHosts& hosts) {
  return [&hosts](Handler next) -> Handler {
    return [&hosts, next = std::move(next)](RequestPtr request, Reply reply) {
      check(hosts, *request);
      next(std::move(request), std::move(reply));
    };
  };
}

}  // namespace bahnwerk::server
