#pragma once
/// The files that browsers load with pages: modules, style and icon, bundled from server/web and packed at build time.
#include <span>
#include <string>
#include <string_view>

#include "server/http/router.hpp"

namespace bahnwerk::server {

struct Asset {
  std::string_view name;                  ///< e.g. "job.js"
  std::span<const unsigned char> packed;  ///< its bytes, packed with gzip
};

std::span<const Asset> assets();    ///< returns all files
std::string_view assets_version();  ///< returns a digest of all of them: other files, another address

/// Returns the address of a file, e.g. "/assets/0123456789abcdef/job.js".
std::string asset_address(std::string_view name);

/// Adds GET /assets/{version}/{name}: immutable for a year, packed or not as the client accepts. Anybody may read them.
void add_asset_routes(Router& router);

}  // namespace bahnwerk::server
