#include "server/routes/watch.hpp"

#include <algorithm>
#include <charconv>

#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

constexpr int longest_wait = 60;

std::string etag(const api::Job& job) { return "\"" + std::to_string(job.revision) + "\""; }

bool final(const api::Job& job) { return job.state != api::JobState::queued && job.state != api::JobState::running; }

Response resource(Context& context, const Request& request) {
  const api::Job light = find_job(context, request.parameter("id"), false);
  if (matches_etag(request, etag(light))) return with_etag(request, etag(light), Response());
  const api::Job job = find_job(context, light.id);
  return with_etag(request, etag(job), job_answer(200, job));
}

}  // namespace

int preferred_wait(const Request& request) {
  const std::string preferences = request.header("prefer").value_or("");
  std::string_view rest = preferences;
  while (!rest.empty()) {
    const std::size_t end = rest.find_first_of(",;");
    std::string_view item = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    while (item.starts_with(' ')) item.remove_prefix(1);
    if (!item.starts_with("wait=")) continue;
    int seconds = 0;
    std::from_chars(item.data() + 5, item.data() + item.size(), seconds);
    return std::clamp(seconds, 0, longest_wait);
  }
  return 0;
}

void watch(Context& context, const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  context.pool.post([&context, request, reply] {
    try {
      const std::string& id = request->parameter("id");
      const api::Job job = find_job(context, id, false);
      const int wait = preferred_wait(*request);
      const bool known = !request->header("if-none-match") || matches_etag(*request, etag(job));
      if (wait == 0 || final(job) || !known) return reply(resource(context, *request));
      const auto until = Notifier::Clock::now() + std::chrono::seconds(wait);
      const auto token = context.notifier.wait(id, until, [&context, request, reply, wait] {
        context.pool.post([&context, request, reply, wait] {
          reply_with(*request, reply, [&] {
            Response response = resource(context, *request);
            response.set("Preference-Applied", "wait=" + std::to_string(wait));
            return response;
          });
        });
      });
      // What changed between the first look and the wait would be missed.
      if (find_job(context, id, false).revision != job.revision) context.notifier.wake(token);
    } catch (...) {
      reply(answer_from_current_exception(*request));
    }
  });
}

}  // namespace bahnwerk::server
