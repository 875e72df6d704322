#pragma once
/// Reading the stored document and result of a job again, for answers that are made when they are asked for.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/kind.hpp"
#include "api/problem.hpp"
#include "core/base/errors.hpp"
#include "server/routes/context.hpp"

namespace bahnwerk::server {

struct StoredSpec {
  const api::Kind* kind;
  nlohmann::json spec;
};
/// Returns kind and spec of a job; nullopt where it was deleted, or this version does not know its kind.
std::optional<StoredSpec> stored_spec(Context& context, const std::string& id);

/// Returns what `work` makes of the spec; an empty value where there is none, or this version refuses it.
template <class Work>
auto of_stored_spec(Context& context, const std::string& id, Work&& work) -> decltype(work(StoredSpec())) {
  const auto stored = stored_spec(context, id);
  if (!stored) return {};
  try {
    return work(*stored);
  } catch (const InvalidInput&) {
    return {};
  } catch (const api::Problem&) {
    return {};
  }
}

/// Returns the members of a result with these names, as a document: it is read up to the last of them.
std::string read_parts(StoredText& result, const std::vector<std::string>& names);

}  // namespace bahnwerk::server
