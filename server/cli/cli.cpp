#include "server/cli/cli.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>
#include <tuple>

#include "api/kind.hpp"
#include "api/setpoints/setpoints.hpp"
#include "server/cli/serve_options.hpp"
#include "server/cli/typed_options.hpp"
#include "server/runtime/log.hpp"
#include "server/runtime/memory.hpp"
#include "server/store/open/move_store.hpp"
#include "server/store/store_url.hpp"

namespace bahnwerk::server::cli {
namespace {

int run_serve(const CLI::App& app, ServiceOptions options, const std::string& level) {
  if (const std::string name = unknown_variable(app); !name.empty()) {
    std::cerr << "bahnwerk: " << name << " is no setting; `bahnwerk serve --help` lists them\n";
    return exit_usage;
  }
  using log::Level;
  log::set_level(level == "debug"   ? Level::debug
                 : level == "warn"  ? Level::warn
                 : level == "error" ? Level::error
                                    : Level::info);
  if (options.max_memory < min_memory) {
    std::cerr << "bahnwerk: --max-memory " << options.max_memory << " is too little to serve; at least "
              << (min_memory >> 20) << "MiB are needed\n";
    return exit_usage;
  }
  if (options.role == Role::worker && app.count("--store-connections") == 0) options.shared_store.connections = 4;
  return serve(std::move(options));
}

}  // namespace

int run(int argc, char** argv, const BuildInfo& build) {
  CLI::App app{"Bahnwerk: plans motions from contours to verified setpoints."};
  app.set_version_flag("--version", to_string(build));
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();

  ServiceOptions options;
  options.build = build;
  options.max_memory = default_memory_limit(memory_of_host());
  options.workers = std::max(2U, std::thread::hardware_concurrency()) - 1;
  std::string level = "info", job, contour, out, id, format = "csv", layout, frame, key;
  std::string store = options.store, password_file, file, from, to;
  Remote remote;
  std::string name, scope = "submit,read";
  std::optional<std::int64_t> max_queued;
  std::chrono::milliseconds patience{60'000}, max_planning{0};
  bool wait = false, ready = false;

  CLI::App* serve_command =
      app.add_subcommand("serve", "runs the service; every flag also as environment variable BAHNWERK_...");
  add_serve_options(*serve_command, options, level, password_file);
  const auto add_contour = [&](CLI::App* command) {
    command
        ->add_option("--contour", contour, "part program or drawing (.dxf) to take instead of the document's contour")
        ->type_name("FILE");
  };
  CLI::App* plan_command = app.add_subcommand("plan", "plans a job document offline, prints the result document");
  plan_command->add_option("job", job, "job document, - for stdin")->required()->capture_default_str();
  add_contour(plan_command);
  CLI::Option* out_option =
      plan_command->add_option("--out", out, "directory for result.json, setpoints.csv and drawings")->type_name("DIR");
  std::vector<std::string> layouts{"plain", "twincat", "twincat_poses"};
  std::string kind_layouts;
  for (const auto& kind : api::kinds()) {
    layouts.insert(layouts.end(), kind.files.layouts.begin(), kind.files.layouts.end());
    if (!kind.files.layouts.empty())
      kind_layouts.append("; of kind ").append(kind.name).append(": a ").append(kind.files.title);
  }
  const auto add_layout = [&](CLI::App* command) {
    return command
        ->add_option("--layout", layout,
                     "of csv: plain, twincat (axes, their velocities, brake; semicolons), twincat_poses (the tool's "
                     "pose and its rates instead)" +
                         kind_layouts)
        ->check(CLI::IsMember(layouts));
  };
  const auto add_frame = [&](CLI::App* command) {
    return command
        ->add_option("--frame", frame,
                     "of the columns of a pose: part, or base, the machine's own (default: base with twincat_poses)")
        ->check(CLI::IsMember({"part", "base"}));
  };
  add_layout(plan_command)->needs(out_option);
  add_frame(plan_command)->needs(out_option);
  std::vector<std::string> drives;
  plan_command
      ->add_option("--drives", drives,
                   "a file of its own for the coarse or the fine drives, which begin so many s later: coarse=0, "
                   "fine=0.004; again for the other ones")
      ->type_name("GROUP=DELAY")
      ->needs(out_option);
  const auto add_server = [&](CLI::App* command) {
    command->add_option("--server", remote.server, "where the service is: http://, https:// or unix:PATH")
        ->envname("BAHNWERK_SERVER")
        ->type_name("URL");
    command->add_option("--key", remote.key, "the key to send; --key-file keeps it out of the list of processes")
        ->envname("BAHNWERK_KEY");
    command->add_option("--key-file", remote.key_file, "a file with the key in its first line")
        ->envname("BAHNWERK_KEY_FILE")
        ->type_name("FILE");
    command
        ->add_option("--ca", remote.ca,
                     "authorities that the server's certificate may come from, PEM; by default the system's")
        ->envname("BAHNWERK_CA")
        ->type_name("FILE");
    command->add_option("--cert", remote.certificate, "certificate to show the server, PEM")
        ->envname("BAHNWERK_CERT")
        ->type_name("FILE");
    command->add_option("--cert-key", remote.certificate_key, "key of that certificate, PEM")
        ->envname("BAHNWERK_CERT_KEY")
        ->type_name("FILE");
  };
  const auto add_patience = [&](CLI::App* command) {
    add_seconds(*command, "--patience", patience,
                "how long a server that has answered once is asked again when it does not, as in a restart", 0);
  };
  CLI::App* submit_command =
      app.add_subcommand("submit", "posts a job document, prints the job (with --wait: the result)");
  submit_command->add_option("job", job, "job document, - for stdin")->required();
  add_contour(submit_command);
  submit_command->add_flag("--wait", wait, "waits for the end");
  submit_command->add_option("--idempotency-key", key,
                             "the same key and document give the same job; one is made if none is given");
  add_server(submit_command);
  add_patience(submit_command);
  CLI::App* watch_command = app.add_subcommand("watch", "follows a job to its end, prints it");
  watch_command->add_option("id", id, "the job")->required();
  add_server(watch_command);
  add_patience(watch_command);
  CLI::App* fetch_command = app.add_subcommand("fetch", "prints a job's setpoints");
  fetch_command->add_option("id", id, "the job")->required();
  fetch_command->add_option("--format", format, "csv, ndjson or f64 (little-endian doubles, row-major)")
      ->check(CLI::IsMember({"csv", "ndjson", "f64", "json"}));
  add_layout(fetch_command);
  add_frame(fetch_command);
  add_server(fetch_command);
  CLI::App* health_command = app.add_subcommand("health", "asks whether the service lives, for container checks");
  health_command->add_flag("--ready", ready, "whether it takes jobs, too: its store answers, and it does not end");
  add_server(health_command);
  const auto add_store = [&](CLI::App* command) {
    command->add_option("--store", store, "where jobs live: sqlite:PATH, or postgresql://USER@HOST/DATABASE")
        ->envname("BAHNWERK_STORE")
        ->type_name("URL");
    add_password_file(*command, password_file);
  };
  CLI::App* backup_command = app.add_subcommand("backup", "copies the store into a file, also while the service runs");
  backup_command->add_option("file", file, "where the copy goes; it is replaced as a whole")->required();
  add_store(backup_command);
  CLI::App* check_command =
      app.add_subcommand("check", "checks whether a store is whole, also while the service runs, or a backup of it");
  add_store(check_command);
  CLI::App* migrate_command = app.add_subcommand("migrate",
                                                 "brings the schema of a store up to date, for those who serve with "
                                                 "--store-migrate never, or as a user of PostgreSQL who may not");
  add_store(migrate_command);
  CLI::App* move_command = app.add_subcommand(
      "migrate-store",
      "moves all jobs and keys from an SQLite store to a PostgreSQL store, or back, and compares both; no service may "
      "use them meanwhile. Interrupted, the same command goes on where it was");
  for (auto& [flag, value, text] : {std::tuple{"from", &from, "where jobs are: PATH, sqlite:PATH or postgresql://…"},
                                    std::tuple{"to", &to, "where they shall be: a store without jobs"}})
    move_command->add_option(flag, *value, text)->required()->type_name("URL");
  add_password_file(*move_command, password_file);
  CLI::App* key_command = app.add_subcommand("key", "adds, lists and removes keys, also while the service runs");
  key_command->require_subcommand(1);
  CLI::App* add_command = key_command->add_subcommand("add", "makes a key and prints it, once");
  add_command->add_option("name", name, "whose it is: jobs belong to the name, and several keys may have one")
      ->required();
  add_command
      ->add_option("--scope", scope,
                   "what it may do: submit (post, cancel and delete its name's jobs), read (see them), admin "
                   "(everything), with commas")
      ->type_name("LIST");
  add_command->add_option("--max-queued", max_queued, "jobs of the name that may wait before this key gets 429")
      ->check(CLI::Range(1, 1'000'000'000));
  add_seconds(*add_command, "--max-planning", max_planning,
              "of planning on the name's jobs per day (UTC) before this key gets 429; 0 = no limit", 0);
  add_store(add_command);
  CLI::App* list_command =
      key_command->add_subcommand("list", "prints the keys, removed ones included, not their texts");
  add_store(list_command);
  CLI::App* remove_command =
      key_command->add_subcommand("remove", "ends the validity of keys within a second")->alias("revoke");
  remove_command->add_option("name", name, "a name, for all its keys, or the id of one")->required();
  add_store(remove_command);
  const std::pair<CLI::App*, const char*> exit_codes[] = {
      {serve_command, "0 ended in order, 1 a planner did not stop in time, 2 could not start"},
      {plan_command, "0 planned and verified, 1 planning failed (problem document on stdout), 2 bad input or usage"},
      {submit_command,
       "0 posted (with --wait: planned and verified), 1 with --wait: planning failed or was cancelled, 2 refused, bad "
       "input or usage, 3 no server reached, or it cannot serve now (429, 5xx)"},
      {watch_command,
       "0 succeeded, 1 planning failed or was cancelled, 2 refused or bad usage, 3 no server reached, or it cannot "
       "serve now (429, 5xx)"},
      {fetch_command,
       "0 printed, 1 the job failed or was cancelled, 2 refused or bad usage, 3 no server reached, or it cannot serve "
       "now (429, 5xx)"},
      {health_command, "0 it lives (with --ready: and takes jobs), 2 bad usage, 3 no server reached, or not ready"},
      {backup_command, "0 copied, 2 not: no such store, no room, bad usage"},
      {add_command, "0 added, 2 not: bad usage, or the store cannot be changed"},
      {list_command, "0 listed, 2 no such store, bad usage"},
      {remove_command, "0 removed, 2 there is no such key, or bad usage"},
      {migrate_command, "0 up to date, 2 not: a service has the file, no such server, no permission, bad usage"},
      {move_command,
       "0 moved, and both stores agree; 1 they differ (listed on stdout); 2 not moved: a store is in use, the second "
       "one has jobs, no such store or server, no room, bad usage"},
      {check_command, "0 whole, 1 damaged, 2 no such store, bad usage"}};
  for (const auto& [command, codes] : exit_codes) {
    command->footer("Exit codes: " + std::string(codes) + ".");
    // Makes a command read its own environment variables when it is parsed. Without it all commands read theirs after
    // that, also those that were not called: they share variables, and the environment won over a flag.
    command->parse_complete_callback([] {});
  }
  app.footer(
      "A flag wins over its environment variable. Exit codes: 0 done, 1 planning failed, 2 bad input or usage, 3 no "
      "server reached; `bahnwerk COMMAND --help` says more.");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_usage;
  }
  try {
    if (*serve_command) store = options.store;
    if (*move_command) return move(store_url(from), store_url(to), password_file);
    if (!password_file.empty()) {
      store = with_password(store, password_file);
      std::string& listen_url = options.shared_store.listen_url;
      if (!listen_url.empty()) listen_url = with_password(listen_url, password_file);
    }
    options.store = store;
    if (*serve_command) return run_serve(*serve_command, options, level);
    if (*plan_command) return plan(read_job(job, contour), out, layout, frame, drives);
    if (*submit_command) return submit(remote, read_job(job, contour), key, wait, patience);
    if (*watch_command) return watch(remote, id, patience);
    if (*backup_command) return backup(store, file);
    if (*add_command)
      return add_key(store, name, scope, max_queued,
                     max_planning.count() > 0 ? std::optional(max_planning) : std::nullopt);
    if (*list_command) return list_keys(store);
    if (*remove_command) return remove_keys(store, name);
    if (*check_command) return check(store);
    if (*migrate_command) return migrate(store);
    if (*health_command) return health(remote, ready);
    return fetch(remote, id, format, layout, frame);
  } catch (const std::exception& error) {
    std::cerr << "bahnwerk: " << error.what() << '\n';
    return exit_usage;
  }
}

}  // namespace bahnwerk::server::cli
