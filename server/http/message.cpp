#include "server/http/message.hpp"

#include <algorithm>
#include <stdexcept>

namespace bahnwerk::server {

std::optional<std::string> Request::header(std::string_view name) const {
  std::optional<std::string> value;
  for (const auto& [key, text] : headers) {
    if (key != name) continue;
    value = value ? *value + ", " + text : text;
  }
  return value;
}

const std::string& Request::parameter(std::string_view name) const {
  for (const auto& [key, text] : parameters)
    if (key == name) return text;
  throw std::out_of_range("no such path parameter");
}

Response& Response::set(std::string name, std::string value) {
  for (auto& [key, text] : headers) {
    if (key != name) continue;
    text = std::move(value);
    return *this;
  }
  headers.emplace_back(std::move(name), std::move(value));
  return *this;
}

std::optional<std::string> Response::header(std::string_view name) const {
  for (const auto& [key, text] : headers)
    if (key == name) return text;
  return std::nullopt;
}

Handler compose(const std::vector<Middleware>& list, Handler innermost) {
  for (auto one = list.rbegin(); one != list.rend(); ++one) innermost = (*one)(std::move(innermost));
  return innermost;
}

}  // namespace bahnwerk::server
