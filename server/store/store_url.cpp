#include "server/store/store_url.hpp"

#include <algorithm>
#include <fstream>

#include "server/store/values.hpp"

namespace bahnwerk::server {
namespace {

bool secret(std::string_view parameter) {
  const std::string_view name = parameter.substr(0, parameter.find('='));
  return name == "password" || name == "sslpassword";
}

}  // namespace

bool names_postgres(std::string_view url) { return url.starts_with("postgresql://") || url.starts_with("postgres://"); }

std::string without_secrets(std::string_view url) {
  const std::size_t scheme = url.find("://");
  if (scheme == std::string_view::npos) return std::string(url);
  const std::size_t begin = scheme + 3, query = std::min(url.find('?', begin), url.size());
  std::string_view authority = url.substr(begin, query - begin);
  std::string out(url.substr(0, begin));
  // An @ of a password should be encoded; where it is not, the last one ends the user's part.
  if (const std::size_t at = authority.rfind('@'); at != std::string_view::npos) {
    out.append(authority.substr(0, std::min(authority.find(':'), at)));
    authority.remove_prefix(at);
  }
  out.append(authority);
  char before = '?';
  for (std::size_t at = query; at < url.size();) {
    const std::size_t end = std::min(url.find('&', at + 1), url.size());
    const std::string_view parameter = url.substr(at + 1, end - at - 1);
    if (!secret(parameter)) {
      out.append(1, before).append(parameter);
      before = '&';
    }
    at = end;
  }
  return out;
}

std::string with_password(const std::string& url, const std::string& file) {
  if (!names_postgres(url)) throw StoreError("--store-password-file is for a store postgresql://… alone", false);
  std::ifstream stream(file);
  std::string password;
  if (!std::getline(stream, password) || password.empty())
    throw StoreError("the file " + file + " of --store-password-file has no password in its first line", false);
  if (password.back() == '\r') password.pop_back();
  std::string out = url + (url.find('?') == std::string::npos ? "?password=" : "&password=");
  constexpr std::string_view digits = "0123456789ABCDEF";
  for (const char c : password) {
    const auto byte = static_cast<unsigned char>(c);
    out.append(1, '%').append(1, digits[byte >> 4]).append(1, digits[byte & 15]);
  }
  return out;
}

}  // namespace bahnwerk::server
