#include "server/http/message.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bahnwerk::server {
namespace {

TEST(Message, SeveralLinesOfAHeaderAreOneList) {
  Request request;
  request.headers = {{"accept", "text/html"}, {"host", "a"}, {"accept", ""}, {"accept", "*/*"}};
  EXPECT_EQ(request.header("accept"), "text/html, , */*");
  EXPECT_EQ(request.header("host"), "a");
  EXPECT_EQ(request.header("Host"), std::nullopt) << "names are in lower case";
  EXPECT_EQ(request.header("range"), std::nullopt);
}

TEST(Message, AParameterThatThePatternLacksIsAFaultOfTheProgram) {
  Request request;
  request.parameters = {{"id", ""}, {"name", "x"}};
  EXPECT_EQ(request.parameter("id"), "");
  EXPECT_EQ(request.parameter("name"), "x");
  EXPECT_THROW(static_cast<void>(request.parameter("ID")), std::out_of_range);
}

TEST(Message, SettingAHeaderTwiceKeepsItsPlaceAndTheLastValue) {
  Response response;
  response.set("ETag", "1").set("Allow", "GET").set("ETag", "2");
  EXPECT_EQ(response.headers, (Pairs{{"ETag", "2"}, {"Allow", "GET"}}));
  EXPECT_EQ(response.header("ETag"), "2");
  EXPECT_EQ(response.header("etag"), std::nullopt) << "exact spelling";
}

TEST(Message, TheFirstMiddlewareIsTheOutermost) {
  std::string order;
  const auto step = [&](char name) -> Middleware {
    return [&order, name](Handler next) -> Handler {
      return [&order, name, next](RequestPtr request, Reply reply) {
        order += name;
        next(request, [&order, name, reply](Response response) {
          order += static_cast<char>(name - 'a' + 'A');
          reply(std::move(response));
        });
      };
    };
  };
  const Handler inner = [&](RequestPtr, Reply reply) {
    order += '.';
    reply({});
  };
  compose({step('a'), step('b')}, inner)(std::make_shared<Request>(), [&](Response) { order += '!'; });
  EXPECT_EQ(order, "ab.BA!");
  order.clear();
  compose({}, inner)(std::make_shared<Request>(), [&](Response) { order += '!'; });
  EXPECT_EQ(order, ".!");
}

}  // namespace
}  // namespace bahnwerk::server
