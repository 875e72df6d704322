#include "server/pages/assets.hpp"

#include <algorithm>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/gzip.hpp"

namespace bahnwerk::server {
namespace {

std::string media_type(std::string_view name) {
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  return "image/svg+xml";
}

Response answer(const Request& request) {
  const std::string& name = request.parameter("name");
  const auto list = assets();
  const auto found = std::find_if(list.begin(), list.end(), [&](const Asset& each) { return each.name == name; });
  if (found == list.end() || request.parameter("version") != assets_version())
    throw api::Problem("not-found", "There is no file " + api::shortened(name) + " of this version of the pages.");
  std::string bytes(reinterpret_cast<const char*>(found->packed.data()), found->packed.size());
  const bool packed = accepts_gzip(request.header("accept-encoding").value_or(""));
  constexpr std::size_t most = 16 << 20;
  Response response = text_answer(200, media_type(name), packed ? std::move(bytes) : gunzip(bytes, most).value());
  if (packed) response.set("Content-Encoding", "gzip");
  response.set("Vary", "Accept-Encoding");
  response.set("Cache-Control", "public, max-age=31536000, immutable");
  return response;
}

}  // namespace

std::string asset_address(std::string_view name) {
  return "/assets/" + std::string(assets_version()) + "/" + std::string(name);
}

void add_asset_routes(Router& router) {
  router.add("GET", "/assets/{version}/{name}", Access::open, [](const RequestPtr& request, const Reply& reply) {
    reply_with(*request, reply, [&] { return answer(*request); });
  });
}

}  // namespace bahnwerk::server
