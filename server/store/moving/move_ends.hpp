#pragma once
/// The two ends of a move of jobs from one store into another: each store has both. They read and write rows, and
/// decide nothing: what is moved in which order, and what has to agree, is in move.hpp. An object is used by one thread
/// at a time; errors are thrown as StoreError.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/keys.hpp"
#include "server/store/moving/moved_job.hpp"

namespace bahnwerk::server {

/// The row of a result; `columns` is empty where it has no setpoints.
struct MovedResult {
  std::string_view document;  ///< packed
  std::optional<std::string> columns;
  std::int64_t row_count = 0, chunk_rows = 0;
  double cycle_time = 0;
  std::int64_t views = 0;
};

/// Receives what belongs to a job, in this order, each as it is stored. Views of bytes are valid during the call.
class MovedContent {
 public:
  virtual ~MovedContent() = default;
  virtual void document(std::string_view packed, bool checked) = 0;
  virtual void result(const MovedResult& result) = 0;
  virtual void chunk(std::int64_t first_row, std::int64_t row_count, std::string_view packed) = 0;
  virtual void view(const std::string& name, std::int64_t part, std::string_view packed) = 0;
};

/// The time that planners spent on an owner's jobs on a day.
struct PlanningUse {
  std::string owner;
  std::int64_t day = 0, ms = 0;
  bool operator==(const PlanningUse&) const = default;
};

class MoveReader {
 public:
  virtual ~MoveReader() = default;
  virtual std::int64_t count() = 0;  ///< jobs in the store
  /// Returns the jobs behind an id (empty: from the first), in the order of ids, at most `limit`.
  virtual std::vector<MovedJob> jobs(const std::string& after, std::size_t limit) = 0;
  /// Passes on what belongs to one of these jobs: chunks in the order of their rows, views in that of name and part.
  virtual void content(const MovedJob& job, MovedContent& to) = 0;
  virtual Keys keys() = 0;
  virtual std::vector<PlanningUse> planning_use() = 0;
};

/// How far a move has come. It is kept in the store that is filled, in the transactions that fill it.
struct MoveState {
  std::string source;      ///< name of the store that the jobs come from
  std::int64_t begun = 0;  ///< ms since 1970 UTC
  std::string position;    ///< id of the last job that is there as a whole
  std::int64_t jobs = 0;   ///< jobs up to there
};

/// A store that is filled. Services refuse it from begin() to finish().
class MoveWriter : public MovedContent {
 public:
  /// Returns the state of a move that has not come to its end.
  virtual std::optional<MoveState> unfinished() = 0;
  virtual void begin(const MoveState& state) = 0;
  /// Removes what an interrupted transaction has left of jobs behind the position.
  virtual void resume(const MoveState& state) = 0;
  /// What follows, up to add(), belongs to this job, the next one behind the position. `state` counts those before it.
  virtual void open(const MovedJob& job, const MoveState& state) = 0;
  virtual void add(const MovedJob& job) = 0;  ///< adds the row of the job itself
  virtual void commit(const MoveState& state) = 0;
  virtual void put(const Keys& keys, const std::vector<PlanningUse>& use) = 0;
  virtual void finish() = 0;
};

/// A store that is filled, and read afterwards.
class MoveTarget : public MoveReader, public MoveWriter {
 public:
  /// Returns the job as this store can keep it, where it has no place for some texts.
  virtual MovedJob storable(MovedJob job) const { return job; }
};

}  // namespace bahnwerk::server
