#pragma once
/// Members of objects of a document that may be absent.
#include <optional>

namespace bahnwerk::api {

/// Returns a member; none if it is absent or null.
template <class T, class Json>
std::optional<T> given(const Json& object, const char* member) {
  const auto at = object.find(member);
  if (at == object.end() || at->is_null()) return std::nullopt;
  return at->template get<T>();
}
/// Reads a member into a variable, which keeps its value if the member is absent or null; `unit` is the document's unit
/// in core's.
template <class T, class Json>
void take(const Json& object, const char* member, T& value) {
  if (const auto v = given<T>(object, member)) value = *v;
}
template <class Json>
void take(const Json& object, const char* member, double& value, double unit) {
  if (const auto v = given<double>(object, member)) value = unit * *v;
}

}  // namespace bahnwerk::api
