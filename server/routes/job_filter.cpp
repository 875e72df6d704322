#include "server/routes/job_filter.hpp"

#include "api/problem.hpp"
#include "api/text/query_values.hpp"
#include "api/text/rfc3339.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t longest_list = 200;

[[noreturn]] void bad_query(const std::string& name, const std::string& message) {
  throw api::Problem("schema-violation", "The query is not valid: " + name + ": " + message,
                     {{"/query/" + name, message}});
}

}  // namespace

JobFilter parse_filter(const Pairs& query) {
  JobFilter filter;
  for (const auto& [name, value] : query) {
    if (name == "state") {
      filter.state = api::job_state(value);
      if (!filter.state) bad_query(name, "expected queued, running, succeeded, failed or cancelled");
    } else if (name == "kind") {
      filter.kind = value;
    } else if (name == "reference") {
      filter.reference = value;
    } else if (name == "tag") {
      filter.tag = value;
    } else if (name == "text") {
      if (value.empty()) bad_query(name, "expected the begin of a name, a reference or an id");
      filter.text = value;
    } else if (name == "sort") {
      if (value != "newest" && value != "oldest") bad_query(name, "expected newest or oldest");
      filter.oldest_first = value == "oldest";
    } else if (name == "created_after" || name == "created_before" || name == "before") {
      const auto time = api::parse_rfc3339(value);
      if (!time) bad_query(name, "expected an RFC 3339 time such as 2026-01-31T12:00:00Z");
      (name == "created_after" ? filter.created_after : filter.created_before) = *time;
    } else if (name == "limit") {
      filter.limit = api::natural(value).value_or(0);
      if (filter.limit < 1 || filter.limit > longest_list)
        bad_query(name, "expected an integer from 1 to " + std::to_string(longest_list));
    } else {  // cursor: the router lets nothing else through
      if (value.size() != 36 || value.find_first_not_of("0123456789abcdef-") != std::string::npos)
        bad_query(name, "expected the `next` of a former page");
      filter.before = value;
    }
  }
  return filter;
}

}  // namespace bahnwerk::server
