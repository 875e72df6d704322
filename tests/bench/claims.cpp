/// Claims of a PostgreSQL store: claims and ends N jobs of the store named by a URL, one after the other, and prints
/// the times of all claims, of the first and the last of them, and of claims that find nothing.
///
///     claims URL N
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "server/runtime/clock.hpp"
#include "server/store/open.hpp"

namespace {

using namespace bahnwerk::server;

void print(const char* what, std::vector<double> times) {
  if (times.empty()) return;
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  std::printf("%s of %zu: median %.2f ms, 0.9 %.2f ms, longest %.2f ms\n", what, times.size(), at(0.5), at(0.9), at(1));
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return std::fputs("claims URL N\n", stderr), 2;
  const auto store = open_store(words[1], {});
  const int most = std::atoi(words[2]);
  const auto timed = [&](bool& found) {
    const auto start = std::chrono::steady_clock::now();
    const std::int64_t now = now_ms();
    const auto job = store->claim({"bench", now, now + 3'600'000});
    const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    found = job.has_value();
    if (job) store->end({job->id, job->token}, {.error = "{}", .now = now, .revision = job->revision});
    return ms;
  };
  std::vector<double> times;
  bool found = true;
  for (int k = 0; k < most; ++k) {
    times.push_back(timed(found));
    if (found) continue;
    times.pop_back();
    break;
  }
  const auto some = static_cast<std::ptrdiff_t>(std::min<std::size_t>(times.size(), 500));
  print("claims", times);
  print("first", {times.begin(), times.begin() + some});
  print("last", {times.end() - some, times.end()});
  if (found) return 0;
  times.clear();
  for (int k = 0; k < 100; ++k) times.push_back(timed(found));
  print("claims that find nothing", times);
}
