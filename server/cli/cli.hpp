#pragma once
/// The command line: `bahnwerk serve | plan | submit | watch | fetch | health`.
#include <cstdint>
#include <string>
#include <vector>

#include "server/service.hpp"

namespace bahnwerk::server::cli {

inline constexpr int exit_ok = 0;
inline constexpr int exit_failed = 1;       ///< planning failed or was cancelled; the problem document is on stdout
inline constexpr int exit_usage = 2;        ///< bad input or usage, or refused by the server
inline constexpr int exit_unreachable = 3;  ///< no server answered, or one that cannot serve now: trying again may help

/// The whole program; returns its exit code.
int run(int argc, char** argv, const BuildInfo& build);

int serve(const ServiceOptions& options);
/// `job` is the document; with `out`, writes result.json and drawings there, and setpoints.csv in a layout of
/// api::csv_layouts (empty: plain) or, beside plain ones, a motion law's cam table in one of api::controller_layouts;
/// of a frame of api::setpoint_frames (empty: that of the layout). A plan that is not verified has no setpoints, and
/// its problem is printed. Each of `drives`, "coarse=0.004" for a group and its delay in s, makes a file of its own,
/// setpoints_coarse.csv; throws std::runtime_error for one that is not written so.
int plan(const std::string& job, const std::string& out, const std::string& layout, const std::string& frame,
         const std::vector<std::string>& drives = {});
int submit(const std::string& server, const std::string& job, const std::string& key, bool wait);
int watch(const std::string& server, const std::string& id);
int fetch(const std::string& server, const std::string& id, const std::string& format, const std::string& layout,
          const std::string& frame);
/// Asks whether the process lives, or with `ready` whether it takes jobs; prints the answer.
int health(const std::string& server, bool ready);

/// The file's bytes, or stdin's for "-". Throws std::runtime_error with a sentence.
std::string read_input(const std::string& path);
/// The job document of that file; `contour`, if not empty, is a part program or drawing (.dxf) that takes the place of
/// its contour.
std::string read_job(const std::string& job, const std::string& contour);

}  // namespace bahnwerk::server::cli
