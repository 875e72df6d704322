#include "server/cli/serve_options.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <string_view>

#include "server/cli/typed_options.hpp"
#include "server/runtime/memory.hpp"

namespace bahnwerk::server::cli {
namespace {

/// Returns the variable of the environment that stands for a flag.
std::string variable_of(const CLI::Option& option) {
  std::string name = "BAHNWERK_";
  for (const char c : option.get_lnames().front()) name += c == '-' ? '_' : static_cast<char>(std::toupper(c));
  return name;
}

}  // namespace

std::string unknown_variable(const CLI::App& serve) {
  static constexpr std::array<std::string_view, 8> others{"BAHNWERK_SERVER", "BAHNWERK_SERVICE_", "BAHNWERK_PORT",
                                                          "BAHNWERK_TEST_",  "BAHNWERK_KEY",      "BAHNWERK_CA",
                                                          "BAHNWERK_CERT",   "BAHNWERK_CERT_KEY"};
  for (char** each = environ; *each != nullptr; ++each) {
    const std::string_view line(*each), name = line.substr(0, line.find('='));
    if (!name.starts_with("BAHNWERK_")) continue;
    if (std::any_of(others.begin(), others.end(), [&](auto other) { return name.starts_with(other); })) continue;
    const auto options = serve.get_options();
    const auto stands_for = [&](const CLI::Option* option) { return option->get_envname() == name; };
    if (std::none_of(options.begin(), options.end(), stands_for)) return std::string(name);
  }
  return "";
}

void add_password_file(CLI::App& app, std::string& file) {
  CLI::Option* option =
      app.add_option("--store-password-file", file,
                     "a file whose first line is the password for the PostgreSQL server, to keep it out of the URL");
  option->type_name("FILE")->envname(variable_of(*option));
}

void add_serve_options(CLI::App& app, ServiceOptions& options, std::string& level, std::string& password_file) {
  const auto env = [](CLI::Option* option) { option->envname(variable_of(*option)); };
  env(app.add_option("--listen", options.listen,
                     "address to serve on; port 0 picks a free one; unix:PATH is a Unix socket")
          ->type_name("HOST:PORT"));
  env(app.add_option_function<std::string>(
             "--socket-mode",
             [&options](const std::string& text) {
               unsigned mode = 0;
               const auto read = std::from_chars(text.data(), text.data() + text.size(), mode, 8);
               if (read.ec != std::errc() || read.ptr != text.data() + text.size() || mode > 0777)
                 throw CLI::ValidationError("--socket-mode", "must be permissions such as 660");
               options.socket_mode = mode;
             },
             "permissions of a Unix socket")
          ->default_str("660")
          ->type_name("OCTAL"));
  env(app.add_flag("--insecure-listen", options.insecure_listen,
                   "serve other machines without a key: something else keeps out who may not ask"));
  env(app.add_option("--tls-cert", options.tls.certificate,
                     "certificate, with its chain, PEM: speaks TLS 1.2 and 1.3; read again on SIGHUP")
          ->type_name("FILE"));
  env(app.add_option("--tls-key", options.tls.key, "key of the certificate, PEM")->type_name("FILE"));
  env(app.add_option("--tls-client-ca", options.tls.client_ca,
                     "authority, PEM: clients need a certificate that it has signed, beside their key")
          ->type_name("FILE"));
  env(app.add_option(
             "--trusted-proxy", options.trusted_proxies,
             "a proxy whose X-Forwarded-For, -Proto and -Prefix count, as often as needed: an address, a network "
             "(10.0.0.0/8), or unix for those that come by the Unix socket")
          ->delimiter(',')
          ->type_name("ADDRESS"));
  env(app.add_option("--cors-origin", options.cors_origins,
                     "a site whose pages may use this service, as often as needed: https://planning.example.com")
          ->delimiter(',')
          ->type_name("ORIGIN"));
  env(app.add_option("--callback-host", options.callback_hosts,
                     "a host that jobs may have called when they have ended, as often as needed: a name or an address; "
                     "*.NAME or *, at public addresses alone")
          ->delimiter(',')
          ->type_name("HOST"));
  env(app.add_option("--store", options.store, "where jobs live: sqlite:PATH, or postgresql://USER@HOST/DATABASE")
          ->type_name("URL"));
  add_password_file(app, password_file);
  env(app.add_option("--store-connections", options.shared_store.connections,
                     "most connections to the PostgreSQL server; by default 8, and 4 with --role worker")
          ->check(CLI::Range(4, 1'000))
          ->default_str(""));
  env(app.add_option_function<std::string>(
             "--store-notify", [&options](const std::string& text) { options.shared_store.signals = text == "on"; },
             "on = processes that share a PostgreSQL store tell each other of changes at once; off = they ask for them "
             "four times a second")
          ->check(CLI::IsMember({"on", "off"}))
          ->default_str("on"));
  env(app.add_option_function<std::string>(
             "--store-prepared", [&options](const std::string& text) { options.shared_store.pooled = text == "off"; },
             "on = statements are prepared once per connection to the PostgreSQL server; off = a pooler may give each "
             "transaction another session of the server, such as PgBouncer with pool_mode = transaction")
          ->check(CLI::IsMember({"on", "off"}))
          ->default_str("on"));
  env(app.add_option("--store-listen-url", options.shared_store.listen_url,
                     "the PostgreSQL server itself, for signals of other processes, which such a pooler does not pass "
                     "on; without it they are asked for four times a second")
          ->type_name("URL"));
  env(app.add_option_function<std::string>(
             "--store-migrate", [&options](const std::string& text) { options.shared_store.migrate = text == "auto"; },
             "auto = a store of an older version is brought up to date at the start; never = it is refused until "
             "`bahnwerk migrate` has done it")
          ->check(CLI::IsMember({"auto", "never"}))
          ->default_str("auto"));
  env(add_bytes(app, "--store-reserve", options.store_reserve,
                "disk space set aside beside the store, so that jobs can be deleted when the disk is full; bytes or "
                "with a suffix: 8MiB",
                0));
  env(add_keeping_time(app, "--keep-for", options.retention.time,
                       "that ended jobs are kept, then they are removed: 30d, 12h; by default for ever"));
  env(app.add_option("--keep-jobs", options.retention.jobs, "ended jobs that are kept, the latest ones")
          ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}))
          ->default_str(""));
  env(add_bytes(app, "--keep-bytes", options.retention.bytes,
                "room of the store: beyond it the jobs that ended first are removed; bytes or with a suffix: 50GiB",
                std::size_t{1} << 20)
          ->default_str(""));
  env(app.add_option(
             "--machines", options.machines,
             "folder with machines of the plant, a JSON file each, which /v1/machines offers beside the shipped "
             "ones; one of the same name replaces a shipped one")
          ->type_name("DIR"));
  env(app.add_option("--workers", options.workers, "planner threads; 0 accepts jobs without planning them")
          ->check(CLI::Range(0, 1024)));
  env(app.add_option("--worker-nice", options.worker_nice,
                     "priority of planner threads below those that answer, 0 to 19")
          ->check(CLI::Range(0, 19)));
  env(add_bytes(app, "--max-memory", options.max_memory,
                "memory of the whole process, bytes or with a suffix: 3GiB; by default three quarters of the cgroup's "
                "limit, else of the machine's")
          ->default_str(""));
  env(add_seconds(app, "--max-planning-time", options.max_planning,
                  "of a plan, whatever its time_budget, then the job ends as budget-exhausted"));
  const std::map<std::string, Role> roles{{"all", Role::all}, {"api", Role::api}, {"worker", Role::worker}};
  env(app.add_option("--role", options.role,
                     "all = serve and plan; with a store that processes share, api = serve alone, and worker = plan, "
                     "and answer /healthz, /readyz and /metrics alone")
          ->transform(CLI::CheckedTransformer(roles).description("{all,api,worker}"))
          ->type_name("TEXT")
          ->default_str("all"));
  env(app.add_option("--http-threads", options.http_threads, "socket threads")->check(CLI::Range(1, 64)));
  env(app.add_option("--max-queued", options.max_queued, "waiting jobs before new ones are refused (429)")
          ->check(CLI::Range(1, 1'000'000'000)));
  env(add_bytes(app, "--max-body", options.limits.max_body, "largest request body, bytes or with a suffix: 64MiB"));
  env(add_bytes(app, "--max-bodies", options.limits.max_bodies,
                "bytes of all request bodies in hand at one time before further ones are refused (503)"));
  env(app.add_option("--allowed-host", options.allowed_hosts,
                     "a name by which clients ask for this service, as often as needed; others get 403. Without it: "
                     "beyond loopback every name, on loopback its names")
          ->delimiter(',')
          ->type_name("NAME"));
  env(app.add_option("--max-connections", options.limits.max_connections,
                     "open connections; one more and the longest idle is closed, or the new one refused (503)")
          ->check(CLI::Range(1, 1'000'000)));
  env(app.add_option("--max-connections-per-address", options.limits.max_per_address,
                     "the same for one address (IPv6: one /64); 0 = no limit")
          ->check(CLI::Range(0, 1'000'000)));
  env(app.add_option("--spare-connections", options.limits.spare_connections,
                     "connections beyond the limit, for /healthz and /readyz alone")
          ->check(CLI::Range(0, 1'000)));
  env(add_seconds(app, "--header-timeout", options.limits.header_timeout,
                  "for a request's header, from connecting on (408)"));
  env(add_seconds(app, "--body-timeout", options.limits.body_timeout,
                  "for a request's body, plus 1 s per 100 kB received (408)"));
  env(add_seconds(app, "--stall-timeout", options.limits.stall_timeout,
                  "after which a body that stands still makes room for another connection", 0));
  env(add_seconds(app, "--idle-timeout", options.limits.idle_timeout, "between requests of a connection"));
  env(add_seconds(app, "--write-timeout", options.limits.write_timeout,
                  "for each piece of an answer, plus 1 s per 100 kB"));
  env(add_seconds(app, "--drain-timeout", options.drain_timeout, "that running jobs may go on after SIGTERM", 0));
  env(add_seconds(app, "--event-heartbeat", options.event_heartbeat,
                  "of silence on a stream of events, then a comment says that it is alive"));
  env(app.add_option("--log-level", level, "least level logged")
          ->check(CLI::IsMember({"debug", "info", "warn", "error"})));
  const std::map<std::string, LoggedRequests> logged{
      {"all", LoggedRequests::all}, {"errors", LoggedRequests::errors}, {"none", LoggedRequests::none}};
  env(app.add_option("--log-requests", options.logged_requests,
                     "which requests get a line: all, errors (answered with 400 and more), none")
          ->transform(CLI::CheckedTransformer(logged).description("{all,errors,none}"))
          ->type_name("TEXT")
          ->default_str("all"));
}

}  // namespace bahnwerk::server::cli
