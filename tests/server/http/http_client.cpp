#include "server/http/http_client.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

TEST(HttpClient, TakesServers) {
  for (const char* url : {"http://localhost:8080", "http://127.0.0.1", "http://[::1]:8080/", "http://host/prefix/",
                          "http://user:secret@host", "https://localhost", "unix:/run/x.sock"})
    EXPECT_NO_THROW(HttpClient{url}) << url;
  for (const char* url : {"", "localhost:8080", "unix:", "ftp://x", "http://", "nonsense"})
    EXPECT_THROW(HttpClient{url}, std::invalid_argument) << url;
}

TEST(HttpClient, SaysWhenNobodyAnswers) {
  const HttpClient client("http://127.0.0.1:1");  // tcpmux: nobody listens
  EXPECT_THROW(client.request("GET", "/", {}), Unreachable);
  try {
    HttpClient("http://user:secret@127.0.0.1:1").request("GET", "/", {});
  } catch (const Unreachable& error) {
    EXPECT_FALSE(error.connected);
    EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace bahnwerk::server
