#include "server/http/same_site.hpp"

#include <gtest/gtest.h>

#include "api/problem.hpp"
#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

bool taken(const AllowedHosts& hosts, const std::string& method, const std::string& authority,
           const std::string& origin = "") {
  const auto request = std::make_shared<Request>();
  request->method = method;
  request->authority = authority;
  if (!origin.empty()) request->headers = {{"origin", origin}};
  bool called = false;
  try {
    same_site(hosts)([&](const RequestPtr&, const Reply&) { called = true; })(request, nullptr);
  } catch (const api::Problem& problem) {
    EXPECT_EQ(problem.type().slug, "forbidden");
  }
  return called;
}

TEST(SameSite, OnLoopbackOnlyItsNamesAreRight) {
  const AllowedHosts hosts = allowed_hosts("myself:8080", "127.0.0.1:8080", {});
  for (const char* name : {"localhost:8080", "127.0.0.1", "127.9.9.9:1", "[::1]:8080", "myself", ""})
    EXPECT_TRUE(taken(hosts, "POST", name)) << name;
  for (const char* name :
       {"evil.example:8080", "10.0.0.1", "localhost.evil.example", "127.0.0.1.evil.example", "[::2]"})
    EXPECT_FALSE(taken(hosts, "GET", name)) << name;
}

TEST(SameSite, GivenNamesAreAddedToThoseOfLoopback) {
  const AllowedHosts hosts = allowed_hosts("0.0.0.0:8080", "0.0.0.0:8080", {"Planning.example.com", "b.example"});
  for (const char* name : {"planning.example.com", "b.example:443", "localhost", "127.0.0.1"})
    EXPECT_TRUE(taken(hosts, "GET", name)) << name;
  EXPECT_FALSE(taken(hosts, "GET", "c.example"));
}

TEST(SameSite, BeyondLoopbackEveryNameIsRightUnlessSomeAreGiven) {
  EXPECT_TRUE(taken(allowed_hosts("0.0.0.0:80", "0.0.0.0:80", {}), "POST", "any.example"));
}

TEST(SameSite, PagesOfOtherOriginsChangeNothing) {
  const AllowedHosts any{.any = true, .names = {}};
  EXPECT_TRUE(taken(any, "POST", "a.example:8080", "http://a.example:8080"));
  EXPECT_TRUE(taken(any, "POST", "a.example", "https://A.example"));
  EXPECT_TRUE(taken(any, "POST", "a.example", "https://a.example:443"));
  for (const char* origin :
       {"http://a.example", "http://b.example:8080", "null", "nonsense", "http://a.example:8081"}) {
    EXPECT_FALSE(taken(any, "POST", "a.example:8080", origin)) << origin;
    EXPECT_FALSE(taken(any, "DELETE", "a.example:8080", origin)) << origin;
    EXPECT_TRUE(taken(any, "GET", "a.example:8080", origin)) << origin;
  }
}

TEST(SameSite, PagesOfAllowedOriginsMayChangeSomething) {
  const AllowedHosts hosts{.any = true, .names = {}, .origins = {"https://erp.example"}};
  EXPECT_TRUE(taken(hosts, "POST", "a.example", "https://erp.example"));
  EXPECT_FALSE(taken(hosts, "POST", "a.example", "http://erp.example"));
  EXPECT_NO_THROW(check_origins({"https://erp.example", "http://localhost:3000"}));
  for (const char* wrong : {"*", "erp.example", "https://erp.example/", "https://*.example", "null"})
    EXPECT_THROW(check_origins({wrong}), std::runtime_error) << wrong;
}

TEST(SameSite, AnOriginIsTheServiceByHostAndPort) {
  EXPECT_TRUE(same_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(same_origin("https://plan.example", "plan.example"));  // TLS ends in a proxy
  EXPECT_TRUE(same_origin("https://plan.example", "plan.example:443"));
  for (const char* other : {"http://localhost", "http://localhost:81", "http://evil.example:8080", "null", "",
                            "localhost:8080", "http://localhost:8080, http://evil.example"})
    EXPECT_FALSE(same_origin(other, "localhost:8080")) << other;
  EXPECT_FALSE(same_origin("http://", ""));
}

}  // namespace
}  // namespace bahnwerk::server
