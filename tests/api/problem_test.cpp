#include "api/problem.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/errors.hpp"
#include "core/base/infeasible_at.hpp"

namespace bahnwerk::api {
namespace {

const std::map<std::string, int> contract{{"invalid-json", 400},
                                          {"schema-violation", 422},
                                          {"semantic-violation", 422},
                                          {"unknown-kind", 422},
                                          {"not-found", 404},
                                          {"method-not-allowed", 405},
                                          {"not-acceptable", 406},
                                          {"unsupported-media-type", 415},
                                          {"idempotency-conflict", 409},
                                          {"job-not-failed", 409},
                                          {"job-not-finished", 409},
                                          {"no-result", 409},
                                          {"precondition-failed", 412},
                                          {"storage-full", 507},
                                          {"store-unavailable", 503},
                                          {"out-of-memory", 503},
                                          {"too-many-connections", 503},
                                          {"bad-request", 400},
                                          {"request-timeout", 408},
                                          {"expectation-failed", 417},
                                          {"header-too-large", 431},
                                          {"not-implemented", 501},
                                          {"http-version-not-supported", 505},
                                          {"payload-too-large", 413},
                                          {"too-many-jobs", 429},
                                          {"unauthorized", 401},
                                          {"forbidden", 403},
                                          {"draining", 503},
                                          {"storage-full", 507},
                                          {"too-many-connections", 503},
                                          {"request-timeout", 408},
                                          {"infeasible", 0},
                                          {"unreachable-pose", 0},
                                          {"tolerance-unreachable", 0},
                                          {"budget-exhausted", 0},
                                          {"deadline-exceeded", 0},
                                          {"verification-failed", 0},
                                          {"cancelled", 0},
                                          {"worker-lost", 0},
                                          {"internal", 500}};

TEST(Catalogue, HoldsExactlyTheContractsSlugsWithTheirStatus) {
  std::map<std::string, int> found;
  for (const auto& type : problem_types()) found.emplace(type.slug, type.status);
  EXPECT_EQ(found, contract);
  EXPECT_EQ(problem_types().size(), contract.size()) << "a slug occurs twice";
}

TEST(Catalogue, EverySlugHasATitleAndAdviceOfItsOwn) {
  std::set<std::string_view> titles, advice;
  for (const auto& type : problem_types()) {
    EXPECT_GT(type.title.size(), 10u) << type.slug;
    EXPECT_GT(type.advice.size(), 40u) << type.slug;
    titles.insert(type.title);
    advice.insert(type.advice);
    EXPECT_EQ(&problem_type(type.slug), &type);
  }
  EXPECT_EQ(titles.size(), contract.size());
  EXPECT_EQ(advice.size(), contract.size());
}

TEST(Catalogue, RefusesAnUnknownSlug) { EXPECT_THROW(problem_type("no-such-slug"), std::out_of_range); }

TEST(Document, CarriesTheMembersOfRfc9457) {
  const Problem problem("schema-violation", "one fault", {{"/spec/a~1b", "is required"}});
  EXPECT_EQ(problem.document("/v1/jobs"),
            (nlohmann::json{{"type", "/problems/schema-violation"},
                            {"title", problem_type("schema-violation").title},
                            {"status", 422},
                            {"detail", "one fault"},
                            {"instance", "/v1/jobs"},
                            {"errors", {{{"pointer", "/spec/a~1b"}, {"message", "is required"}}}}}));
}

TEST(Document, CarriesTheErrorOfTheJob) {
  const std::string error = Problem("infeasible", "no way").document("/v1/jobs/1").dump();
  const auto document = Problem("no-result", "The job failed").because_of(error).document("/v1/jobs/1/result");
  EXPECT_EQ(document["status"], 409);
  EXPECT_EQ(document["error"]["type"], "/problems/infeasible");
  EXPECT_EQ(document["error"]["detail"], "no way");
}

TEST(Summary, NamesTheFirstPlaceAndHowManyFollow) {
  const FieldError at{"/spec/a", "is required"};
  EXPECT_EQ(summary(std::vector{at}), "/spec/a: is required");
  EXPECT_EQ(summary(std::vector{at, at, at}), "/spec/a: is required (and 2 more)");
  EXPECT_EQ(summary(std::vector{at, at, at}, 3), "/spec/a: is required (and at least 2 more)");
  EXPECT_EQ(summary(std::vector<FieldError>{{"", "must be an object"}}), "the document: must be an object");
}

TEST(Document, LeavesOutWhatIsEmpty) {
  const auto document = Problem("infeasible", "no way").document();
  EXPECT_FALSE(document.contains("status"));
  EXPECT_FALSE(document.contains("instance"));
  EXPECT_FALSE(document.contains("errors"));
}

template <class Error>
Problem translated(const Error& error) {
  try {
    throw error;
  } catch (...) {
    return problem_from_current_exception();
  }
}

TEST(FromException, InputFaultsBecomePointersBelowThePrefix) {
  const InvalidInput error({{{"contour", "points", "7"}, "first"}, {{"machine", "a/b~c"}, "second"}});
  const Problem problem = translated(error);
  EXPECT_EQ(problem.type().slug, "semantic-violation");
  ASSERT_EQ(problem.errors().size(), 2u);
  EXPECT_EQ(problem.errors()[0].pointer, "/spec/contour/points/7");
  EXPECT_EQ(problem.errors()[0].message, "first");
  EXPECT_EQ(problem.errors()[1].pointer, "/spec/machine/a~1b~0c");
  EXPECT_STREQ(problem.what(), "/spec/contour/points/7: first (and 1 more)") << "the detail names the first place";
}

TEST(FromException, EveryErrorOfTheCoreHasItsSlug) {
  EXPECT_EQ(translated(Infeasible("x")).type().slug, "infeasible");
  EXPECT_EQ(translated(UnreachablePose("x", 12.5)).type().slug, "unreachable-pose");
  EXPECT_THAT(translated(UnreachablePose("x", 12.5)).what(), testing::HasSubstr("12.5"));
  EXPECT_EQ(translated(ToleranceUnreachable("x", 0.25)).type().slug, "tolerance-unreachable");
  EXPECT_THAT(translated(ToleranceUnreachable("x", 0.25)).what(), testing::HasSubstr("0.25"));
  EXPECT_EQ(translated(Stopped(StopReason::cancelled)).type().slug, "cancelled");
  EXPECT_EQ(translated(Stopped(StopReason::deadline)).type().slug, "deadline-exceeded");
  EXPECT_EQ(translated(Stopped(StopReason::budget)).type().slug, "budget-exhausted");
  EXPECT_EQ(translated(Problem("verification-failed", "kept")).type().slug, "verification-failed");
}

TEST(FromException, WhatIsInTheWayIsNamed) {
  const Problem range = translated(InfeasibleAt("no way", {{{"machine", "coarse", "x", "range"}, "too short"}}));
  EXPECT_EQ(range.type().slug, "infeasible");
  ASSERT_EQ(range.errors().size(), 1u);
  EXPECT_EQ(range.errors()[0].pointer, "/spec/machine/coarse/x/range");
  const Problem pose = translated(UnreachablePose("x", 12.5));
  ASSERT_EQ(pose.errors().size(), 1u);
  EXPECT_EQ(pose.errors()[0].pointer, "/spec/machine");
  EXPECT_THAT(pose.errors()[0].message, testing::HasSubstr("12.5"));
}

TEST(FromException, AnythingElseIsInternalAndKeepsItsTextToItself) {
  for (const Problem& problem : {translated(std::runtime_error("secret path")), translated(42)}) {
    EXPECT_EQ(problem.type().slug, "internal");
    EXPECT_THAT(problem.what(), testing::Not(testing::HasSubstr("secret")));
  }
}

TEST(FromException, MemoryThatRunsOutIsABudget) {
  EXPECT_EQ(translated(std::bad_alloc()).type().slug, "budget-exhausted");
}

}  // namespace
}  // namespace bahnwerk::api
