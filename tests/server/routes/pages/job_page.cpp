#include "server/routes/pages/job_page.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

TEST(JobPage, TimesAreWholeSecondsOfUtc) {
  EXPECT_EQ(time_label(0), "<time datetime=\"1970-01-01T00:00:00.000Z\">1970-01-01 00:00:00 UTC</time>");
  EXPECT_NE(time_label(951'782'399'999).find(">2000-02-28 23:59:59 UTC<"), std::string::npos);
  EXPECT_NE(time_label(951'782'400'000).find(">2000-02-29 00:00:00 UTC<"), std::string::npos);
}

TEST(JobPage, OnlyARunningJobShowsHowFarItIs) {
  api::Job job;
  job.fraction = 0.25;
  EXPECT_EQ(state_label(job, Texts(Language::en)), "<span class=\"state queued\">queued</span>");
  job.state = api::JobState::running;
  EXPECT_EQ(state_label(job, Texts(Language::en)), "<span class=\"state running\">running</span> 25 %");
  for (int percent = 0; percent < 100; ++percent) {
    job.fraction = percent / 100.0;
    EXPECT_TRUE(state_label(job, Texts(Language::en)).ends_with(" " + std::to_string(percent) + " %"))
        << state_label(job, Texts(Language::en));
  }
  EXPECT_EQ(state_label(job, Texts(Language::de)), "<span class=\"state running\">läuft</span> 99 %");
  job.fraction = 0.999;
  EXPECT_TRUE(state_label(job, Texts(Language::en)).ends_with(" 99 %")) << "100 % is for what has ended";
}

}  // namespace
}  // namespace bahnwerk::server
