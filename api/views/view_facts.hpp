#pragma once
/// What views need of a document: a kind returns it as K::view_facts(request) (api/kind_frame.hpp).

namespace bahnwerk::api {

struct ViewFacts {};

}  // namespace bahnwerk::api
