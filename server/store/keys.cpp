#include "server/store/keys.hpp"

namespace bahnwerk::server {

std::optional<Scopes> parse_scopes(std::string_view list) {
  Scopes scopes;
  while (true) {
    const std::size_t comma = list.find(',');
    const std::string_view each = list.substr(0, comma);
    if (each == "submit")
      scopes.submit = true;
    else if (each == "read")
      scopes.read = true;
    else if (each == "admin")
      scopes.admin = true;
    else
      return std::nullopt;
    if (comma == std::string_view::npos) return scopes;
    list.remove_prefix(comma + 1);
  }
}

std::string to_string(const Scopes& scopes) {
  std::string list;
  const auto add = [&](bool has, std::string_view name) {
    if (has) list.append(list.empty() ? "" : ",").append(name);
  };
  add(scopes.submit, "submit");
  add(scopes.read, "read");
  add(scopes.admin, "admin");
  return list;
}

}  // namespace bahnwerk::server
