#pragma once
/// Reads a part program in G-code, the dialect of RS-274 [Kramer, Proctor, Messina: The NIST RS274NGC Interpreter,
/// version 3, NISTIR 6556, 2000], with the splines of LinuxCNC (G5, G5.1).
///
/// Motion
/// - G0 and G1 are straight. G2 and G3 are arcs in G17, G18 or G19, with I J K (from the arc's start, or absolute after
///   G90.1) or with R (negative: more than half a turn). The third coordinate makes a helix, end = start a full circle,
///   P counts the turns. In G17 G5 is a cubic spline (I J from its start, P Q from its end; without I J it goes on as
///   the last one ended) and G5.1 a quadratic one.
/// - G20 and G21 at any time, for every number from their own line on. G90 and G91. G80 ends the motion mode.
/// - Rounding: the radii at both ends of an arc may differ by 0.01 mm, in inches by 0.0005 in (coordinates cut off
///   behind their fourth decimal). The centre then moves to the chord's bisector. An R that is too small for its chord
///   by no more than that makes a half circle.
///
/// Cut or position
/// - G0 always positions, without a feed limit. Other moves cut while the tool is on: M3 or M4 on, M5 off; M62 or M64
///   on, M63 or M65 off. A program that uses both pairs cuts while both are on; both are off until they are first
///   switched on. A program that switches nothing on cuts whatever is not G0. Switches act before their line's motion.
/// - F is in program units per minute. Before the first F only the axes limit the feed, which is noted. Other moves
///   than G0 keep F with the tool off.
/// - G4 dwells, at most 86 400 s, after its line's switches and before its motion. Its time is P, else X, U, F or S,
///   always in seconds as LinuxCNC and GRBL have it; the note with the total shows where a program meant milliseconds.
///   Without a time it only stops. It is part of the cut while the tool is on; where nothing switches the tool, unless
///   G0 is in force.
///
/// Start: where the machine stands before is unknown. The contour starts at the end of the first motion if that is G0
/// in G90 with X and Y, else at the origin. It has 3 coordinates if any motion changes Z, else 2 and one height.
///
/// Form: one block per line, capitals or not, blanks anywhere, also in numbers; N and O words; comments in ( ) and
/// behind a semicolon; LF, CRLF or CR. M2, M30 or the second % end the program. A block of the contour begins where
/// mode or feed changes.
///
/// Noted and left out: path control (G9, G61, G64), stops, tool changes, tool length (G43: the contour is that of the
/// tool's tip), unknown M words, lines that begin with /, moves to a point of the machine (G28, G30, G53) before
/// the first or after the last other motion.
///
/// Refused, with the line: parameters, expressions, subprograms, cutter radius compensation (G41, G42), canned cycles,
/// work offsets but G54, G92, feeds other than per minute (G93, G95), axes but X, Y and Z, whatever is unknown.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"

namespace bahnwerk {

struct GcodeOptions {
  double feed = std::numeric_limits<double>::infinity();  ///< before the first F, mm/s
  bool inch = false;                                      ///< units before the first G20 or G21
  bool block_delete = true;                               ///< leave out lines that begin with /
  std::optional<int> output = std::nullopt;  ///< the tool's switch in M62 … M65; unset: the first one named
  std::size_t max_segments = 2'000'000;
  std::array<std::optional<Vec>, 9> work_offsets{};  ///< G54 … G59, G59.1 … G59.3, mm; unset: zero
  std::optional<Vec> g28{}, g30{};                   ///< points of the machine, mm; unset: not known
  std::map<int, double> cutter_radius{};             ///< by D number, mm; a negative one is on the other side
  std::size_t steps = 1'000'000;                     ///< budget of loops and subprograms

  bool gives_offsets() const {
    return std::any_of(work_offsets.begin(), work_offsets.end(), [](const auto& one) { return one.has_value(); });
  }
};

/// Throws InvalidInput with every fault found, at most 100, each at {"contour","gcode"} with a message "line 12: …".
/// `source` of a path segment is its line. O(bytes): 45–100 MB/s or 1.5–4 million lines per second for straight moves,
/// 18 MB/s for arcs and splines in turn (tests/bench/bench_contour.cpp); twice that time for a contour at one height
/// other than 0.
Contour read_gcode(std::string_view text, const GcodeOptions& options = {});
Contour read_gcode(std::string_view text, const GcodeOptions& options, Progress& progress);

}  // namespace bahnwerk
