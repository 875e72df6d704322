/// PostgresStore: posted jobs. Threads take what waits and store it together, so that waiting posts share
/// a commit.
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "server/runtime/clock.hpp"
#include "server/store/codec.hpp"
#include "server/store/postgres/post.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t brief_bytes = 1 << 20;
constexpr std::size_t posts_at_once = 64;

/// The key is inserted first: of two posts with one key at once, the second one waits for the first and then inserts
/// nothing. An id that exists was inserted by the same post, whose answer was lost. Isolation: READ COMMITTED.
/// Transactions at once may give one turn twice, which is no harm. Owners take turns as in the SQLite store
/// [start-time fair queueing: Goyal, Vin, Cheng 1996].
constexpr auto insert_job =
    "WITH kept AS ("
    "INSERT INTO idempotency_keys (owner, key, body_hash, id) SELECT coalesce($5, ''), $15, $16, $1 "
    "WHERE $15 IS NOT NULL ON CONFLICT DO NOTHING RETURNING 1), "
    "job AS ("
    "INSERT INTO jobs (id, kind, name, reference, owner, tags, rank, turn, needs, deadline, time_budget, state, "
    "created_at, callback, callback_secret, callback_receiver) "
    "SELECT $1, $2, $3, $4, $5, $6, $7, CASE WHEN $5 IS NULL THEN 0 ELSE greatest("
    "coalesce((SELECT max(turn) + 1 FROM jobs WHERE state = 'queued' AND owner = $5 AND rank = $7), 0), "
    "coalesce((SELECT min(turn) FROM jobs WHERE state = 'queued' AND rank = $7), 0)) END, "
    "$8, $9, $10, 'queued', $11, $12, $13, $14 WHERE $15 IS NULL OR EXISTS (SELECT FROM kept) "
    "ON CONFLICT (id) DO NOTHING RETURNING id, owner, tags), "
    "spec AS (INSERT INTO specs (id, document, checked) SELECT id, $17, $18 FROM job), "
    "tagged AS (INSERT INTO job_tags (owner, tag, id) SELECT who.owner, tag, job.id FROM job, unnest(job.tags) AS tag, "
    "LATERAL (SELECT '' AS owner UNION SELECT job.owner WHERE job.owner IS NOT NULL) AS who), "
    "told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job), "
    "counted AS (INSERT INTO count_deltas (state, owner, jobs) SELECT 'queued', coalesce(owner, ''), 1 FROM job) "
    "SELECT count(*) FROM job";

using KeyName = std::pair<std::string, std::string>;  ///< owner and key

}  // namespace

void PostgresStore::insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) {
  Post post;
  post.packed = pack_text(job.request.document);
  job.request.document = std::string();
  post.job = std::move(job);
  post.done = std::move(done);
  {
    const std::lock_guard lock(ids_mutex_);
    post.id = ids_.next(post.job.now);
  }
  {
    const std::lock_guard lock(mutex_);
    posts_.push_back(std::move(post));
  }
  wake_.notify_one();
}

void PostgresStore::write() {
  for (;;) {
    std::vector<Post> posts;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || !posts_.empty(); });
      if (posts_.empty()) return;
      while (!posts_.empty() && posts.size() < posts_at_once) {
        posts.push_back(std::move(posts_.front()));
        posts_.pop_front();
      }
    }
    store_posts(posts);
  }
}

void PostgresStore::store_posts(std::vector<Post>& group) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Post*> all;
  for (Post& post : group) all.push_back(&post);
  // Keys are locked in their order, so that no two groups wait for each other.
  std::stable_sort(all.begin(), all.end(), [](const Post* a, const Post* b) {
    return std::tie(a->job.owner, a->job.idempotency_key) < std::tie(b->job.owner, b->job.idempotency_key);
  });
  bool away = false;
  const auto try_to = [&](const std::vector<Post*>& some) -> std::exception_ptr {
    try {
      // Repeated, it finds what was stored before.
      with_connection(true, [&](PostgresConnection& connection) { store_group(connection, some); });
      return nullptr;
    } catch (const StoreAway&) {
      away = true;
      return std::current_exception();
    } catch (...) {
      return std::current_exception();
    }
  };
  const auto end = [&](const std::vector<Post*>& some, const std::exception_ptr& error) {
    std::vector<Changed> changes;
    for (const Post* post : some)
      if (!error && post->outcome.what == Inserted::What::created)
        changes.push_back({.id = post->id, .state = api::JobState::queued});
    if (!error) options_.observer(seconds_since(start), some.size());
    publish(changes);
    for (Post* post : some) post->done(post->outcome, error);
  };
  const std::exception_ptr error = try_to(all);
  if (!error || away || all.size() == 1) return end(all, error);
  for (Post* post : all) end({post}, try_to({post}));  // one bad post must not fail its neighbours
}

void PostgresStore::store_group(PostgresConnection& connection, std::vector<Post*> group) {
  // What the posts are decided by, as it was when the group began; posts of the group are counted on top of it.
  const auto key_of = [](const Post& post) { return KeyName(post.job.owner.value_or(""), post.job.idempotency_key); };
  std::map<KeyName, std::pair<std::string, std::string>> known;  // hash, id
  std::vector<std::string> key_owners, keys;
  std::set<std::pair<std::string, std::int64_t>> quotas;
  for (const Post* post : group) {
    if (!post->job.idempotency_key.empty()) {
      key_owners.push_back(post->job.owner.value_or(""));
      keys.push_back(post->job.idempotency_key);
    }
    if (post->job.owner && (post->job.max_owned || post->job.max_planning_ms))
      quotas.emplace(*post->job.owner, post->job.now / ms_per_day);
  }
  Statements queries;
  queries.push_back({"SELECT coalesce(sum(jobs), 0)::bigint FROM count_deltas WHERE state = 'queued'"});
  queries.push_back(
      {"SELECT owner, key, body_hash, id FROM idempotency_keys WHERE (owner, key) IN (SELECT * FROM unnest($1, $2))",
       PostgresParameters().texts(key_owners).texts(keys)});
  for (const auto& [owner, day] : quotas)
    queries.push_back(
        {"SELECT coalesce(sum(jobs), 0)::bigint, coalesce((SELECT ms FROM planning_use WHERE owner = $1 "
         "AND day = $2), 0) FROM count_deltas WHERE state = 'queued' AND owner = $1",
         PostgresParameters() << owner << day});
  const auto rows = connection.run_all(queries);
  auto queued = static_cast<std::size_t>(std::max<std::int64_t>(0, rows[0].integer(0, 0)));
  for (std::size_t row = 0; row < rows[1].size(); ++row)
    known[{rows[1].text(row, 0), rows[1].text(row, 1)}] = {rows[1].text(row, 2), rows[1].uuid(row, 3)};
  std::map<std::pair<std::string, std::int64_t>, std::pair<std::int64_t, std::int64_t>> used;  // jobs queued, ms spent
  std::size_t at = 2;
  for (const auto& quota : quotas) {
    used[quota] = {rows[at].integer(0, 0), rows[at].integer(0, 1)};
    ++at;
  }

  Statements inserts;
  std::size_t bytes = 0;
  std::vector<Post*> inserted;
  for (Post* post : group) {
    const NewJob& job = post->job;
    const api::JobRequest& r = job.request;
    const auto keyed = job.idempotency_key.empty() ? known.end() : known.find(key_of(*post));
    if (keyed != known.end()) {
      const auto& [hash, id] = keyed->second;
      if (id == post->id)
        post->outcome = {Inserted::What::created, id};
      else
        post->outcome =
            hash == job.body_hash ? Inserted{Inserted::What::replayed, id} : Inserted{Inserted::What::conflict, ""};
      continue;
    }
    auto quota = job.owner ? used.find({*job.owner, job.now / ms_per_day}) : used.end();
    if (queued >= job.max_queued) {
      post->outcome = {Inserted::What::full, ""};
      continue;
    }
    if (quota != used.end() && job.max_owned && quota->second.first >= *job.max_owned) {
      post->outcome = {Inserted::What::owner_full, ""};
      continue;
    }
    if (quota != used.end() && job.max_planning_ms && quota->second.second >= *job.max_planning_ms) {
      post->outcome = {Inserted::What::planning_spent, ""};
      continue;
    }
    ++queued;
    if (quota != used.end()) ++quota->second.first;
    PostgresParameters values;
    values.uuid(post->id) << r.kind << r.name << r.reference << job.owner;
    values.texts(r.tags.empty() ? std::nullopt : std::optional(r.tags))
        << std::int64_t{-r.priority} << std::int64_t{options_.engine};
    values.time(r.deadline) << r.time_budget;
    values.time(job.now) << (r.callback ? std::optional(r.callback->url) : std::nullopt)
                         << (r.callback ? r.callback->secret : std::nullopt) << job.callback_receiver
                         << (job.idempotency_key.empty() ? std::nullopt : std::optional(job.idempotency_key))
                         << job.body_hash;
    values.bytes(post->packed) << r.checked;
    inserts.push_back({insert_job, std::move(values)});
    inserted.push_back(post);
    bytes += post->packed.size();
  }
  // One transaction; large documents take their time.
  const auto results = bytes <= brief_bytes ? connection.run_all(inserts) : connection.run_all_lengthy(inserts);
  std::vector<Post*> again;
  for (std::size_t k = 0; k < inserted.size(); ++k) {
    Post& post = *inserted[k];
    if (results[k].integer(0, 0) == 1 || post.job.idempotency_key.empty())
      post.outcome = {Inserted::What::created, post.id};
    else
      again.push_back(&post);  // another post with its key came first: it is found now
  }
  if (!again.empty()) store_group(connection, std::move(again));
}

}  // namespace bahnwerk::server
