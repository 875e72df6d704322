#pragma once
/// Setpoints on the wire: which rows and columns are asked for, and how they are written.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/kinds/motion_law/controller_layouts.hpp"
#include "core/base/named.hpp"
#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

enum class SetpointFormat { json, csv, ndjson, f64 };
/// From an Accept header; absent or "*/*" → json. nullopt = nothing acceptable (not-acceptable).
std::optional<SetpointFormat> negotiate_setpoints(std::string_view accept);
std::string_view content_type(SetpointFormat format);
std::string_view format_name(SetpointFormat format);  ///< json, csv, ndjson, f64

/// How CSV is laid out. plain: RFC 4180, all columns. The others are what controllers under TwinCAT read [Herrmann
/// 4.5.1]: fields separated by semicolons, lines ended by CR LF, as FB_CSVMemBufferReader of Tc2_Utilities takes them
/// by default; decimal points; a header line. Without `columns` they hold what a controller follows: twincat the axes,
/// their velocities and the brake; twincat_poses the tool's pose, its rates and the brake, for controllers that know
/// the machine's kinematics; both mode and block, where there are such. An axis is a column c with columns vc and ac
/// beside it; the pose x, y, z, phi, psi.
enum class CsvLayout { plain, twincat, twincat_poses };
inline constexpr Named<CsvLayout> csv_layouts[] = {
    {CsvLayout::plain, "plain"}, {CsvLayout::twincat, "twincat"}, {CsvLayout::twincat_poses, "twincat_poses"}};

/// Of which frame poses are: the part's, or the base of the machine, in which its kinematics is calculated.
enum class SetpointFrame { part, base };
inline constexpr Named<SetpointFrame> setpoint_frames[] = {{SetpointFrame::part, "part"},
                                                           {SetpointFrame::base, "base"}};
/// The drives that a file is for. coarse and fine: axes whose names are those of others with c or f behind them.
enum class DriveGroup { all, coarse, fine };
inline constexpr Named<DriveGroup> drive_groups[] = {
    {DriveGroup::all, "all"}, {DriveGroup::coarse, "coarse"}, {DriveGroup::fine, "fine"}};

struct SetpointQuery {
  std::size_t first = 0;
  std::optional<std::size_t> count;  ///< rows of the series that the slice spans, before `every`
  std::size_t every = 1;
  std::optional<std::size_t> points;    ///< min/max envelope with about this many points, for charts
  std::vector<std::string> columns;     ///< empty = all
  CsvLayout layout = CsvLayout::plain;  ///< of CSV alone, and of rows: not with `points`
  /// A cam table as a controller reads it, instead of rows: of motion laws, with nothing else.
  std::optional<ControllerLayout> controller;
  /// Of columns x, y, z, phi and their rates; not given: base in layout twincat_poses where the machine is known
  /// [4.5.1: the controller takes ^O s], the part elsewhere. Without `columns` that layout ends with a column that is 1
  /// and names the frame, base_frame or part_frame.
  std::optional<SetpointFrame> frame;
  DriveGroup group = DriveGroup::all;  ///< without `columns`: whose axes
  /// s, whole cycles: the axes rest so long before they begin, so that drives that follow with different lags, started
  /// together, move together. Rows are counted with those.
  double delay = 0;
  std::optional<SetpointFormat> format;  ///< wins over Accept: a link in a page cannot carry a header
};
/// From a decoded query string's pairs. Throws Problem schema-violation (422) with pointers like /query/first for
/// values that are no non-negative integers, for every = 0, points = 0, points together with every or with a layout,
/// and for unknown parameters.
SetpointQuery parse_setpoint_query(const std::vector<std::pair<std::string, std::string>>& query);

/// A stored series: like SetpointSource, but read chunk by chunk through a function, so that nothing holds the whole.
struct SetpointSeries {
  std::vector<Column> columns;
  std::size_t count = 0;
  double cycle_time = 0;
  Independent independent = {};
  std::optional<PoseFrame> pose_frame = {};  ///< none: poses have no other frame
  /// Fills `out` with rows [first, first + rows), row-major, all columns.
  std::function<void(std::size_t first, std::size_t rows, std::vector<double>& out)> read;
};

/// Streams one answer: each call of next() appends a bounded piece (≈ 64 KiB) to `out`, until it returns false, having
/// appended nothing.
class SetpointStream {
 public:
  /// Throws Problem schema-violation for a frame that is not known, an unknown column, a first beyond the series, a
  /// layout of anything but CSV, a layout or group of a series that has not what it holds, and a delay that is not
  /// whole cycles.
  SetpointStream(SetpointSeries series, SetpointQuery query, SetpointFormat format);
  ~SetpointStream();
  SetpointStream(SetpointStream&&) noexcept;
  bool next(std::string& out);
  const std::vector<Column>& columns() const;  ///< those answered, for X-Columns

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Shortest text that reads back as the same double (std::to_chars).
void append_number(std::string& out, double value);

}  // namespace bahnwerk::api
