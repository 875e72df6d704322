# Writes the source file of build_info(). Runs at every build; the file changes with the commit alone.
#   cmake -DOUT=… -DSOURCE=… -DVERSION=… -DCOMMIT=… -DBUILD=… -P build_info.cmake
# COMMIT, where it is not empty, stands for what git would say: a source archive has no git.
if(NOT COMMIT)
  execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=* WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed)
    set(COMMIT unknown)
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT [=[
#include "server/runtime/build_info.hpp"

namespace bahnwerk::server {

BuildInfo build_info() { return {R"(@VERSION@)", R"(@COMMIT@)", R"(@BUILD@)"}; }

}  // namespace bahnwerk::server
]=] @ONLY)
