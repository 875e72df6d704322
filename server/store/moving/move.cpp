#include "server/store/moving/move.hpp"

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>

#include "server/runtime/clock.hpp"
#include "server/runtime/sha256.hpp"
#include "server/store/codec.hpp"
#include "server/store/series_pieces.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t page_jobs = 500;

/// Passes on what belongs to a job, and commits when that is much: a series may have gigabytes.
class Copying final : public MovedContent {
 public:
  Copying(MoveWriter& to, std::size_t most, std::function<void()> commit)
      : to_(to), most_(most), commit_(std::move(commit)) {}
  void document(std::string_view packed, bool checked) override {
    to_.document(packed, checked);
    add(packed.size());
  }
  void result(const MovedResult& result) override {
    to_.result(result);
    add(result.document.size());
  }
  void chunk(std::int64_t first_row, std::int64_t row_count, std::string_view packed) override {
    to_.chunk(first_row, row_count, packed);
    add(packed.size());
  }
  void view(const std::string& name, std::int64_t part, std::string_view packed) override {
    to_.view(name, part, packed);
    add(packed.size());
  }
  void committed() { pending_ = 0; }
  std::size_t pending() const { return pending_; }
  std::int64_t bytes() const { return bytes_; }

 private:
  void add(std::size_t bytes) {
    bytes_ += static_cast<std::int64_t>(bytes);
    pending_ += bytes;
    if (pending_ >= most_) commit_();
  }
  MoveWriter& to_;
  const std::size_t most_;
  const std::function<void()> commit_;
  std::size_t pending_ = 0;
  std::int64_t bytes_ = 0;
};

/// The SHA-256 of all that belongs to a job, and what is wrong with it.
class Digests final : public MovedContent {
 public:
  /// `whole`: whether to check that everything is there and can be unpacked, too.
  Digests(const MovedJob& job, bool whole) : job_(job), whole_(whole) {}
  void document(std::string_view packed, bool checked) override {
    add("its document", packed, checked ? "1" : "0");
    unpack("its document", [&] { unpack_text(packed); });
    document_ = true;
  }
  void result(const MovedResult& result) override {
    add("its result", result.document,
        result.columns.value_or("-") + ' ' + std::to_string(result.row_count) + ' ' +
            std::to_string(result.chunk_rows) + ' ' + nlohmann::json(result.cycle_time).dump() + ' ' +
            std::to_string(result.views));
    unpack("its result", [&] { unpack_text(result.document); });
    result_ = true;
    if (!result.columns) return;
    row_count_ = result.row_count;
    if (whole_) unpack("its list of columns", [&] { read_series_columns(*result.columns, series_); });
  }
  void chunk(std::int64_t first_row, std::int64_t row_count, std::string_view packed) override {
    const std::string name = "its setpoints from row " + std::to_string(first_row) + " on";
    add(name, packed, std::to_string(row_count));
    if (first_row != rows_) fault("some of its setpoints are missing before row " + std::to_string(first_row));
    rows_ = first_row + row_count;
    unpack(name, [&] {
      unpack_rows(packed, series_.columns.size(), values_);
      if (values_.size() != static_cast<std::size_t>(row_count) * series_.columns.size()) throw std::runtime_error("");
    });
    ++chunks;
  }
  void view(const std::string& name, std::int64_t part, std::string_view packed) override {
    const std::string text = "part " + std::to_string(part) + " of its view " + name;
    add(text, packed, "");
    unpack(text, [&] { unpack_text(packed); });
    ++views;
  }
  /// Ends the check of a job whose content was passed on.
  void end() {
    if (!whole_) return;
    if (!document_) fault("it has no document");
    if (!result_ && job_.state == api::JobState::succeeded) fault("it has no result");
    if (rows_ != row_count_)
      fault("it has " + std::to_string(rows_) + " rows of setpoints instead of " + std::to_string(row_count_));
  }

  std::vector<std::pair<std::string, std::string>> list;  ///< what it is, digest
  std::vector<std::string> faults;
  std::int64_t chunks = 0, views = 0, bytes = 0;
  bool has_result() const { return result_; }

 private:
  void add(const std::string& what, std::string_view packed, const std::string& more) {
    list.emplace_back(what, sha256(packed) + ' ' + more);
    bytes += static_cast<std::int64_t>(packed.size());
  }
  void fault(const std::string& what) {
    if (whole_ && faults.empty()) faults.push_back(what);
  }
  template <class Work>
  void unpack(const std::string& what, Work&& work) {
    if (!whole_) return;
    try {
      work();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      fault(what + " cannot be unpacked");
    }
  }
  const MovedJob& job_;
  const bool whole_;
  bool document_ = false, result_ = false;
  std::int64_t rows_ = 0, row_count_ = 0;
  SeriesInfo series_;
  std::vector<double> values_;
};

Digests digests_of(MoveReader& store, const MovedJob& job, bool whole) {
  Digests digests(job, whole);
  store.content(job, digests);
  digests.end();
  return digests;
}

/// Compares both stores, job by job.
class Comparison {
 public:
  Comparison(MoveReader& from, MoveTarget& to, std::int64_t begun, MoveReport& report)
      : from_(from), to_(to), begun_(begun), report_(report) {}

  void run(const std::function<void()>& tell) {
    std::string after;
    for (;;) {
      const auto theirs = from_.jobs(after, page_jobs), ours = to_.jobs(after, page_jobs);
      std::size_t k = 0, l = 0;
      while ((k < theirs.size() || l < ours.size()) && report_.faults.size() < max_faults) {
        const int order = k == theirs.size() ? 1 : l == ours.size() ? -1 : theirs[k].id.compare(ours[l].id);
        // Beyond the end of one page the other one's jobs are not known yet.
        if (order > 0 && k == theirs.size() && theirs.size() == page_jobs) break;
        if (order < 0 && l == ours.size() && ours.size() == page_jobs) break;
        after = order > 0 ? ours[l].id : theirs[k].id;
        if (order < 0) {
          fault(theirs[k++].id, "it is missing in the store that was filled");
        } else if (order > 0) {
          fault(ours[l++].id, "it is in the store that was filled alone");
        } else {
          compare(theirs[k], ours[l]);
          ++k, ++l;
        }
      }
      if ((theirs.empty() && ours.empty()) || report_.faults.size() >= max_faults) break;
      tell();
    }
    if (from_.count() != to_.count() && report_.faults.empty())
      report_.faults.push_back("the source has " + std::to_string(from_.count()) + " jobs, the store that was filled " +
                               std::to_string(to_.count()));
  }

 private:
  void fault(const std::string& id, const std::string& what) { report_.faults.push_back("job " + id + ": " + what); }

  void compare(const MovedJob& theirs, const MovedJob& ours) {
    const MovedJob expected = to_.storable(as_moved(theirs, begun_));
    if (record_of(expected) != record_of(ours)) fault(theirs.id, "both differ in its row");
    auto other = std::async(std::launch::async, [&] { return digests_of(to_, ours, false); });
    const Digests source = digests_of(from_, theirs, true);
    const Digests target = other.get();
    for (const std::string& each : source.faults) fault(theirs.id, "in the source, " + each);
    std::size_t k = 0;
    while (k < source.list.size() && k < target.list.size() && source.list[k] == target.list[k]) ++k;
    if (k < source.list.size())
      fault(theirs.id, "both differ in " + source.list[k].first);
    else if (k < target.list.size())
      fault(theirs.id, "only the store that was filled has " + target.list[k].first);
    ++report_.jobs;
    report_.results += target.has_result() ? 1 : 0;
    report_.chunks += target.chunks;
    report_.views += target.views;
    report_.bytes += target.bytes;
  }

  MoveReader& from_;
  MoveTarget& to_;
  const std::int64_t begun_;
  MoveReport& report_;
};

std::string text_of(const Key& key) {
  return nlohmann::json{key.id,
                        key.name,
                        to_string(key.scopes),
                        key.hash,
                        key.max_queued.value_or(-1),
                        key.max_planning_ms.value_or(-1),
                        key.created_at,
                        key.removed_at.value_or(-1)}
      .dump();
}

/// Keys may have been added to the store that was filled before.
void compare_keys(const Keys& theirs, const Keys& ours, MoveReport& report) {
  for (const Key& key : theirs.list) {
    const auto same = [&](const Key& each) { return text_of(each) == text_of(key); };
    if (std::none_of(ours.list.begin(), ours.list.end(), same)) report.faults.push_back("key " + key.id + " differs");
    ++report.keys;
  }
}

MoveState begin(const std::string& source, MoveTarget& to) {
  if (const auto unfinished = to.unfinished()) {
    if (unfinished->source != source)
      throw StoreError("jobs of " + unfinished->source +
                           " are being moved into this store: end that move first, or begin with an empty store",
                       false);
    to.resume(*unfinished);
    return *unfinished;
  }
  if (const std::int64_t jobs = to.count(); jobs > 0)
    throw StoreError("the store to be filled has " + std::to_string(jobs) + " jobs already; expected an empty one",
                     false);
  const MoveState state{.source = source, .begun = now_ms(), .position = "", .jobs = 0};
  to.begin(state);
  return state;
}

}  // namespace

MoveReport move_jobs(MoveReader& from, const std::string& source, MoveTarget& to,
                     const std::function<void(const MoveProgress&)>& tell, const MoveBatch& batch) {
  auto start = std::chrono::steady_clock::now();
  MoveReport report;
  MoveState state = begin(source, to), stored = state;
  const std::int64_t all = from.count();
  std::size_t waiting = 0;  // jobs that are not committed yet
  std::function<void()> commit;
  Copying copying(to, batch.bytes, [&] { commit(); });
  commit = [&] {
    to.commit(state);
    copying.committed();
    waiting = 0;
    tell({.jobs = state.jobs, .of = all, .bytes = copying.bytes()});
  };
  for (;;) {
    const auto page = from.jobs(state.position, page_jobs);
    if (page.empty()) break;
    for (const MovedJob& each : page) {
      const MovedJob job = to.storable(as_moved(each, state.begun));
      to.open(job, state);
      from.content(each, copying);
      to.add(job);
      state.position = job.id;
      ++state.jobs;
      if (++waiting >= batch.jobs) commit();
    }
  }
  if (waiting > 0) commit();
  const Keys keys = from.keys();
  const auto use = from.planning_use();
  to.put(keys, use);
  report.seconds = seconds_since(start);
  report.moved_bytes = copying.bytes();

  start = std::chrono::steady_clock::now();
  Comparison(from, to, state.begun, report).run([&] {
    tell({.comparing = true, .jobs = report.jobs, .of = all, .bytes = report.bytes});
  });
  compare_keys(keys, to.keys(), report);
  const auto kept = to.planning_use();
  for (const PlanningUse& each : use)
    if (std::find(kept.begin(), kept.end(), each) == kept.end())
      report.faults.push_back("the planning time of " + each.owner + " differs");
  report.comparing = seconds_since(start);
  if (report.faults.empty()) to.finish();
  return report;
}

}  // namespace bahnwerk::server
