/// Random operations on the store against a model of a few lines, with restarts in between.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

struct ModelJob {
  JobState state = JobState::queued;
  int priority = 0, attempt = 0, order = 0;
  std::set<std::int64_t> lost = {};  ///< tokens of attempts whose loss counts
  std::int64_t token = 0;
  bool cancel = false, suspect = false;
  std::size_t rows = 0;
  std::uint64_t revision = 0;
};
using Model = std::map<std::string, ModelJob>;

std::string next_of(const Model& model) {
  std::string best;
  for (const auto& [id, job] : model) {
    if (job.state != JobState::queued) continue;
    if (best.empty() || job.priority > model.at(best).priority ||
        (job.priority == model.at(best).priority && job.order < model.at(best).order))
      best = id;
  }
  for (const auto& [id, job] : model)  // a suspect runs alone
    if (!best.empty() && job.state == JobState::running && (job.suspect || model.at(best).suspect)) return "";
  return best;
}

void restart(Model& model) {
  const auto runs = [](const auto& each) { return each.second.state == JobState::running; };
  const bool alone = std::count_if(model.begin(), model.end(), runs) == 1;
  for (auto& [id, job] : model) {
    if (job.state != JobState::running) continue;
    if (alone) job.lost.insert(job.token);
    job.suspect = true;
    job.state = job.cancel ? JobState::cancelled : job.lost.size() >= 3 ? JobState::failed : JobState::queued;
  }
}

void compare(Store& store, Model& model) {
  std::map<JobState, std::size_t> counts;
  for (auto& [id, expected] : model) {
    ++counts[expected.state];
    const auto job = store.get(id);
    ASSERT_TRUE(job) << id;
    ASSERT_EQ(job->state, expected.state);
    ASSERT_EQ(job->attempt, expected.attempt);
    ASSERT_EQ(job->token, expected.token);
    ASSERT_EQ(job->request.priority, expected.priority);
    ASSERT_GE(job->revision, expected.revision);
    expected.revision = job->revision;
    ASSERT_EQ(store.result(id).has_value(), expected.state == JobState::succeeded);
    if (expected.state == JobState::succeeded && expected.rows > 0) {
      ASSERT_EQ(store.series(id)->count, expected.rows);
    }
    ASSERT_EQ(job->finished_at.has_value(), expected.state != JobState::queued && expected.state != JobState::running);
    ASSERT_EQ(job->error.has_value(), expected.state == JobState::failed || expected.state == JobState::cancelled);
  }
  for (const auto& [state, count] : store.counts()) ASSERT_EQ(count, counts[state]) << api::to_string(state);
  JobFilter everything;
  everything.limit = 100'000;
  const auto list = store.list(everything);
  ASSERT_EQ(list.size(), model.size());
  auto expected = model.rbegin();
  for (const auto& job : list) ASSERT_EQ(job.id, (expected++)->first);
}

TEST_F(StoreTest, BehavesAsTheModel) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    store.reset();
    std::filesystem::remove_all(folder.path);
    std::filesystem::create_directory(folder.path);
    open();
    std::mt19937 random(seed);
    Model model;
    int order = 0;
    const auto any = [&](std::optional<JobState> state = std::nullopt) -> std::string {
      std::vector<std::string> ids;
      for (const auto& [id, job] : model)
        if (!state || job.state == *state) ids.push_back(id);
      return ids.empty() ? "none" : ids[random() % ids.size()];
    };
    for (int step = 0; step < 250; ++step) {
      switch (random() % 10) {
        case 0:
        case 1:
        case 2: {
          const int priority = static_cast<int>(random() % 3);
          const std::string id = insert_id(*store, new_job(priority));
          model[id] = {.priority = priority, .order = order++};
          break;
        }
        case 3:
        case 4: {
          const auto job = claim(*store, 1);
          const std::string expected = next_of(model);
          ASSERT_EQ(job ? job->id : "", expected);
          if (job) {
            model[expected].state = JobState::running;
            ++model[expected].attempt;
            ++model[expected].token;
          }
          break;
        }
        case 5: {
          const std::string id = any();
          const std::int64_t token = static_cast<std::int64_t>(random() % 3);
          const std::size_t rows = random() % 2 ? random() % 6000 : 0;
          const bool known = model.count(id) > 0, own = known && model[id].token == token;
          const bool right = own && model[id].state == JobState::running;
          const bool again = own && model[id].state == JobState::succeeded;
          ASSERT_EQ(store->succeed({id, token}, ramp_plan(rows), 2, nothing_seen, silent), right || again);
          if (right) model[id].state = JobState::succeeded, model[id].rows = rows;
          // The planner of a lost attempt lives, if the job can still make use of that.
          if (known && (model[id].state == JobState::queued || model[id].state == JobState::running))
            model[id].lost.erase(token);
          break;
        }
        case 6: {
          const std::string id = any(JobState::running);
          const bool right = model.count(id) > 0;
          ASSERT_EQ(store->end({id, right ? model[id].token : 1}, {JobState::failed, "{}", 2, 0}), right);
          if (right) model[id].state = JobState::failed;
          break;
        }
        case 7: {
          const std::string id = any();
          const auto job = store->cancel(id, 2);
          ASSERT_EQ(job.has_value(), model.count(id) > 0);
          if (!job) break;
          if (model[id].state == JobState::queued) model[id].state = JobState::cancelled;
          if (model[id].state == JobState::running) model[id].cancel = true;
          break;
        }
        case 8: {
          const std::string id = any();
          const auto expected = !model.count(id)                       ? Removed::unknown
                                : model[id].state == JobState::running ? Removed::running
                                                                       : Removed::yes;
          ASSERT_EQ(store->remove(id), expected);
          if (expected == Removed::yes) model.erase(id);
          break;
        }
        default: {
          if (random() % 3 == 0) {
            open();
            restart(model);
            break;
          }
          const std::string id = any(JobState::running);
          if (!model.count(id)) break;
          ASSERT_TRUE(store->requeue({id, model[id].token}, 2, 0));
          if (model[id].cancel) {
            model[id].state = JobState::cancelled;
          } else {
            model[id].state = JobState::queued;
            --model[id].attempt;
          }
        }
      }
      if (step % 10 == 0) compare(*store, model);
      if (HasFatalFailure()) FAIL() << "seed " << seed << ", step " << step;
    }
    compare(*store, model);
  }
}

}  // namespace
}  // namespace bahnwerk::server
