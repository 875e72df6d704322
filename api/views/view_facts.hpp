#pragma once
/// What views need of a document: a kind returns it as K::view_facts(request) (api/kinds/kind_frame.hpp).
#include <memory>

#include "api/views/declared_limits.hpp"

namespace bahnwerk::api {
struct SegmentTable;  // api/views/segments.hpp

struct ViewFacts {
  DeclaredLimits limits = {};
  /// What is driven when, from the plan's report; nullptr where nothing is planned, or the kind has no segments.
  std::shared_ptr<const SegmentTable> segments = nullptr;
  /// The segments of a document whose plan is not at hand, for the jobs of older versions: without times. nullptr where
  /// `segments` are known, or the kind has none.
  std::shared_ptr<const SegmentTable> document = nullptr;
};

}  // namespace bahnwerk::api
