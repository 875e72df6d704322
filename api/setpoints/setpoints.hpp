#pragma once
/// Setpoints in HTTP answers: the query that selects rows and columns, and the formats in which they are written.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/views/limits_view.hpp"
#include "core/base/named.hpp"
#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

enum class SetpointFormat { json, csv, ndjson, f64, f32 };
/// Returns the format that an Accept header prefers; json if it is absent or "*/*"; nullopt if none is acceptable.
std::optional<SetpointFormat> negotiate_setpoints(std::string_view accept);
std::string_view content_type(SetpointFormat format);
std::string_view format_name(SetpointFormat format);  ///< json, csv, ndjson, f64, f32

/// Layout of CSV. plain is RFC 4180 with all columns. The others are for controllers with TwinCAT [Herrmann 4.5.1]:
/// fields separated by semicolons and lines ended by CR LF, the defaults of FB_CSVMemBufferReader of Tc2_Utilities;
/// decimal points; a header line. Unless `columns` are given, twincat has the axes, their velocities and the brake;
/// twincat_poses has the tool's pose, its rates and the brake, for controllers that know the machine's kinematics; both
/// have mode and block if they exist. An axis is a column c with the columns vc and ac; the pose is x, y, z, phi, psi.
enum class CsvLayout { plain, twincat, twincat_poses };
inline constexpr Named<CsvLayout> csv_layouts[] = {
    {CsvLayout::plain, "plain"}, {CsvLayout::twincat, "twincat"}, {CsvLayout::twincat_poses, "twincat_poses"}};

/// Frame of poses: the part's, or the base of the machine, in which its kinematics is computed.
enum class SetpointFrame { part, base };
inline constexpr Named<SetpointFrame> setpoint_frames[] = {{SetpointFrame::part, "part"},
                                                           {SetpointFrame::base, "base"}};
/// Drives that a file contains. coarse and fine denote axes whose names are those of others followed by c or f.
enum class DriveGroup { all, coarse, fine };
inline constexpr Named<DriveGroup> drive_groups[] = {
    {DriveGroup::all, "all"}, {DriveGroup::coarse, "coarse"}, {DriveGroup::fine, "fine"}};

struct SetpointQuery {
  std::size_t first = 0;
  std::optional<std::size_t> count;  ///< rows of the series that the slice spans, before `every`
  std::size_t every = 1;
  std::optional<std::size_t> points;  ///< min/max envelope with about this many points, for charts
  /// Names of the columns; empty: all of the series. `use`, the largest fraction of a limit in the row, and `limit`,
  /// its number (api/views/row_limits.hpp), are given where they are named.
  std::vector<std::string> columns;
  CsvLayout layout = CsvLayout::plain;  ///< layout of CSV rows; not allowed with `points`
  /// Layout of a file that a kind makes of its result (api/result_files.hpp), instead of rows; without other
  /// options.
  std::optional<std::string> file_layout;
  /// Frame of the columns x, y, z, phi and their rates; by default base in the layout twincat_poses if the machine is
  /// known [4.5.1: the controller takes ^O s], the part otherwise. Unless `columns` are given, that layout ends with a
  /// column of ones whose name states the frame, base_frame or part_frame.
  std::optional<SetpointFrame> frame;
  DriveGroup group = DriveGroup::all;  ///< axes to write, unless `columns` are given
  /// s, a whole number of cycles for which the axes rest before the motion begins, so that drives with different lags
  /// that are started together move together. These rows are counted.
  double delay = 0;
  std::optional<SetpointFormat> format;  ///< overrides Accept, because a link in a page cannot set a header
};
/// Parses the pairs of a decoded query string. Throws Problem schema-violation (422) with pointers like /query/first
/// for values that are not non-negative integers, for every = 0, points = 0, points together with every or a layout,
/// and for unknown parameters.
SetpointQuery parse_setpoint_query(const std::vector<std::pair<std::string, std::string>>& query);

/// A stored series, read chunk by chunk through a function so that it is never in memory as a whole.
struct SetpointSeries {
  std::vector<Column> columns;
  std::size_t count = 0;
  double cycle_time = 0;
  Independent independent = {};
  std::optional<PoseFrame> pose_frame = {};  ///< frame of the poses; none: poses exist in one frame only
  /// Fills `out` with rows [first, first + rows), row-major, all columns.
  std::function<void(std::size_t first, std::size_t rows, std::vector<double>& out)> read;
  ViewReader view = nullptr;                       ///< the stored views of these columns; empty: there are none
  std::shared_ptr<LimitsReader> limits = nullptr;  ///< set where the last two columns are use and limit
};

/// Streams one answer: each call of next() appends at most about 64 KiB to `out`; it returns false, without appending,
/// at the end.
class SetpointStream {
 public:
  /// Throws Problem schema-violation for an unknown frame or column, a first row beyond the series, a layout of another
  /// format than CSV, a layout or group for which the series lacks columns, and a delay that is not a whole number of
  /// cycles.
  SetpointStream(SetpointSeries series, SetpointQuery query, SetpointFormat format);
  ~SetpointStream();
  SetpointStream(SetpointStream&&) noexcept;
  bool next(std::string& out);
  const std::vector<Column>& columns() const;  ///< columns of the answer, for X-Columns

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::api
