#pragma once
/// A store in a directory of its own, and small jobs and plans to put into it.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>

#include "api/planned_job.hpp"
#include "core/base/progress.hpp"
#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {

class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "bahnwerk-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("mkdtemp");
    path = name;
  }
  ~TempFolder() { std::filesystem::remove_all(path); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::filesystem::path path;
};

/// Rows whose columns are k and −k/3, `count` of them.
class Ramp final : public SetpointSource {
 public:
  explicit Ramp(std::size_t count) : count_(count) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return count_; }
  double cycle_time() const override { return 0.001; }
  double duration() const override { return 0.001 * static_cast<double>(count_ - 1); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k) {
      *out++ = static_cast<double>(k);
      *out++ = -static_cast<double>(k) / 3;
    }
  }

 private:
  std::vector<Column> columns_{{"x", "mm"}, {"y", "mm"}};
  std::size_t count_;
};

inline api::PlannedJob ramp_plan(std::size_t rows) {
  api::PlannedJob planned;
  planned.result = {{"kind", "ramp"}, {"rows", rows}};
  if (rows > 0) planned.setpoints = std::make_unique<Ramp>(rows);
  planned.verified = true;
  return planned;
}

inline NewJob new_job(int priority = 0, const std::string& key = "", const std::string& body = "") {
  NewJob job;
  job.request.kind = "ramp";
  job.request.priority = priority;
  job.request.document = R"({"n":1})";
  job.idempotency_key = key;
  job.body_hash = body;
  job.now = 1'700'000'000'000;
  job.max_queued = 1000;
  return job;
}

/// insert() waited for; rethrows.
inline Inserted insert(Store& store, NewJob job) {
  std::promise<Inserted> promise;
  store.insert(std::move(job), [&](const Inserted& inserted, const std::exception_ptr& error) {
    error ? promise.set_exception(error) : promise.set_value(inserted);
  });
  return promise.get_future().get();
}
inline std::uint64_t nothing_seen() { return 0; }  ///< for an attempt that has told no progress
inline std::string insert_id(Store& store, NewJob job = new_job()) { return insert(store, std::move(job)).id; }

/// Many at once, which share commits; their ids in order.
inline std::vector<std::string> insert_many(Store& store, std::size_t count) {
  std::vector<std::promise<std::string>> promises(count);
  for (auto& promise : promises) {
    NewJob job = new_job();
    job.max_queued = count;
    store.insert(job, [&](const Inserted& inserted, const std::exception_ptr& error) {
      error ? promise.set_exception(error) : promise.set_value(inserted.id);
    });
  }
  std::vector<std::string> ids;
  for (auto& promise : promises) ids.push_back(promise.get_future().get());
  return ids;
}

/// A claim whose lease never runs out, or one that holds for `lease` ms.
inline std::optional<api::Job> claim(Store& store, std::int64_t now, const std::string& worker = "worker",
                                     std::int64_t lease = -1) {
  return store.claim({worker, now, lease < 0 ? Lease::forever : now + lease});
}

/// A heartbeat of attempts without progress; returns those that the worker does not have any more.
inline std::vector<Attempt> over(Store& store, const Lease& lease, const std::vector<Attempt>& attempts) {
  std::vector<Progressed> told;
  for (const Attempt& attempt : attempts) told.push_back({.attempt = attempt});
  std::vector<Attempt> left = attempts;
  for (const Held& held : store.heartbeat(lease, told)) std::erase(left, held.attempt);
  return left;
}

struct StoreTest : testing::Test {
  void open(SqliteOptions options = {}) {
    store.reset();
    options.path = (folder.path / "store.db").string();
    store = std::make_unique<SqliteStore>(std::move(options));
  }
  StoreTest() { open(); }
  Progress silent;
  TempFolder folder;
  std::unique_ptr<Store> store;
};

}  // namespace bahnwerk::server
