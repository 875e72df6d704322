#pragma once
/// The command line: `bahnwerk serve | plan | submit | watch | fetch | health | backup | check | migrate |
/// migrate-store`.
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/service.hpp"

namespace bahnwerk::server::cli {

inline constexpr int exit_ok = 0;
inline constexpr int exit_failed = 1;       ///< planning failed or was cancelled; the problem document is on stdout
inline constexpr int exit_usage = 2;        ///< bad input or usage, or refused by the server
inline constexpr int exit_unreachable = 3;  ///< no server answered, or it cannot serve now: another try may succeed

/// Runs the program and returns its exit code.
int run(int argc, char** argv, const BuildInfo& build);

int serve(ServiceOptions options);
/// Plans the document `job` in this process. With `out`, writes result.json and drawings there, and setpoints.csv in a
/// layout of api::csv_layouts (empty: plain), in a frame of api::setpoint_frames (empty: that of the layout); for a
/// layout of api::result_layouts() also the kind's file in that layout. A plan that is not verified has no setpoints,
/// and its problem is printed. Each of `drives`, "coarse=0.004" for a group and its delay in s, makes a separate file,
/// setpoints_coarse.csv; throws std::runtime_error for an entry of another form.
int plan(const std::string& job, const std::string& out, const std::string& layout, const std::string& frame,
         const std::vector<std::string>& drives = {});
/// A server, and what it wants to see of its clients. A key file wins over a key.
struct Remote {
  std::string server = "http://127.0.0.1:8080", key, key_file, ca, certificate, certificate_key;
};
/// `patience` is how long a server is asked again that has answered before and does not now.
int submit(const Remote& server, const std::string& job, const std::string& key, bool wait,
           std::chrono::milliseconds patience);
int watch(const Remote& server, const std::string& id, std::chrono::milliseconds patience);
int fetch(const Remote& server, const std::string& id, const std::string& format, const std::string& layout,
          const std::string& frame);
/// Copies the store named by a URL into a file while it is in use, and prints what the copy has.
int backup(const std::string& store, const std::string& file);
/// Checks whether the store named by a URL is whole, and prints what is not.
int check(const std::string& store);
/// Brings the schema of a store up to date, and prints its version.
int migrate(const std::string& store);
/// Moves all jobs from one store into the other, tells on stderr how far it is, and prints what was compared.
/// `password_file` is for the PostgreSQL server.
int move(std::string from, std::string to, const std::string& password_file);
/// Adds a key for `name` to the store and prints its text, which nobody can learn again.
int add_key(const std::string& store, const std::string& name, const std::string& scopes,
            std::optional<std::int64_t> max_queued, std::optional<std::chrono::milliseconds> max_planning);
/// Prints the keys of the store, removed ones included, without their texts.
int list_keys(const std::string& store);
/// Ends the validity of all keys of a name, or of the one with an id; prints them.
int remove_keys(const std::string& store, const std::string& name_or_id);
/// Asks whether the process is alive, or with `ready` whether it accepts jobs; prints the answer.
int health(const Remote& server, bool ready);

/// Returns the file's bytes, or stdin's for "-". Throws std::runtime_error with a sentence for the user.
std::string read_input(const std::string& path);
/// Returns the job document of that file; `contour`, if not empty, is a part program or drawing (.dxf) that replaces
/// its contour.
std::string read_job(const std::string& job, const std::string& contour);

}  // namespace bahnwerk::server::cli
