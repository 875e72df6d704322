/// The commands backup, check, migrate and migrate-store: what an operator does with a store.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "server/cli/cli.hpp"
#include "server/cli/progress_bar.hpp"
#include "server/runtime/clock.hpp"
#include "server/store/open.hpp"
#include "server/store/open/move_store.hpp"
#include "server/store/store_url.hpp"

namespace bahnwerk::server::cli {
namespace {

std::string text_of(const MoveProgress& progress, double seconds) {
  char text[120];
  const double megabytes = static_cast<double>(progress.bytes) * 1e-6;
  std::snprintf(text, sizeof text, "%lld of %lld jobs, %.1f MB, %.1f MB/s", static_cast<long long>(progress.jobs),
                static_cast<long long>(progress.of), megabytes, megabytes / std::max(seconds, 1e-3));
  return text;
}

/// Tells how far a move is: in a bar, or where stderr is no terminal in a line every few seconds.
class MoveTold {
 public:
  void operator()(const MoveProgress& progress) {
    const auto now = std::chrono::steady_clock::now();
    if (progress.comparing != comparing_) {
      comparing_ = progress.comparing;
      begun_ = told_ = now;
    }
    const char* const stage = comparing_ ? "comparing" : "moving";
    const std::string text = text_of(progress, seconds_since(begun_));
    if (bar_.visible()) {
      const auto of = static_cast<double>(std::max<std::int64_t>(progress.of, 1));
      bar_.show(static_cast<double>(progress.jobs) / of, stage, text);
    } else if (now - told_ >= interval) {
      std::cerr << "bahnwerk: " << stage << ": " << text << std::endl;
      told_ = now;
    }
  }

 private:
  static constexpr std::chrono::seconds interval{5};
  ProgressBar bar_;
  bool comparing_ = false;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now(), told_ = begun_;
};

double rounded(double seconds) { return std::round(seconds * 1000) / 1000; }

}  // namespace

int backup(const std::string& store, const std::string& file) {
  const BackUp made = back_up(store, file);
  std::cout << nlohmann::ordered_json{{"file", file}, {"jobs", made.jobs}, {"bytes", made.bytes}}.dump(2) << std::endl;
  return exit_ok;
}

int check(const std::string& store) {
  const std::vector<std::string> faults = inspect(store);
  std::cout << nlohmann::ordered_json{{"whole", faults.empty()}, {"faults", faults}}.dump(2) << std::endl;
  return faults.empty() ? exit_ok : exit_failed;
}

int migrate(const std::string& store) {
  std::cout << nlohmann::ordered_json{{"version", migrate_store(store)}}.dump(2) << std::endl;
  return exit_ok;
}

int move(std::string from, std::string to, const std::string& password_file) {
  if (!password_file.empty()) {
    std::string& url = names_postgres(from) ? from : to;
    url = with_password(url, password_file);
  }
  MoveReport report;
  {
    MoveTold told;
    report = move_store(from, to, [&](const MoveProgress& progress) { told(progress); });
  }
  const bool equal = report.faults.empty();
  std::cout << nlohmann::ordered_json{{"from", without_secrets(from)},
                                      {"to", without_secrets(to)},
                                      {"equal", equal},
                                      {"faults", report.faults},
                                      {"jobs", report.jobs},
                                      {"results", report.results},
                                      {"chunks", report.chunks},
                                      {"views", report.views},
                                      {"keys", report.keys},
                                      {"bytes", report.bytes},
                                      {"bytes_moved", report.moved_bytes},
                                      {"seconds_moving", rounded(report.seconds)},
                                      {"seconds_comparing", rounded(report.comparing)}}
                   .dump(2)
            << std::endl;
  return equal ? exit_ok : exit_failed;
}

}  // namespace bahnwerk::server::cli
