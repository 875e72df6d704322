#pragma once
#include <string>

namespace bahnwerk::server {

/// Identifies the build. Only the program itself knows it: main() passes it on, so that a new commit costs one link and
/// no library changes with it.
struct BuildInfo {
  std::string version;  ///< "0.1.0"
  std::string
      commit;  ///< commit of the sources, abbreviated, with "-dirty" where they were changed; "unknown" without git
  std::string build;  ///< type, compiler and flags: "Release, GNU 12.2.0, -O3 -DNDEBUG"
};

/// Returns the build's identity, which cmake/build_info.cmake generates.
BuildInfo build_info();

inline std::string to_string(const BuildInfo& info) {
  return "bahnwerk " + info.version + " (commit " + info.commit + "; " + info.build + ")";
}

}  // namespace bahnwerk::server
