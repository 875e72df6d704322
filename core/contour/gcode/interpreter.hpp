#pragma once
/// Interprets the words of a part program line by line and drives a Mover, by way of the cutter radius compensation.
#include <cstdint>
#include <optional>
#include <string>

#include "core/contour/gcode.hpp"
#include "core/contour/gcode/cycle.hpp"
#include "core/contour/gcode/moves/compensation.hpp"
#include "core/contour/gcode/notes.hpp"
#include "core/contour/gcode/offsets.hpp"
#include "core/contour/gcode/saved_modes.hpp"
#include "core/contour/gcode/words/codes.hpp"
#include "core/contour/gcode/words/parameters.hpp"
#include "core/contour/gcode/words/words.hpp"

namespace bahnwerk::gcode {

/// Keys of notes: ten times the G word, M words from key_m on.
inline constexpr int key_dwell = 40, key_reference = 280, key_m = 100'000, key_slash = 200'000, key_output = 200'001,
                     key_zero_power = 200'002, key_rest = 200'003, key_no_feed = 200'004, key_printer = 200'005,
                     key_unset = 200'006, key_endless = 200'007, key_before = 200'008, key_controller = 200'009,
                     key_look_ahead = 200'010, key_text_end = 200'011, key_main_end = 200'012, key_initial = 200'013,
                     key_peck = 200'014;

/// Request of a line to the order of execution: M98, M99.
struct Request {
  int program = -1;
  std::size_t repeats = 1;
  bool back = false;
  bool any() const { return back || program >= 0; }
};

class Interpreter final : public SystemParameters {
 public:
  Interpreter(const GcodeOptions& options, bool flat, Progress progress);

  /// Executes a line. Returns false at the end of the program, or where further reading is useless.
  bool execute(const Line& line);

  bool ended() const { return ends_; }
  std::size_t segments() { return mover_.builder().segments(); }
  Request request() const { return request_; }
  /// Refuses the line; the program cannot continue.
  void refuse(const Line& line, const std::string& why);
  /// Ends the main program at M99.
  void end(const Line& line);
  /// Ends the main program where, without M30, the text of a subprogram begins.
  void end_before_subprogram(const Line& line);
  /// Enters and leaves subprograms; at a return the modes that M73 has saved are restored.
  void enter_subprogram();
  void leave_subprogram(const Line& line);
  /// Notes that 0x1A ends the text.
  void end_of_text(std::size_t line) {
    notes_.add(key_text_end, line, "what follows 0x1A, the end of a text, is not read");
  }
  /// Ends the interpretation: no further lines follow.
  void close(const Parameters::Unset& unset);
  std::optional<double> system_parameter(int number) const override;
  std::optional<double> predefined(std::string_view name) const override;
  bool of_the_machine(std::string_view name) const override;
  /// Receives the first line behind the end that is not empty.
  void rest(const Line& line);

  /// Returns whether the contour stays at one height other than 0; it is then read again as a flat one.
  bool lifted() const { return height() != 0; }
  /// Returns the height of a contour that stays at one, mm; otherwise 0.
  double height() const { return mover_.climbs() ? 0 : mover_.position().z; }
  /// Throws InvalidInput.
  Contour finish();

 private:
  // interpreter.cpp: lines, feeds; g_words.cpp: G words; switches.cpp: M words, dwells, printers
  void g_words(const Line& line);
  void g_word(const Line& line, int tenfold);
  int translated(int tenfold) const;
  bool look_ahead(const Line& line, int tenfold);
  void cancel(const Line& line, int tenfold);
  void controller_line(const Line& line);
  void use_plane(Plane plane);
  void m_words(const Line& line);
  void m_word(const Line& line, int m);
  void printer_word(const Line& line, std::uint32_t words = ~0U);
  void foreign_m(const Line& line, int m);
  void tool_change(const Line& line);
  void dwell_time(const Line& line);
  void dwell(const Line& line);
  void rest_here(double seconds);
  void call(const Line& line);
  void feed(const Line& line);
  void tool_words(const Line& line);
  void leftovers(const Line& line);
  void switched(bool& pair, bool on, bool& used);
  bool takes(const Line& line, std::uint32_t letters);
  void fault(const std::string& message);
  void note(int key, const Line& line, const char* text) { notes_.add(key, line.number, text); }

  // modes.cpp: M70 … M73
  void mode_words(const Line& line);
  Modes modes() const;
  void restore(const Modes& modes);
  double motion_number() const;  // returns the number of the active motion (system_values.cpp)

  // moves.cpp: the motion of a line
  void move(const Line& line);
  void straight(const Line& line);
  void arc(const Line& line);
  std::optional<Vec> centre(const Line& line, bool absolute);
  bool agrees(const Line& line, Vec to, Vec about, ArcMove& how);
  bool agrees_otherwise(const Line& line, Vec to) const;
  double rounding() const;
  void spline(const Line& line);
  bool in_range(Vec at);
  bool feeds(const Line& line, double length);
  void rapid_to(Vec to);
  std::optional<Vec> target(const Line& line);
  Vec offset(const Line& line, char x, char y) const;

  // positions.cpp: where the program's zero lies, and points of the machine
  void settings(const Line& line);
  void select_work_offset(const Line& line, int tenfold);
  void set_data(const Line& line);
  void set_position(const Line& line);
  void stand_at(const Line& line, Vec origin);
  void compensate(const Line& line);
  std::optional<double> cutter_radius(const Line& line, bool by_diameter);
  void reference_point(const Line& line, const std::optional<Vec>& point);
  void machine_coordinates(const Line& line);
  void leave(const Line& line, std::uint32_t axes, bool given);
  void come_back(const Line& line);
  /// Before the first move the head's position is the program's zero, also after changes of the zero.
  template <class Change>
  void change_origin(Change change) {
    const Vec before = offsets_.origin();
    change();
    if (!mover_.started()) mover_.place(mover_.position() + offsets_.origin() - before);
  }
  Vec named(const Line& line, Vec otherwise, Vec origin) const;

  // cycles.cpp
  void cycle(const Line& line);
  std::optional<CycleHole> cycle_words(const Line& line);
  void drill(const CycleHole& hole);
  void peck_word(const Line& line);

  const GcodeOptions options_;
  Progress progress_;
  Compensation mover_;
  Notes notes_;
  Offsets offsets_;

  // Modal state
  Action motion_ = Action::no_motion;
  bool initial_ = true;  // whether no motion word has occurred yet
  Plane plane_ = Plane::xy;
  double unit_;  // length of the program's unit, mm
  bool absolute_ = true, absolute_centres_ = false;
  double feed_;                          // mm/s; with G93 1/s
  bool fed_ = false;                     // whether a feed is known
  bool feed_lost_ = false;               // whether G94 after G93 has made the feed invalid
  bool inverse_time_ = false;            // whether G93 is active
  bool spindle_ = true, output_ = true;  // whether they are on; true until the program uses them
  bool uses_spindle_ = false, uses_output_ = false;
  std::optional<int> switch_output_;
  std::optional<Vec> last_handle_;  // P Q of the preceding G5
  Cycle cycle_;
  int tool_ = 0;  // last T word
  int selected_tool_ = -1, current_tool_ = 0;
  double speed_ = 0;  // last S word
  bool clockwise_ = true, mist_ = false, flood_ = false, tool_length_ = false;
  std::optional<Vec> g28_, g30_;
  SavedModes saved_;
  double dwelt_ = 0;         // s, sum of all dwells
  std::uint32_t moved_ = 0;  // letters of the axes that moves have named

  // Axes away from the known position, and that position, after a move to an unknown point of the machine.
  std::uint32_t away_ = 0;
  std::size_t away_line_ = 0;
  Vec back_;

  // State of the current line
  std::uint32_t used_ = 0;
  std::optional<double> dwell_;  // s
  Request request_;
  std::optional<int> compensation_;  // G word, tenfold
  std::optional<int> setting_;       // G word, tenfold, that takes the line's coordinates
  bool sound_ = true, ends_ = false, unknown_m_ = false, starts_cycle_ = false;
};

}  // namespace bahnwerk::gcode
