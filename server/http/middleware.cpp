#include "server/http/middleware.hpp"

#include <algorithm>
#include <array>

#include "server/http/answer.hpp"
#include "server/keys/key_ring.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/log.hpp"
#include "server/runtime/uuid7.hpp"

namespace bahnwerk::server {
namespace {

bool usable_id(const std::string& id) {
  return !id.empty() && id.size() <= 128 &&
         std::all_of(id.begin(), id.end(), [](char c) { return c > ' ' && c < 127; });
}

/// A label must come from a short list: a client could otherwise grow the metrics without end.
std::string_view method_label(std::string_view method) {
  static constexpr std::array<std::string_view, 7> known{"GET", "HEAD", "POST", "DELETE", "PUT", "PATCH", "OPTIONS"};
  return std::find(known.begin(), known.end(), method) != known.end() ? method : "other";
}

std::string_view route_label(const Request& request) {
  return request.route.empty() ? std::string_view("unmatched") : std::string_view(request.route);
}

/// Returns the id of the job that the request is about, or has made.
std::string job_of(const Request& request, const Response& response) {
  constexpr std::string_view jobs = "/v1/jobs/";
  for (const auto& [name, value] : request.parameters)
    if (name == "id") return value.substr(0, 100);
  std::string made = response.header("Location").value_or("");
  if (made.starts_with(request.prefix)) made.erase(0, request.prefix.size());
  return made.starts_with(jobs) ? made.substr(jobs.size()) : "";
}

}  // namespace

Middleware request_id() {
  return [](Handler next) -> Handler {
    return [next = std::move(next)](RequestPtr request, Reply reply) {
      const auto given = request->header("x-request-id");
      request->id = given && usable_id(*given) ? *given : random_id();
      next(request, [reply = std::move(reply), id = request->id](Response response) {
        response.set("X-Request-Id", id);
        reply(std::move(response));
      });
    };
  };
}

Middleware access_log(LoggedRequests logged) {
  return [logged](Handler next) -> Handler {
    if (logged == LoggedRequests::none) return next;
    return [logged, next = std::move(next)](RequestPtr request, Reply reply) {
      const auto start = std::chrono::steady_clock::now();
      next(request, [logged, reply = std::move(reply), request, start](Response response) {
        if (logged == LoggedRequests::errors && response.status < 400) return reply(std::move(response));
        log::Fields line{{"request", request->id},         {"method", request->method},
                         {"route", route_label(*request)}, {"path", request->path.substr(0, 500)},
                         {"status", response.status},      {"ms", seconds_since(start) * 1e3},
                         {"peer", request->peer}};
        if (request->key) line.push_back({"key", request->key->key.name});
        if (const std::string job = job_of(*request, response); !job.empty()) line.push_back({"job", job});
        if (const auto trace = request->header("traceparent")) line.push_back({"traceparent", trace->substr(0, 100)});
        if (!response.stream) line.push_back({"bytes", response.body.size()});
        log::info("request", line);
        reply(std::move(response));
      });
    };
  };
}

Middleware audit() {
  return [](Handler next) -> Handler {
    return [next = std::move(next)](RequestPtr request, Reply reply) {
      const std::string& method = request->method;
      if (method == "GET" || method == "HEAD" || method == "OPTIONS") return next(std::move(request), std::move(reply));
      next(request, [reply = std::move(reply), request](Response response) {
        if (request->key)
          log::audit({{"action", request->method + " " + request->route},
                      {"target", request->target.substr(0, 500)},
                      {"job", job_of(*request, response)},
                      {"key", request->key->key.name},
                      {"key_id", request->key->key.id},
                      {"peer", request->peer},
                      {"status", response.status},
                      {"request", request->id}});
        reply(std::move(response));
      });
    };
  };
}

Middleware tell_store_state(std::function<StoreState()> state) {
  return [state = std::move(state)](Handler next) -> Handler {
    return [next = std::move(next), state](RequestPtr request, Reply reply) {
      if (state() != StoreState::read_only) return next(std::move(request), std::move(reply));
      next(request, [reply = std::move(reply)](Response response) {
        response.set("Bahnwerk-Store", "read-only");
        reply(std::move(response));
      });
    };
  };
}

Middleware prefixed() {
  return [](Handler next) -> Handler {
    return [next = std::move(next)](RequestPtr request, Reply reply) {
      if (request->prefix.empty()) return next(std::move(request), std::move(reply));
      next(request, [reply = std::move(reply), request](Response response) {
        const std::string& prefix = request->prefix;
        if (const auto location = response.header("Location"); location && location->starts_with('/'))
          response.set("Location", prefix + *location);
        // In a page no text of a user has a quotation mark that is not escaped.
        if (response.header("Content-Type").value_or("").starts_with("text/html"))
          for (const std::string_view attribute : {" href=\"/", " src=\"/", " action=\"/", " data-base=\"/"})
            for (std::size_t at = response.body.find(attribute); at != std::string::npos;
                 at = response.body.find(attribute, at + attribute.size() + prefix.size()))
              response.body.insert(at + attribute.size() - 1, prefix);
        reply(std::move(response));
      });
    };
  };
}

Middleware count(Metrics& metrics) {
  return [&metrics](Handler next) -> Handler {
    return [next = std::move(next), &metrics](RequestPtr request, Reply reply) {
      const auto start = std::chrono::steady_clock::now();
      next(request, [reply = std::move(reply), request, start, &metrics](Response response) {
        metrics.request(route_label(*request), method_label(request->method), response.status, seconds_since(start),
                        response.feed || response.header("Preference-Applied"));
        if (!response.problem.empty()) metrics.refused(response.problem);
        reply(std::move(response));
      });
    };
  };
}

Middleware guard() {
  return [](Handler next) -> Handler {
    return [next = std::move(next)](RequestPtr request, Reply reply) {
      try {
        if (request->fault) throw http_problem(request->fault->status, request->fault->detail);
        next(request, reply);
      } catch (...) {
        reply(answer_from_current_exception(*request));
      }
    };
  };
}

Handler on_pool(Pool& pool, std::function<Response(const Request&)> work) {
  return [&pool, work = std::move(work)](RequestPtr request, Reply reply) {
    pool.post([work, request = std::move(request), reply = std::move(reply)] {
      reply_with(*request, reply, [&] { return work(*request); });
    });
  };
}

}  // namespace bahnwerk::server
