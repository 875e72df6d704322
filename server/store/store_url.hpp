#pragma once
/// Names of stores: sqlite:PATH, or a connection URI of PostgreSQL.
#include <string>
#include <string_view>

namespace bahnwerk::server {

bool names_postgres(std::string_view url);

/// Returns the URL without passwords, as it may be printed: that of the user, and those among its parameters.
std::string without_secrets(std::string_view url);

/// Returns the URL with the password that is the first line of a file, for connecting alone. Throws StoreError where
/// there is none, or the URL names no PostgreSQL server.
std::string with_password(const std::string& url, const std::string& file);

}  // namespace bahnwerk::server
