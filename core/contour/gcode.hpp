#pragma once
/// Reads a part program in G-code, the dialect of RS-274 [Kramer, Proctor, Messina: The NIST RS274NGC Interpreter,
/// version 3, NISTIR 6556, 2000], with what LinuxCNC has added to it: splines, expressions, O words.
///
/// Motion
/// - G0 and G1 are straight. G2 and G3 are arcs in G17, G18 or G19, with I J K (from the arc's start, or absolute after
///   G90.1) or with R (negative: more than half a turn). The third coordinate makes a helix, end = start a full circle,
///   P counts the turns. In G17 G5 is a cubic spline (I J from its start, P Q from its end; without I J it goes on as
///   the last one ended) and G5.1 a quadratic one.
/// - G20 and G21 at any time, for every number from their own line on. G90 and G91. G80 ends the motion mode.
/// - Rounding: the radii at both ends of an arc may differ by 0.01 mm, in inches by 0.0005 in (coordinates cut off
///   behind their fourth decimal), or as with LinuxCNC by 0.1 % of the radius, 0.5 mm or 0.05 in at most. The centre
///   then moves to the chord's bisector; arcs of more than 300° become two (gcode/moves/mover.hpp, ArcHalves). An R
///   that is too small for its chord by no more than 0.01 mm or 0.0005 in makes a half circle.
/// - Canned cycles G73, G81, G82, G83, G85, G86, G89 as RS274NGC 3.5.16 has them, with R, Z, Q, P that hold, L, G98 and
///   G99, in any plane. G73 draws back by 0.254 mm, G83 comes back to 0.254 mm above the bottom; by P, if P is less
///   than the peck, else P is a dwell. R and Z that hold stay the levels, or with G91 the increments, that they were in
///   their own line.
/// - G41 and G42 move lines and arcs of G17 aside by the radius that the options give for the number D, or for the tool
///   T; G41.1 and G42.1 by half of the diameter D (gcode/moves/compensation.hpp).
///
/// Position
/// - G54 … G59.3 with offsets from the options or from G10 L2, L20; zero where there are none, which is noted (G54
///   only if others are given). G52 and G92 (.1, .2, .3) share one offset on top of them, as with LinuxCNC. The contour
///   is in the coordinates of the machine; without offsets these are the program's.
/// - The position before the first move is unknown. The contour starts where G92 X Y or G10 L20 X Y states, or at the
///   end of the first motion if that is G0 in G90 with X and Y, else at the program's zero. It has 3 coordinates if any
///   motion changes Z, else 2 and one height.
/// - G28 and G30 go to points that the options give, G53 moves in machine coordinates if the work offset in force is
///   known. Otherwise the target is unknown: the move is left out with a note, and the head stops. The axes concerned
///   have to be named by straight moves in G90 before the next cut; the contour then continues from the last known
///   point: up, across, down. Before the first motion, behind the last one, and for axes that no move names, nothing
///   but the note follows.
///
/// Cut or position
/// - G0 always positions, without a feed limit. Other moves cut while the tool is on: M3 or M4 on, M5 off; M62 or M64
///   on, M63 or M65 off. A program that uses both pairs cuts while both are on; both are off until they are first
///   switched on. A program that switches nothing on cuts in all moves but G0. Switches act before their line's motion.
/// - F is in program units per minute; after G93 in 1/min, for its own line alone: the feed is the length that the
///   program names, times F. Before the first F only the axes limit the feed, which is noted; after G94 behind G93 a
///   move without F is refused. Other moves than G0 keep F with the tool off.
/// - G4 dwells, at most 86 400 s, after its line's switches and before its motion. Its time is P, else X, U, F or S,
///   always in seconds as LinuxCNC and GRBL have it; the note with the total shows where a program meant milliseconds.
///   Without a time it only stops. It is part of the cut while the tool is on; where nothing switches the tool, unless
///   G0 is in force.
///
/// Order
/// - Parameters #1 … #9999 and #<name>, expressions in brackets (gcode/words/expression.hpp). A
///   numbered parameter that was never set is 0, with a note; a name that was never set is refused. #5021 … #5029,
///   #5161 … #5602 and names that LinuxCNC predefines
///   (#<_x>, #<_metric>, #<_feed> …) are the control's: offsets, position, modes.
/// - M70 saves the modes, M72 restores them, M73 saves them and restores them at the end of its subprogram
/// (gcode/saved_modes.hpp).
/// - O words: sub, endsub, call, return; if, elseif, else, endif; while, endwhile, do, repeat, endrepeat, break,
///   continue. M98 P L and M99 with numbered subprograms of the same text. M99 in the main program ends it; so does the
///   beginning of a subprogram that it has called.
/// - The first execution of a line is free. Every further one takes a step from a budget, and one more for each 64
///   bytes of the line; when the budget is used up, the program is refused at that line. At most 64 calls, 32 brackets
///   in one another, 10 000 names and 100 000 O words.
///
/// Form: one block per line, capitals or not, blanks anywhere, also in numbers; N and O words; comments in ( ) and
/// behind a semicolon; LF, CRLF or CR. M2, M30, the second % or 0x1A end the program. Exponents are read where no
/// other reading is possible. A block of the contour begins where mode or feed changes.
///
/// Noted and left out: path control (G9, G61, G64), look-ahead (G5 P, G5.1 Q, G8 P), stops, tool changes, tool length
/// (G43: the contour is that of the tool's tip), unknown M words with what stands behind them, lines that begin with /
/// or $, words of printers (E; M82, M104, M117, M201 and the like with all of their line; G29, G10 and G11 without L).
///
/// Refused, with the line: axes but X, Y and Z, arcs whose centre does not fit, gouges, cutters without a radius, feed
/// per revolution (G95), tapping and threading, probing, scaling and rotation (G51, G68), polar coordinates, macros
/// (G65, IF … GOTO, those of a printer's host), coordinates behind M6, whatever is unknown. Equal faults are one, with
/// their first line and how many more there are.
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

/// The motion of lines before the first motion word.
enum class GcodeMotion { rapid, line };

/// The options of a document with a part program.
struct GcodeOptions {
  double feed = std::numeric_limits<double>::infinity();  ///< feed before the first F, mm/s
  bool inch = false;                                      ///< whether units are inches before the first G20 or G21
  bool block_delete = true;                               ///< whether lines that begin with / are left out
  std::optional<int> output = std::nullopt;  ///< number of the tool's switch in M62 … M65; unset: the first one named
  std::size_t max_segments = 2'000'000;
  std::array<std::optional<Vec>, 9> work_offsets{};  ///< G54 … G59, G59.1 … G59.3, mm; unset: zero
  std::optional<Vec> g28{}, g30{};        ///< points of G28 and G30 in machine coordinates, mm; unset: unknown
  std::map<int, double> cutter_radius{};  ///< radius of each D number, mm; negative: the cutter is on the other side
  std::size_t steps = 1'000'000;          ///< budget of loops and subprograms, in repeated lines
  bool absolute_centres = false;          ///< whether G90.1 holds before the first G90.1 or G91.1
  bool g70_g71_units = false;             ///< whether G70 means inches and G71 mm, as on older controls
  GcodeMotion initial_motion = GcodeMotion::rapid;  ///< motion of lines before the first motion word, which are noted

  bool gives_offsets() const {
    return std::any_of(work_offsets.begin(), work_offsets.end(), [](const auto& one) { return one.has_value(); });
  }
};

/// Returns the contour. Throws InvalidInput with every cause of a fault, at most 100, each at {"contour","gcode"} with
/// a message "line 12 and 3 more: …". `source` of a path segment is its line. O(bytes + steps): 45–100 MB/s or 1.5–4
/// million lines per second for straight moves, 18 MB/s for arcs and splines in turn (tests/bench/bench_contour.cpp);
/// twice that time for a contour at one height other than 0. A step of a loop takes 0.1 to 0.7 µs plus the time of its
/// moves.
Contour read_gcode(std::string_view text, const GcodeOptions& options = {});
Contour read_gcode(std::string_view text, const GcodeOptions& options, Progress progress);

}  // namespace bahnwerk
