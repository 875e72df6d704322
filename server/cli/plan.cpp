#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "api/result_files.hpp"
#include "api/setpoints/setpoints.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "server/cli/cli.hpp"
#include "server/cli/progress_bar.hpp"
#include "server/runtime/clock.hpp"

namespace bahnwerk::server::cli {
namespace {

/// Shows progress on a terminal and enforces the document's own time limits, as a worker does.
class TerminalProgress final : public ProgressSink {
 public:
  explicit TerminalProgress(const api::JobRequest& request) : request_(request) {}
  void report(std::string_view stage, double fraction, std::string_view message) override {
    if (request_.deadline && now_ms() >= *request_.deadline) throw Stopped(StopReason::deadline);
    if (request_.time_budget && seconds_since(start_) >= *request_.time_budget) throw Stopped(StopReason::budget);
    if (seconds_since(shown_) < 0.1) return;
    shown_ = std::chrono::steady_clock::now();
    bar_.show(fraction, stage, message);
  }

 private:
  const api::JobRequest& request_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), shown_ = start_;
  ProgressBar bar_;
};

int report_problem(const api::Problem& problem) {
  std::cout << problem.document().dump(2) << std::endl;
  const int status = problem.type().status;
  return status >= 400 && status < 500 ? exit_usage : exit_failed;  // the document was wrong, or planning failed
}

void finish(std::ofstream& file, const std::filesystem::path& path) {
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  finish(file, path);
}

/// The drives that a file of setpoints is for, and their delay.
struct Drives {
  std::string name;
  api::DriveGroup group = api::DriveGroup::all;
  double delay = 0;  ///< s
};

/// Reads "fine=0.004". Throws std::runtime_error with a sentence for the user.
Drives read_drives(const std::string& text) {
  const auto equals = text.find('=');
  const auto wrong = [&] {
    return std::runtime_error("--drives " + text + ": must be coarse or fine, =, and a time from 0 to 60 s");
  };
  if (equals == text.npos) throw wrong();
  try {
    const api::SetpointQuery query =
        api::parse_setpoint_query({{"group", text.substr(0, equals)}, {"delay", text.substr(equals + 1)}});
    return {text.substr(0, equals), query.group, query.delay};
  } catch (const api::Problem&) {
    throw wrong();
  }
}

/// Throws api::Problem for a layout, a group or a delay that does not fit the series. `source` outlives it.
api::SetpointStream csv(const SetpointSource& source, const std::string& layout, const std::string& frame,
                        const Drives& drives) {
  api::SetpointSeries series;
  series.columns = source.columns();
  series.count = source.count();
  series.cycle_time = source.cycle_time();
  series.independent = source.independent();
  series.pose_frame = source.pose_frame();
  series.read = [&source](std::size_t first, std::size_t rows, std::vector<double>& values) {
    values.resize(rows * source.columns().size());
    source.read(first, rows, values.data());
  };
  api::SetpointQuery query;
  if (!layout.empty()) query.layout = value_of<api::CsvLayout>(layout, api::csv_layouts);
  if (!frame.empty()) query.frame = value_of<api::SetpointFrame>(frame, api::setpoint_frames);
  query.group = drives.group;
  query.delay = drives.delay;
  return {std::move(series), std::move(query), api::SetpointFormat::csv};
}

struct SetpointFile {
  std::string name;
  api::SetpointStream rows;
};

/// Writes result.json, its drawings, and the setpoints.
void write_files(const std::filesystem::path& folder, const nlohmann::ordered_json& result,
                 std::vector<SetpointFile> setpoints) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error("cannot make " + folder.string() + ": " + error.message());
  write(folder / "result.json", result.dump(2) + '\n');
  if (result["details"].contains("drawings"))
    for (const auto& [name, drawing] : result["details"]["drawings"].items())
      write(folder / name, drawing.get<std::string>());
  for (SetpointFile& each : setpoints) {
    std::ofstream file(folder / each.name, std::ios::binary);
    for (bool more = true; more;) {
      std::string piece;
      more = each.rows.next(piece);
      file << piece;
    }
    finish(file, folder / each.name);
  }
}

}  // namespace

int plan(const std::string& job, const std::string& out, const std::string& layout, const std::string& frame,
         const std::vector<std::string>& drives) {
  std::vector<Drives> files{{}};
  for (const std::string& each : drives) files.push_back(read_drives(each));
  const bool kind_layout =
      api::kind_of_layout(layout) != nullptr;  // whether the layout is a kind's own; if not, it is one of rows
  const std::string row_layout = kind_layout ? "" : layout;
  api::PlannedJob planned;
  std::vector<SetpointFile> setpoints;
  std::optional<api::ResultFile> file;
  try {
    const api::JobRequest request = api::parse_job(job);
    TerminalProgress progress(request);
    planned = api::plan_job(request.kind, request.document, progress);
    if (!planned.verified) {
      if (!out.empty()) write_files(out, planned.result, {});
      throw api::Problem("verification-failed", planned.failure);
    }
    if (!out.empty() && planned.setpoints)
      for (const Drives& each : files)
        setpoints.push_back({each.name.empty() ? "setpoints.csv" : "setpoints_" + each.name + ".csv",
                             csv(*planned.setpoints, row_layout, frame, each)});
    if (kind_layout) file = api::result_file(nlohmann::json(planned.result), layout, request.name.value_or(""));
  } catch (...) {
    return report_problem(api::problem_from_current_exception("/spec"));
  }
  if (!out.empty()) write_files(out, planned.result, std::move(setpoints));
  if (file) {
    const std::string name = layout + "." + file->extension;
    write(std::filesystem::path(out) / name, file->text);
    if (!file->difference.empty()) std::cerr << name << " " << file->difference << '\n';
  }
  std::cout << planned.result.dump(2) << std::endl;
  if (!std::cout) throw std::runtime_error("cannot write the result document");
  return exit_ok;
}

}  // namespace bahnwerk::server::cli
