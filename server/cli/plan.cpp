#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "api/setpoints.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "server/cli/cli.hpp"
#include "server/cli/progress_bar.hpp"
#include "server/runtime/clock.hpp"

namespace bahnwerk::server::cli {
namespace {

/// Shows progress on a terminal and holds the document's own time limits, as a worker does.
class TerminalProgress final : public Progress {
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

/// Throws api::Problem for a layout that does not fit the columns. `source` outlives it.
api::SetpointStream csv(const SetpointSource& source, const std::string& layout, const std::string& frame) {
  api::SetpointSeries series;
  series.columns = source.columns();
  series.count = source.count();
  series.cycle_time = source.cycle_time();
  series.pose_frame = source.pose_frame();
  series.read = [&source](std::size_t first, std::size_t rows, std::vector<double>& values) {
    values.resize(rows * source.columns().size());
    source.read(first, rows, values.data());
  };
  api::SetpointQuery query;
  if (!layout.empty()) query.layout = value_of<api::CsvLayout>(layout, api::csv_layouts);
  if (!frame.empty()) query.frame = value_of<api::SetpointFrame>(frame, api::setpoint_frames);
  return {std::move(series), std::move(query), api::SetpointFormat::csv};
}

/// result.json, the drawings that it holds, setpoints.csv.
void write_files(const std::filesystem::path& folder, const nlohmann::ordered_json& result,
                 std::optional<api::SetpointStream> setpoints) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error("cannot make " + folder.string() + ": " + error.message());
  write(folder / "result.json", result.dump(2) + '\n');
  if (result["details"].contains("drawings"))
    for (const auto& [name, drawing] : result["details"]["drawings"].items())
      write(folder / name, drawing.get<std::string>());
  if (!setpoints) return;
  std::ofstream file(folder / "setpoints.csv", std::ios::binary);
  for (bool more = true; more;) {
    std::string piece;
    more = setpoints->next(piece);
    file << piece;
  }
  finish(file, folder / "setpoints.csv");
}

}  // namespace

int plan(const std::string& job, const std::string& out, const std::string& layout, const std::string& frame) {
  api::PlannedJob planned;
  std::optional<api::SetpointStream> setpoints;
  try {
    const api::JobRequest request = api::parse_job(job);
    TerminalProgress progress(request);
    planned = api::plan_job(request.kind, request.document, progress);
    if (!planned.verified) {
      if (!out.empty()) write_files(out, planned.result, std::nullopt);
      throw api::Problem("verification-failed", planned.failure);
    }
    if (!out.empty() && planned.setpoints) setpoints.emplace(csv(*planned.setpoints, layout, frame));
  } catch (...) {
    return report_problem(api::problem_from_current_exception("/spec"));
  }
  if (!out.empty()) write_files(out, planned.result, std::move(setpoints));
  std::cout << planned.result.dump(2) << std::endl;
  if (!std::cout) throw std::runtime_error("cannot write the result document");
  return exit_ok;
}

}  // namespace bahnwerk::server::cli
