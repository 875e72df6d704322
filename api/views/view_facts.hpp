#pragma once
/// What views need of a document: a kind returns it as K::view_facts(request) (api/kind_frame.hpp).
#include "api/views/declared_limits.hpp"

namespace bahnwerk::api {

struct ViewFacts {
  DeclaredLimits limits = {};
};

}  // namespace bahnwerk::api
