/// The commands submit, watch, fetch and health: a terminal client of the service.
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "server/cli/cli.hpp"
#include "server/cli/http_client.hpp"
#include "server/cli/progress_bar.hpp"
#include "server/http/uri.hpp"

namespace bahnwerk::server::cli {
namespace {

using nlohmann::ordered_json;

/// Prints a refusal as the server gave it: the problem document on stdout, its sentence on stderr.
int refused(const Response& response) {
  const ordered_json problem = ordered_json::parse(response.body, nullptr, false);
  if (problem.is_object()) {
    std::cout << problem.dump(2) << std::endl;
    std::cerr << "bahnwerk: refused with " << response.status << ": " << problem.value("detail", "") << '\n';
  } else {
    std::cerr << "bahnwerk: the server answered " << response.status << " without a problem document\n";
  }
  if (response.status >= 500 || response.status == 429) return exit_unreachable;
  return problem.is_object() && problem.value("type", "") == "/problems/no-result" ? exit_failed : exit_usage;
}

ordered_json parse(const Response& response) {
  ordered_json document = ordered_json::parse(response.body, nullptr, false);
  if (!document.is_object()) throw std::runtime_error("the server's answer is not the JSON document expected");
  return document;
}

std::string job_path(const std::string& id) { return "/v1/jobs/" + encode_component(id); }

bool final(const ordered_json& job) {
  const std::string state = job.value("state", "");
  return state != "queued" && state != "running";
}

/// Follows the job to its end. The last answer read, a refusal or the job's final resource. On a terminal the server
/// answers about once a second, for the bar; otherwise once a minute.
Response follow(const HttpClient& client, const std::string& id) {
  ProgressBar bar;
  std::string etag = "\"0\"";  // the tag of no job: the first answer comes at once
  for (;;) {
    Pairs headers{{"Accept", "application/json"}, {"Prefer", "wait=60"}};
    if (bar.visible()) headers.emplace_back("If-None-Match", etag);
    Response response = client.request("GET", job_path(id), headers);
    if (response.status != 200 && response.status != 304) return response;
    if (!response.header("Preference-Applied"))  // a server, or a proxy before it, that does not hold answers
      std::this_thread::sleep_for(std::chrono::seconds(1));
    if (response.status == 304) continue;
    const ordered_json job = parse(response);
    if (final(job)) return response;
    etag = response.header("ETag").value_or(etag);
    const ordered_json progress = job.value("progress", ordered_json::object());
    const auto text = [&](const char* key) {
      return progress.contains(key) && progress[key].is_string() ? progress[key].get<std::string>() : std::string();
    };
    const bool queued = job.value("state", "") == "queued";
    bar.show(progress.value("fraction", 0.0), queued ? "queued" : text("stage"), text("message"));
  }
}

template <class Work>
int guarded(Work&& work) {
  try {
    return work();
  } catch (const Unreachable& error) {
    std::cerr << "bahnwerk: " << error.what() << "\n";
    return exit_unreachable;
  }
}

}  // namespace

int submit(const std::string& server, const std::string& job, const std::string& key, bool wait) {
  const HttpClient client(server);
  return guarded([&] {
    Pairs headers{{"Content-Type", "application/json"}, {"Accept", "application/json"}};
    if (!key.empty()) headers.emplace_back("Idempotency-Key", key);
    const Response posted = client.request("POST", "/v1/jobs", headers, job);
    if (posted.status != 202) return refused(posted);
    const ordered_json resource = parse(posted);
    if (!wait) {
      std::cout << resource.dump(2) << std::endl;
      return exit_ok;
    }
    const std::string id = resource.value("id", "");
    const Response ended = follow(client, id);
    if (ended.status != 200) return refused(ended);
    const ordered_json last = parse(ended);
    if (last.value("state", "") != "succeeded") {
      std::cout << last.value("error", ordered_json()).dump(2) << std::endl;
      return exit_failed;
    }
    const Response result = client.request("GET", job_path(id) + "/result", {{"Accept", "application/json"}});
    if (result.status != 200) return refused(result);
    std::cout << parse(result).dump(2) << std::endl;
    return exit_ok;
  });
}

int watch(const std::string& server, const std::string& id) {
  const HttpClient client(server);
  return guarded([&] {
    const Response ended = follow(client, id);
    if (ended.status != 200) return refused(ended);
    const ordered_json job = parse(ended);
    std::cout << job.dump(2) << std::endl;
    return job.value("state", "") == "succeeded" ? exit_ok : exit_failed;
  });
}

int fetch(const std::string& server, const std::string& id, const std::string& format, const std::string& layout,
          const std::string& frame) {
  static const std::map<std::string, std::string> types{{"csv", "text/csv"},
                                                        {"ndjson", "application/x-ndjson"},
                                                        {"f64", "application/octet-stream"},
                                                        {"json", "application/json"}};
  const HttpClient client(server);
  return guarded([&] {
    const auto print = [](std::string_view piece) {
      if (std::fwrite(piece.data(), 1, piece.size(), stdout) != piece.size())
        throw std::runtime_error("cannot write the setpoints");
    };
    std::string query = layout.empty() ? "" : "?layout=" + layout;
    if (!frame.empty()) query += (query.empty() ? "?frame=" : "&frame=") + frame;
    const Response response =
        client.request("GET", job_path(id) + "/setpoints" + query, {{"Accept", types.at(format)}}, {}, print);
    if (response.status != 200) return refused(response);
    if (std::fflush(stdout) != 0) throw std::runtime_error("cannot write the setpoints");
    return exit_ok;
  });
}

int health(const std::string& server, bool ready) {
  const HttpClient client(server);
  return guarded([&] {
    const Response response = client.request("GET", ready ? "/readyz" : "/healthz", {{"Accept", "application/json"}});
    if (response.status != 200) return refused(response);
    std::cout << parse(response).dump(2) << std::endl;
    return exit_ok;
  });
}

}  // namespace bahnwerk::server::cli
