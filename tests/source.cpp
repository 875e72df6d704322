#include "tests/source.hpp"

namespace bahnwerk::test {

std::string source(const std::string& path) { return std::string(BAHNWERK_SOURCE "/") + path; }

}  // namespace bahnwerk::test
