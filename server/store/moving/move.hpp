#pragma once
/// Moves all jobs of a store into another one, and compares them afterwards. Bytes are moved as they are packed, piece
/// by piece: memory does not grow with the store. After an interruption, of whatever kind, a further call goes on where
/// the last transaction ended.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "server/store/moving/move_ends.hpp"

namespace bahnwerk::server {

/// How far a call has come. `comparing` begins when all jobs are there.
struct MoveProgress {
  bool comparing = false;
  std::int64_t jobs = 0, of = 0;  ///< jobs so far, those of earlier calls included; jobs in the source
  std::int64_t bytes = 0;         ///< bytes of documents, results, setpoints and views so far, in this call
};

/// What was compared, and what differs. The store that was filled can be used if there are no faults.
struct MoveReport {
  std::int64_t jobs = 0, results = 0, chunks = 0, views = 0, keys = 0;
  std::int64_t bytes = 0;           ///< of documents, results, setpoints and views
  double seconds = 0;               ///< that moving took, in this call; the comparison follows
  double comparing = 0;             ///< seconds that comparing took
  std::int64_t moved_bytes = 0;     ///< of what this call has moved
  std::vector<std::string> faults;  ///< sentences, the first max_faults ones
};
inline constexpr std::size_t max_faults = 20;

/// Jobs and bytes of a transaction, at most but for the last one of each.
struct MoveBatch {
  std::size_t jobs = 500, bytes = 16 << 20;
};

/// Moves the jobs of `from`, whose name is `source`, into `to`, and compares both. `tell` is called after each
/// transaction and each page of the comparison. Throws StoreError where `to` has other jobs than those of an unfinished
/// move from this source.
MoveReport move_jobs(MoveReader& from, const std::string& source, MoveTarget& to,
                     const std::function<void(const MoveProgress&)>& tell, const MoveBatch& batch = {});

}  // namespace bahnwerk::server
