#include "server/routes/html.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

TEST(Html, NoTextBecomesMarkup) {
  EXPECT_EQ(escape_html("<a href='x' title=\"y\">&amp;</a>"),
            "&lt;a href=&#39;x&#39; title=&quot;y&quot;&gt;&amp;amp;&lt;/a&gt;");
  EXPECT_EQ(escape_html("ü \n"), "ü \n");
}

TEST(Html, BackquotesBecomeCodeAndAlwaysEnd) {
  EXPECT_EQ(prose_html("set `a<b` or `c`"), "set <code>a&lt;b</code> or <code>c</code>");
  EXPECT_EQ(prose_html("an open `end"), "an open <code>end</code>");
  EXPECT_EQ(prose_html("none"), "none");
}

TEST(Html, APageEscapesItsTitleAndForbidsScripts) {
  const Response page = html_page("<b>", "<p>body</p>");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body.find("<b>"), std::string::npos);
  EXPECT_NE(page.body.find("<title>&lt;b&gt;</title>"), std::string::npos);
  EXPECT_NE(page.body.find("<p>body</p>"), std::string::npos);
  const std::string policy = page.header("Content-Security-Policy").value();
  EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(policy.find("script-src"), std::string::npos);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
}

TEST(Html, OnlyAPageWithTimesHasAScriptAndThePolicyAllowsThatOneAlone) {
  const Response page = html_page("a", "<time datetime=\"1970-01-01T00:00:00.000Z\">then</time>");
  const std::string policy = page.header("Content-Security-Policy").value();
  EXPECT_NE(policy.find("; script-src 'sha256-"), std::string::npos) << policy;
  EXPECT_EQ(policy.find("unsafe"), std::string::npos) << policy;
  const std::size_t script = page.body.find("<script>");
  ASSERT_NE(script, std::string::npos);
  EXPECT_EQ(page.body.find("<script", script + 1), std::string::npos);
  EXPECT_EQ(html_page("a", "&lt;time ").body.find("<script"), std::string::npos);
}

TEST(Html, OnlyAPageThatWaitsReloadsItself) {
  EXPECT_EQ(html_page("a", "").body.find("http-equiv"), std::string::npos);
  EXPECT_NE(html_page("a", "", 2).body.find("http-equiv=\"refresh\" content=\"2\""), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk::server
