#include "server/runtime/jitter.hpp"

#include <random>

namespace bahnwerk::server {

double random_share() {
  thread_local std::minstd_rand random{std::random_device{}()};
  return std::uniform_real_distribution<double>(0, 1)(random);
}

std::chrono::milliseconds jittered(std::chrono::milliseconds mean) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(mean * (0.5 + random_share()));
}

}  // namespace bahnwerk::server
