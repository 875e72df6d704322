/// The commands submit, watch, fetch and health: a terminal client of the service.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "server/cli/cli.hpp"
#include "server/cli/progress_bar.hpp"
#include "server/http/http_client.hpp"
#include "server/http/uri.hpp"
#include "server/runtime/uuid7.hpp"

namespace bahnwerk::server::cli {
namespace {

using nlohmann::ordered_json;

/// Prints a refusal as the server gave it: the problem document, its sentence on stderr.
int refused(const Response& response, std::ostream& out = std::cout) {
  const ordered_json problem = ordered_json::parse(response.body, nullptr, false);
  if (problem.is_object()) {
    out << problem.dump(2) << std::endl;
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

/// Returns how long to wait before a request is repeated, from Retry-After: seconds or a date [RFC 9110, 10.2.3].
std::chrono::seconds retry_after(const Response& response) {
  const std::string text = response.header("Retry-After").value_or("1");
  long long seconds = 1;
  if (text.find_first_not_of("0123456789") == std::string::npos) {
    std::from_chars(text.data(), text.data() + text.size(), seconds);
  } else {
    std::tm date{};
    if (::strptime(text.c_str(), "%a, %d %b %Y %H:%M:%S GMT", &date)) seconds = ::timegm(&date) - std::time(nullptr);
  }
  return std::chrono::seconds(std::clamp(seconds, 1LL, 60LL));
}

/// Repeats requests to a server that restarts, maybe behind a proxy.
class PatientClient {
 public:
  PatientClient(const HttpClient& client, std::chrono::milliseconds patience) : client_(client), patience_(patience) {}

  /// Returns the first answer other than 502, 503 and 504. Repeats where the connection broke, and where there is no
  /// server any more after one has answered; throws Unreachable when patience is over.
  Response request(const std::string& method, const std::string& target, const Pairs& headers,
                   const std::string& body = {}) {
    const auto until = std::chrono::steady_clock::now() + patience_;
    for (;;) {
      std::chrono::milliseconds pause{1000};
      const auto left = [&] {
        return std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
      };
      try {
        Response response = client_.request(method, target, headers, body);
        met_ = true;
        const bool later = response.status == 502 || response.status == 503 || response.status == 504;
        if (!later || left() <= left().zero()) return response;
        pause = retry_after(response);
      } catch (const Unreachable& error) {
        met_ = met_ || error.connected;
        if (!met_ || left() <= left().zero()) throw;
      }
      std::this_thread::sleep_for(std::min(pause, left()));
    }
  }

 private:
  const HttpClient& client_;
  const std::chrono::milliseconds patience_;
  bool met_ = false;  ///< whether a server has been there
};

/// Follows the job to its end. The last answer read, a refusal or the job's final resource. On a terminal the server
/// answers about once a second, for the bar; otherwise once a minute.
Response follow(PatientClient& client, const std::string& id) {
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

HttpClient client_of(const Remote& remote) {
  std::string key = remote.key;
  if (!remote.key_file.empty()) {
    key = read_input(remote.key_file);
    key.resize(std::min(key.size(), key.find_first_of("\r\n")));
  }
  return HttpClient(
      remote.server,
      {.key = key, .ca = remote.ca, .certificate = remote.certificate, .certificate_key = remote.certificate_key});
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

int submit(const Remote& server, const std::string& job, const std::string& key, bool wait,
           std::chrono::milliseconds patience) {
  const HttpClient once = client_of(server);
  PatientClient client(once, patience);
  return guarded([&] {
    Pairs headers{{"Content-Type", "application/json"}, {"Accept", "application/json"}};
    // With a key a post whose answer was lost can be repeated.
    headers.emplace_back("Idempotency-Key", key.empty() ? random_id() : key);
    const Response posted = client.request("POST", "/v1/jobs", headers, job);
    if (posted.status != 202) return refused(posted);
    const ordered_json resource = parse(posted);
    if (!wait) {
      std::cout << resource.dump(2) << std::endl;
      return exit_ok;
    }
    const std::string id = resource.value("id", "");
    std::cerr << "bahnwerk: job " << id << std::endl;  // for `watch`, whatever happens here
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

int watch(const Remote& server, const std::string& id, std::chrono::milliseconds patience) {
  const HttpClient once = client_of(server);
  PatientClient client(once, patience);
  return guarded([&] {
    const Response ended = follow(client, id);
    if (ended.status != 200) return refused(ended);
    const ordered_json job = parse(ended);
    std::cout << job.dump(2) << std::endl;
    return job.value("state", "") == "succeeded" ? exit_ok : exit_failed;
  });
}

int fetch(const Remote& server, const std::string& id, const std::string& format, const std::string& layout,
          const std::string& frame) {
  static const std::map<std::string, std::string> types{{"csv", "text/csv"},
                                                        {"ndjson", "application/x-ndjson"},
                                                        {"f64", "application/octet-stream"},
                                                        {"json", "application/json"}};
  const HttpClient client = client_of(server);
  return guarded([&] {
    const auto print = [](std::string_view piece) {
      if (std::fwrite(piece.data(), 1, piece.size(), stdout) != piece.size())
        throw std::runtime_error("cannot write the setpoints");
    };
    std::string query = layout.empty() ? "" : "?layout=" + layout;
    if (!frame.empty()) query += (query.empty() ? "?frame=" : "&frame=") + frame;
    const Response response =
        client.request("GET", job_path(id) + "/setpoints" + query, {{"Accept", types.at(format)}}, {}, print);
    if (response.status != 200) return refused(response, std::cerr);  // stdout is a file of setpoints, mostly
    if (std::fflush(stdout) != 0) throw std::runtime_error("cannot write the setpoints");
    return exit_ok;
  });
}

int health(const Remote& server, bool ready) {
  const HttpClient client = client_of(server);
  return guarded([&] {
    const Response response = client.request("GET", ready ? "/readyz" : "/healthz", {{"Accept", "application/json"}});
    if (response.status != 200) return refused(response);
    std::cout << parse(response).dump(2) << std::endl;
    return exit_ok;
  });
}

}  // namespace bahnwerk::server::cli
