#include "server/pages/assets.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "server/http/gzip.hpp"

namespace bahnwerk::server {
namespace {

Response asked(const std::string& target, Pairs headers = {}) {
  Router router;
  add_asset_routes(router);
  const auto request = std::make_shared<Request>();
  request->method = "GET";
  request->target = request->path = target;
  for (std::size_t at = 1; at <= target.size();) {
    const std::size_t end = std::min(target.find('/', at), target.size());
    request->segments.push_back(target.substr(at, end - at));
    at = end + 1;
  }
  request->headers = std::move(headers);
  Response answer;
  router(request, [&](Response response) { answer = std::move(response); });
  return answer;
}

TEST(Assets, EveryFileIsThereImmutableAndUnpackedWhereTheClientWantsIt) {
  ASSERT_GE(assets().size(), 7U);
  for (const Asset& asset : assets()) {
    const Response plain = asked(asset_address(asset.name));
    const Response packed = asked(asset_address(asset.name), {{"accept-encoding", "gzip"}});
    EXPECT_EQ(plain.status, 200);
    EXPECT_FALSE(plain.header("Content-Encoding"));
    EXPECT_EQ(packed.header("Content-Encoding"), "gzip");
    EXPECT_EQ(gunzip(packed.body, 16 << 20), plain.body);
    EXPECT_EQ(plain.header("Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(packed.header("Vary"), "Accept-Encoding");
  }
}

TEST(Assets, AnotherVersionOrNameIsNotFound) {
  EXPECT_EQ(asked("/assets/0000000000000000/job.js").status, 404);
  EXPECT_EQ(asked(asset_address("job.jsx")).status, 404);
}

}  // namespace
}  // namespace bahnwerk::server
