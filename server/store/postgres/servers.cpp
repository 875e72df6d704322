#include "server/store/postgres/servers.hpp"

#include <libpq-fe.h>

#include <algorithm>
#include <memory>
#include <string_view>

namespace bahnwerk::server {
namespace {

std::vector<std::string> items(std::string_view list) {
  std::vector<std::string> found;
  for (;;) {
    const std::size_t end = list.find(',');
    found.emplace_back(list.substr(0, end));
    if (end == std::string_view::npos) return found;
    list.remove_prefix(end + 1);
  }
}

/// Appends "name='value'", in which quotes and backslashes are escaped.
void append(std::string& text, std::string_view name, std::string_view value) {
  text.append(text.empty() ? "" : " ").append(name).append("='");
  for (const char c : value) {
    if (c == '\'' || c == '\\') text.push_back('\\');
    text.push_back(c);
  }
  text.push_back('\'');
}

}  // namespace

PostgresServers servers_of(const std::string& url) {
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(PQconninfoParse(url.c_str(), nullptr),
                                                                             PQconninfoFree);
  if (!options) return {{url}};
  std::vector<std::string> hosts, addresses, ports;
  std::string common;
  bool written = false;
  for (const PQconninfoOption* option = options.get(); option->keyword; ++option) {
    if (!option->val || !*option->val) continue;
    const std::string_view name = option->keyword, value = option->val;
    if (name == "host") {
      hosts = items(value);
    } else if (name == "hostaddr") {
      addresses = items(value);
    } else if (name == "port") {
      ports = items(value);
    } else if (name == "target_session_attrs") {
      if (value == "prefer-standby") return {{url}};
      written = value == "read-write" || value == "primary";
      if (!written) append(common, name, value);
    } else {
      append(common, name, value);
    }
  }
  const std::size_t count = std::max<std::size_t>(1, std::max(hosts.size(), addresses.size()));
  const auto fits = [&](const std::vector<std::string>& list, bool once) {
    return list.empty() || list.size() == count || (once && list.size() == 1);
  };
  if (!fits(hosts, false) || !fits(addresses, false) || !fits(ports, true)) return {{url}};  // libpq says so
  PostgresServers servers{{}, written};
  for (std::size_t k = 0; k < count; ++k) {
    std::string one = common;
    if (!hosts.empty()) append(one, "host", hosts[k]);
    if (!addresses.empty()) append(one, "hostaddr", addresses[k]);
    if (!ports.empty()) append(one, "port", ports[ports.size() == 1 ? 0 : k]);
    servers.each.push_back(one);
  }
  return servers;
}

}  // namespace bahnwerk::server
