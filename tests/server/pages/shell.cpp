#include "server/pages/shell.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

TEST(Shell, NoTextBecomesMarkup) {
  EXPECT_EQ(escape_html("<a href='x' title=\"y\">&amp;</a>"),
            "&lt;a href=&#39;x&#39; title=&quot;y&quot;&gt;&amp;amp;&lt;/a&gt;");
  EXPECT_EQ(escape_html("ü \n"), "ü \n");
}

TEST(Shell, BackquotesBecomeCodeAndAlwaysEnd) {
  EXPECT_EQ(prose_html("set `a<b` or `c`"), "set <code>a&lt;b</code> or <code>c</code>");
  EXPECT_EQ(prose_html("an open `end"), "an open <code>end</code>");
  EXPECT_EQ(prose_html("none"), "none");
}

Request asked(std::string target, Pairs headers = {}) {
  Request request;
  request.target = target;
  request.path = target.substr(0, target.find('?'));
  if (target.find("lang=de") != target.npos) request.query = {{"lang", "de"}};
  request.headers = std::move(headers);
  return request;
}

TEST(Shell, APageEscapesItsTitleAndItsPolicyAllowsFilesOfThisServiceAlone) {
  const Response page = html_page(asked("/"), {.title = "<b>", .body = "<p>body</p>", .module = "plain"});
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body.find("<b>"), std::string::npos);
  EXPECT_NE(page.body.find("<title>&lt;b&gt; · Bahnwerk</title>"), std::string::npos);
  EXPECT_NE(page.body.find("<p>body</p>"), std::string::npos);
  EXPECT_EQ(page.body.find("<style"), std::string::npos);
  EXPECT_EQ(page.body.find("<script>"), std::string::npos);
  const std::string policy = page.header("Content-Security-Policy").value();
  for (const char* part : {"default-src 'none'", "script-src 'self'", "style-src 'self'", "form-action 'self'",
                           "frame-ancestors 'none'", "base-uri 'none'", "require-trusted-types-for 'script'"})
    EXPECT_NE(policy.find(part), std::string::npos) << part;
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_EQ(policy.find("http"), std::string::npos);
}

TEST(Shell, WhoHasThePageGetsNoBody) {
  const Page page{.title = "a", .body = "b", .module = {}};
  const Response first = tagged_page(asked("/"), page);
  const std::string etag = first.header("ETag").value();
  const Response second = tagged_page(asked("/", {{"if-none-match", etag}}), page);
  EXPECT_EQ(second.status, 304);
  EXPECT_TRUE(second.body.empty());
  EXPECT_EQ(tagged_page(asked("/", {{"if-none-match", etag}}), {.title = "a", .body = "c", .module = {}}).status, 200);
}

TEST(Shell, TheLanguageIsRememberedAndItsLinksKeepTheOtherParameters) {
  const Page page{.title = "a", .body = "", .module = {}};
  const Response german = html_page(asked("/?state=failed&lang=de"), page);
  EXPECT_NE(german.body.find("<html lang=\"de\">"), std::string::npos);
  EXPECT_NE(german.body.find("href=\"/?state=failed&amp;lang=en\""), std::string::npos);
  EXPECT_EQ(german.header("Set-Cookie").value().rfind("bahnwerk_lang=de; Path=/", 0), 0U);
  EXPECT_FALSE(html_page(asked("/"), page).header("Set-Cookie"));
}

}  // namespace
}  // namespace bahnwerk::server
