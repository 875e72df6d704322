#include "server/runtime/priority.hpp"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace bahnwerk::server {

void lower_priority(int nice) {
#ifdef __linux__
  if (nice <= 0) return;
  // A thread has a priority of its own on Linux; it adds to what the process was started with.
  const auto self = static_cast<id_t>(::gettid());
  ::setpriority(PRIO_PROCESS, self, ::getpriority(PRIO_PROCESS, self) + nice);
#else
  static_cast<void>(nice);
#endif
}

}  // namespace bahnwerk::server
