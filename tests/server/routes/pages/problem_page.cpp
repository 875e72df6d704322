#include "server/routes/pages/problem_page.hpp"

#include <gtest/gtest.h>

#include "api/problem.hpp"
#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

constexpr const char* browser = "text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,*/*;q=0.8";

RequestPtr asking(const char* accept, const char* target = "/jobs/nobody") {
  auto request = std::make_shared<Request>();
  request->method = "GET";
  request->target = request->path = target;
  request->id = "r1";
  if (accept) request->headers = {{"accept", accept}};
  return request;
}

Response answered(const RequestPtr& request, const api::Problem& problem) {
  Response answer;
  problem_pages()([&](const RequestPtr& asked, const Reply& reply) {
    reply(problem_answer(problem, asked->target).set("Allow", "GET"));
  })(request, [&](Response response) { answer = std::move(response); });
  return answer;
}

TEST(ProblemPage, OnlyWhoNamesHtmlBeforeJsonGetsPages) {
  for (const char* accept : {browser, "text/html", "text/html, application/json;q=0.5"})
    EXPECT_TRUE(wants_page(*asking(accept))) << accept;
  for (const char* accept : {"*/*", "application/json", "application/json, text/html",
                             "text/html;q=0.5, application/json", "text/html;q=0", "text/plain"})
    EXPECT_FALSE(wants_page(*asking(accept))) << accept;
  EXPECT_FALSE(wants_page(*asking(nullptr)));
}

TEST(ProblemPage, SaysWhatHappenedAndWhatToDo) {
  const Response page = answered(asking(browser), api::Problem("not-found", "There is no job <b>."));
  EXPECT_EQ(page.status, 404);
  EXPECT_EQ(page.problem, "not-found");
  EXPECT_EQ(page.header("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(page.header("Allow"), "GET");
  EXPECT_TRUE(page.header("Content-Security-Policy"));
  for (const char* part : {"There is no job &lt;b&gt;.", "What to do", "href=\"/problems/not-found\"", "request r1"})
    EXPECT_NE(page.body.find(part), std::string::npos) << part;
  EXPECT_EQ(page.body.find("Try again"), std::string::npos);
  const Response failed = answered(asking(browser), api::Problem("internal", "x"));
  EXPECT_NE(failed.body.find("<a href=\"/jobs/nobody\">Try again</a>"), std::string::npos);
}

TEST(ProblemPage, EveryProblemHasOne) {
  for (const auto& type : api::problem_types()) {
    const Response page = answered(asking(browser), api::Problem(type.slug, "x", {{"/a", "b"}}));
    if (page.status == 401) continue;  // the form that asks for a key
    EXPECT_NE(page.body.find("<h2>What to do</h2>\n<p>"), std::string::npos) << type.slug;
    EXPECT_NE(page.body.find("<li><code>/a</code> b</li>"), std::string::npos) << type.slug;
  }
}

TEST(ProblemPage, ProgramsGetTheDocument) {
  const Response answer = answered(asking("*/*"), api::Problem("not-found", "There is no job."));
  EXPECT_EQ(answer.header("Content-Type"), "application/problem+json");
}

TEST(ProblemPage, AMissingKeyIsAskedFor) {
  const Response page = answered(asking(browser, "/v1/jobs"), api::Problem("unauthorized", "a key"));
  EXPECT_EQ(page.status, 401);
  EXPECT_NE(page.body.find("<input type=\"hidden\" name=\"to\" value=\"/v1/jobs\">"), std::string::npos);
}

TEST(ProblemPage, OtherAnswersStay) {
  Response answer;
  problem_pages()([](const RequestPtr&, const Reply& reply) { reply(text_answer(200, "text/plain", "a")); })(
      asking(browser), [&](Response response) { answer = std::move(response); });
  EXPECT_EQ(answer.body, "a");
}

}  // namespace
}  // namespace bahnwerk::server
