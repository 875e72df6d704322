#pragma once
/// Names of checks in tests of core: those that people read.
#include "api/check_text.hpp"

namespace bahnwerk {

using api::check_name;
using api::check_unit;

}  // namespace bahnwerk
