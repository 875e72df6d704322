#pragma once
/// Chance in times, so that what waits for the same thing does not come back together.
#include <chrono>

namespace bahnwerk::server {

double random_share();  ///< returns a number from 0 to 1, drawn evenly; any thread may call
/// Returns a time from one half to three halves of `mean`.
std::chrono::milliseconds jittered(std::chrono::milliseconds mean);

}  // namespace bahnwerk::server
