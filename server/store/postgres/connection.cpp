#include "server/store/postgres/connection.hpp"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <memory>

#include "server/store/postgres/servers.hpp"

namespace bahnwerk::server {
namespace {

constexpr int binary = 1;

constexpr auto session_start =
    "SET statement_timeout = '30s'; SET lock_timeout = '2s'; SET idle_in_transaction_session_timeout = '10s'; "
    "SET client_connection_check_interval = '2s'; SET jit = off; SET search_path = bahnwerk";

/// The first statement of each transaction of a pooled session: the same settings, and what the server would say over a
/// session of its own.
const PostgresStatement transaction_start{
    "SELECT pg_postmaster_start_time(), pg_is_in_recovery() OR current_setting('default_transaction_read_only') = "
    "'on', "
    "set_config('statement_timeout', '30s', true), set_config('lock_timeout', '2s', true), "
    "set_config('idle_in_transaction_session_timeout', '10s', true), "
    "set_config('client_connection_check_interval', '2s', true), set_config('jit', 'off', true), "
    "set_config('search_path', 'bahnwerk', true)"};
const PostgresStatement transaction_begin{"BEGIN"};

std::string version_text(int version) {
  return std::to_string(version / 10'000) + "." + std::to_string(version % 10'000);
}

std::string first_line(const char* message) {
  std::string text(message ? message : "");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int milliseconds_until(std::chrono::steady_clock::time_point until) {
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
}

}  // namespace

PostgresConnection::PostgresConnection(const std::string& url, PostgresPatience patience, PostgresSession session)
    : url_(url), patience_(patience), session_(session), since_(std::chrono::steady_clock::now()) {
  const PostgresServers servers = servers_of(url);
  std::unique_ptr<pg_conn, decltype(&PQfinish)> readable(nullptr, PQfinish);
  std::optional<std::int64_t> readable_start;
  std::string reasons;
  bool refused = true;
  for (std::size_t k = 0; k < servers.each.size(); ++k) {
    try {
      connect(servers.each[k], since_ + patience.brief * (k + 1) / servers.each.size());
      wants_to_write_ = servers.written;
      if (!stopgap()) return;
      if (readable) {
        PQfinish(std::exchange(connection_, nullptr));
        continue;
      }
      readable.reset(std::exchange(connection_, nullptr));
      readable_start = server_start_;
    } catch (const StoreAway& error) {
      refused = refused && dynamic_cast<const StoreRefused*>(&error);
      reasons.append(reasons.empty() ? "" : "; ").append(error.what());
    }
  }
  if (readable) {
    connection_ = readable.release();
    read_only_ = true;
    server_start_ = readable_start;
  } else if (refused) {
    throw StoreRefused(reasons);
  } else {
    throw StoreAway(reasons);
  }
}

void PostgresConnection::connect(const std::string& server, Time until) {
  const std::string seconds = std::to_string(std::max<std::int64_t>(2, patience_.brief.count() / 1000));
  const char* const words[] = {"dbname",          "fallback_application_name", "connect_timeout",  "client_encoding",
                               "keepalives_idle", "keepalives_interval",       "keepalives_count", nullptr};
  const char* const values[] = {server.c_str(), "bahnwerk", seconds.c_str(), "UTF8", "10", "5", "3", nullptr};
  connection_ = PQconnectStartParams(words, values, 1);
  if (!connection_) throw std::bad_alloc();
  for (PostgresPollingStatusType step = PGRES_POLLING_WRITING; step != PGRES_POLLING_OK;
       step = PQconnectPoll(connection_)) {
    const bool reading = step == PGRES_POLLING_READING;
    if (PQstatus(connection_) == CONNECTION_BAD || step == PGRES_POLLING_FAILED) {
      const std::string why = first_line(PQerrorMessage(connection_));
      // libpq gives no SQLSTATE here. What is not known to be a refusal may pass.
      static constexpr std::string_view refusals[] = {
          "authentication failed", "no password supplied",  "does not exist",
          "pg_hba.conf",           "permission denied for", "not permitted to log in",
          "no such database",      "no such user",          "unsupported startup parameter"};
      const bool refused = why.find("No such file") == std::string::npos &&
                           std::any_of(std::begin(refusals), std::end(refusals),
                                       [&](std::string_view each) { return why.find(each) != std::string::npos; });
      PQfinish(std::exchange(connection_, nullptr));
      if (refused) throw StoreRefused("the PostgreSQL server refuses the connection: " + why);
      throw StoreAway("the PostgreSQL server cannot be reached: " + why);
    }
    pollfd socket{PQsocket(connection_), static_cast<short>(reading ? POLLIN : POLLOUT), 0};
    if (::poll(&socket, 1, milliseconds_until(until)) == 0 && std::chrono::steady_clock::now() >= until)
      lose("it did not answer in time");
  }
  PQsetnonblocking(connection_, 1);
  PQsetNoticeProcessor(
      connection_, [](void*, const char*) {}, nullptr);
  try {
    if (const int version = PQserverVersion(connection_); version < least_version)
      throw StoreRefused("the PostgreSQL server has version " + version_text(version) + "; the store needs " +
                         version_text(least_version) + " or later");
    if (session_ == PostgresSession::own)
      script(session_start, until);
    else
      send({}, until);  // a pooler may answer for a server that is away
  } catch (...) {
    PQfinish(std::exchange(connection_, nullptr));
    throw;
  }
}

PostgresConnection::~PostgresConnection() { PQfinish(connection_); }

void PostgresConnection::lose(const std::string& why) {
  PQfinish(std::exchange(connection_, nullptr));
  throw StoreAway("the PostgreSQL server is away: " + why);
}

bool PostgresConnection::broken() const { return !connection_ || PQstatus(connection_) == CONNECTION_BAD; }

bool PostgresConnection::idle() {
  if (broken() || PQtransactionStatus(connection_) != PQTRANS_IDLE) return false;
  pollfd socket{PQsocket(connection_), POLLIN, 0};
  if (::poll(&socket, 1, 0) == 0) return true;
  return PQconsumeInput(connection_) == 1 && PQstatus(connection_) == CONNECTION_OK;  // a notice, or the end
}

/// Sends what is to be sent and waits until a result can be taken without waiting.
void PostgresConnection::wait(Time until) {
  if (!connection_) throw StoreAway("the PostgreSQL server is away");
  for (;;) {
    const int left = PQflush(connection_);
    if (left < 0) lose(first_line(PQerrorMessage(connection_)));
    if (PQisBusy(connection_) == 0) return;
    pollfd socket{PQsocket(connection_), static_cast<short>(POLLIN | (left > 0 ? POLLOUT : 0)), 0};
    const int ready = ::poll(&socket, 1, milliseconds_until(until));
    if (ready == 0 && std::chrono::steady_clock::now() >= until) lose("it did not answer in time");
    if (ready > 0 && (socket.revents & ~POLLOUT) != 0 && PQconsumeInput(connection_) == 0)
      lose(first_line(PQerrorMessage(connection_)));
  }
}

pg_result* PostgresConnection::next(Time until) {
  wait(until);
  return PQgetResult(connection_);
}

/// Throws the error of a result; takes it over.
void PostgresConnection::check(pg_result* result) {
  const ExecStatusType status = PQresultStatus(result);
  if (status != PGRES_FATAL_ERROR && status != PGRES_BAD_RESPONSE) return PQclear(result);
  const char* const code = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const std::string state = code ? code : "";
  const char* const primary = PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY);
  const std::string why = first_line(primary ? primary : PQresultErrorMessage(result));
  PQclear(result);
  if (PQstatus(connection_) == CONNECTION_BAD || state.empty()) lose(why);
  if (state == "53100") throw StoreError("no space left for the store", true);
  if (state == "40001" || state == "40P01") throw StoreConflict("the store is busy: " + why);
  if (state == "55P03" || state == "57014") throw StoreError("the store is busy: " + why, false, true);
  if (state.starts_with("57P") || state.starts_with("08")) lose(why);  // the server ends
  // A standby has no tables that are not logged [0A000].
  if (state == "25006" || (state == "0A000" && read_only())) throw StoreReadOnly("the store can be read only: " + why);
  throw StoreError("store: " + why + " (SQLSTATE " + state + ")", false);
}

std::vector<PostgresRows> PostgresConnection::send(const std::vector<PostgresStatement>& statements, Time until) {
  if (!connection_) throw StoreAway("the PostgreSQL server is away");
  std::vector<const PostgresStatement*> all;
  const bool starts = session_ == PostgresSession::pooled && PQtransactionStatus(connection_) == PQTRANS_IDLE;
  if (starts) all.push_back(&transaction_start);
  for (const PostgresStatement& statement : statements) all.push_back(&statement);
  std::vector<PostgresRows> rows = exchange(all, until);
  if (starts) {
    note(rows.front());
    rows.erase(rows.begin());
  }
  return rows;
}

/// Takes what a transaction of a pooled session has found. Another server, or one that has started again, counts as a
/// lost connection, because a pooler hides it: what the transaction did is unknown to the caller.
void PostgresConnection::note(const PostgresRows& start) {
  read_only_ = start.flag(0, 1);
  const std::int64_t since = start.time(0, 0);
  if (server_start_.value_or(since) != since) lose("it has started again");
  server_start_ = since;
}

void PostgresConnection::begin() {
  if (session_ == PostgresSession::own) return script("BEGIN", std::chrono::steady_clock::now() + patience_.brief);
  if (!connection_) throw StoreAway("the PostgreSQL server is away");
  note(exchange({&transaction_begin, &transaction_start}, std::chrono::steady_clock::now() + patience_.brief).at(1));
}

void PostgresConnection::commit_briefly() { script("COMMIT", std::chrono::steady_clock::now() + patience_.brief); }

std::vector<PostgresRows> PostgresConnection::exchange(const std::vector<const PostgresStatement*>& statements,
                                                       Time until) {
  const auto sent = [this](int done) {
    if (done == 0) lose(first_line(PQerrorMessage(connection_)));
  };
  sent(PQenterPipelineMode(connection_));
  const std::size_t known = prepared_.size();
  std::vector<bool> prepares;  // whether what was sent prepares a statement, or runs one
  for (const PostgresStatement* const statement : statements) {
    const auto& values = statement->parameters.values_;
    const auto count = static_cast<int>(values.size());
    std::vector<Oid> types;
    std::vector<const char*> data;
    std::vector<int> sizes;
    const std::vector<int> forms(values.size(), binary);
    for (const auto& value : values) {
      types.push_back(value.type);
      data.push_back(value.shared ? value.shared : value.own ? value.own->data() : nullptr);
      sizes.push_back(static_cast<int>(value.shared ? value.size : value.own ? value.own->size() : 0));
    }
    if (session_ == PostgresSession::pooled) {
      sent(PQsendQueryParams(connection_, std::string(statement->sql).c_str(), count, types.data(), data.data(),
                             sizes.data(), forms.data(), binary));
      prepares.push_back(false);
      continue;
    }
    auto found = std::find_if(prepared_.begin(), prepared_.end(),
                              [&](const auto& each) { return each.first == statement->sql; });
    if (found == prepared_.end()) {
      prepared_.emplace_back(std::string(statement->sql), "s" + std::to_string(prepared_.size()));
      found = std::prev(prepared_.end());
      sent(PQsendPrepare(connection_, found->second.c_str(), found->first.c_str(), count, types.data()));
      prepares.push_back(true);
    }
    sent(PQsendQueryPrepared(connection_, found->second.c_str(), count, data.data(), sizes.data(), forms.data(),
                             binary));
    prepares.push_back(false);
  }
  sent(PQpipelineSync(connection_));
  std::vector<PostgresRows> rows;
  pg_result* failed = nullptr;
  std::size_t good = known;  // statements that the server has prepared
  for (const bool prepare : prepares) {
    while (pg_result* const result = next(until)) {
      const ExecStatusType status = PQresultStatus(result);
      if (status == PGRES_FATAL_ERROR && !failed) {
        failed = result;
        continue;
      }
      if (prepare && status == PGRES_COMMAND_OK) ++good;
      if (!prepare && (status == PGRES_TUPLES_OK || status == PGRES_COMMAND_OK))
        rows.emplace_back(result);
      else
        PQclear(result);
      if (PQstatus(connection_) == CONNECTION_BAD) break;
    }
    if (PQstatus(connection_) == CONNECTION_BAD) break;
  }
  prepared_.resize(good);
  if (PQstatus(connection_) == CONNECTION_BAD) {
    const std::string why = first_line(failed ? PQresultErrorMessage(failed) : PQerrorMessage(connection_));
    PQclear(failed);
    lose(why);
  }
  // The end of the group is a result of its own. An error before it may be one of the commit, as of a deferred
  // constraint.
  for (;;) {
    pg_result* const result = next(until);
    if (!result) continue;
    const ExecStatusType status = PQresultStatus(result);
    if (status == PGRES_FATAL_ERROR && !failed) {
      failed = result;
      if (PQstatus(connection_) == CONNECTION_BAD) check(failed);
      continue;
    }
    PQclear(result);
    if (status == PGRES_PIPELINE_SYNC) break;
  }
  sent(PQexitPipelineMode(connection_));
  if (failed) check(failed);
  return rows;
}

PostgresRows PostgresConnection::run(std::string_view sql, const PostgresParameters& parameters) {
  return send({{sql, parameters}}, std::chrono::steady_clock::now() + patience_.brief).at(0);
}
PostgresRows PostgresConnection::run_lengthy(std::string_view sql, const PostgresParameters& parameters) {
  return send({{sql, parameters}}, std::chrono::steady_clock::now() + patience_.lengthy).at(0);
}
std::vector<PostgresRows> PostgresConnection::run_all(const std::vector<PostgresStatement>& statements) {
  if (statements.empty()) return {};
  return send(statements, std::chrono::steady_clock::now() + patience_.brief);
}
std::vector<PostgresRows> PostgresConnection::run_all_lengthy(const std::vector<PostgresStatement>& statements) {
  if (statements.empty()) return {};
  return send(statements, std::chrono::steady_clock::now() + patience_.lengthy);
}

std::vector<std::string> PostgresConnection::wait_for_signals(int wake, Time until) {
  std::vector<std::string> contents;
  for (;;) {
    if (!connection_) throw StoreAway("the PostgreSQL server is away");
    while (PGnotify* const signal = PQnotifies(connection_)) {
      contents.emplace_back(signal->extra);
      PQfreemem(signal);
    }
    if (!contents.empty()) return contents;
    pollfd sockets[] = {{PQsocket(connection_), POLLIN, 0}, {wake, POLLIN, 0}};
    const int ready = ::poll(sockets, 2, milliseconds_until(until));
    if (sockets[0].revents != 0 && PQconsumeInput(connection_) == 0) lose(first_line(PQerrorMessage(connection_)));
    if (sockets[1].revents != 0 || (ready == 0 && std::chrono::steady_clock::now() >= until)) {
      if (sockets[0].revents == 0) return contents;
      until = std::chrono::steady_clock::now();
    }
  }
}

std::unique_ptr<PostgresConnection> PostgresConnection::another(PostgresPatience patience) const {
  return std::make_unique<PostgresConnection>(url_, patience, session_);
}

void PostgresConnection::without_timeouts() {
  // A pooler gives what is outside of transactions a session as the server makes it.
  if (session_ == PostgresSession::own) script("SET statement_timeout = 0; SET lock_timeout = 0");
}

bool PostgresConnection::read_only() const {
  if (session_ == PostgresSession::pooled) return connection_ && read_only_;
  const char* const standby = connection_ ? PQparameterStatus(connection_, "in_hot_standby") : nullptr;
  const char* const set = connection_ ? PQparameterStatus(connection_, "default_transaction_read_only") : nullptr;
  const auto on = [](const char* value) { return value && std::string_view(value) == "on"; };
  return on(standby) || on(set);
}

void PostgresConnection::script(const std::string& sql) {
  script(sql, std::chrono::steady_clock::now() + patience_.lengthy);
}

void PostgresConnection::script(const std::string& sql, Time until) {
  if (!connection_) throw StoreAway("the PostgreSQL server is away");
  if (PQsendQuery(connection_, sql.c_str()) == 0) lose(first_line(PQerrorMessage(connection_)));
  pg_result* failed = nullptr;
  while (pg_result* const result = next(until)) {
    if (PQresultStatus(result) == PGRES_FATAL_ERROR && !failed)
      failed = result;
    else
      PQclear(result);
  }
  if (failed) check(failed);
}

void PostgresConnection::rollback() noexcept {
  try {
    if (!broken() && PQtransactionStatus(connection_) != PQTRANS_IDLE) script("ROLLBACK");
  } catch (const std::exception&) {  // the server has rolled back what it lost
  }
}

}  // namespace bahnwerk::server
