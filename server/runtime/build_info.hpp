#pragma once
#include <string>

namespace bahnwerk::server {

/// Which build of the program this is. Only the program itself knows: main() hands it down, so that a new commit costs
/// one link and no library changes with it.
struct BuildInfo {
  std::string version;  ///< "0.1.0"
  std::string commit;   ///< of the sources, abbreviated, with "-dirty" where they were changed; "unknown" without git
  std::string build;    ///< type, compiler and flags: "Release, GNU 12.2.0, -O3 -DNDEBUG"
};

/// Written by cmake/build_info.cmake.
BuildInfo build_info();

inline std::string to_string(const BuildInfo& info) {
  return "bahnwerk " + info.version + " (commit " + info.commit + "; " + info.build + ")";
}

}  // namespace bahnwerk::server
