#include "server/runtime/memory.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bahnwerk::server {

void give_back_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace bahnwerk::server
