#pragma once
/// Where the source tree lies.
#include <string>

namespace bahnwerk::test {

/// Returns the path of a file of the source tree, e.g. "examples/line.json". The folder's name is compiled into one
/// small object alone: those of the tests are the same in every clone, and the compiler cache finds them.
std::string source(const std::string& path);

}  // namespace bahnwerk::test
