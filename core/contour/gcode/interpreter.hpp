#pragma once
/// Gives the words of a part program their meaning, line by line, and drives a Mover with them.
#include <cstdint>
#include <optional>
#include <string>

#include "core/contour/gcode.hpp"
#include "core/contour/gcode/codes.hpp"
#include "core/contour/gcode/mover.hpp"
#include "core/contour/gcode/notes.hpp"
#include "core/contour/gcode/words.hpp"

namespace bahnwerk::gcode {

/// Keys of notes: G words tenfold, M words from key_m on.
inline constexpr int key_dwell = 40, key_m = 100'000, key_slash = 200'000, key_output = 200'001,
                     key_zero_power = 200'002, key_rest = 200'003, key_no_feed = 200'004;

class Interpreter {
 public:
  Interpreter(const GcodeOptions& options, bool flat);

  /// False where the program ends, or where reading on would tell nothing new.
  bool execute(const Line& line);

  bool ended() const { return ends_; }
  /// The first line behind the end that is not empty.
  void rest(const Line& line);

  /// The contour keeps one height other than 0: to be read again as a flat one.
  bool lifted() const { return height() != 0; }
  /// Of a contour that keeps one, mm.
  double height() const { return mover_.climbs() ? 0 : mover_.position().z; }
  /// Throws InvalidInput.
  Contour finish();

 private:
  void g_words(const Line& line);
  void g_word(const Line& line, int tenfold);
  void m_words(const Line& line);
  void m_word(const Line& line, int m);
  void dwell_time(const Line& line);
  void dwell(const Line& line);
  void feed(const Line& line);
  void move(const Line& line);
  void straight(const Line& line);
  void arc(const Line& line);
  void arc_about_centre(const Line& line, Vec to, ArcMove how);
  void spline(const Line& line);
  void leftovers(const Line& line);

  bool takes(const Line& line, std::uint32_t letters);
  std::optional<Vec> target(const Line& line);
  Vec offset(const Line& line, char x, char y) const;
  void fault(const std::string& message);
  void note(int key, const Line& line, const char* text) { notes_.add(key, line.number, text); }
  void switched(bool& pair, bool on, std::optional<std::size_t>& first);

  const GcodeOptions options_;
  Mover mover_;
  Notes notes_;

  // modal
  Action motion_ = Action::no_motion;
  Plane plane_ = Plane::xy;
  double unit_;  // mm
  bool absolute_ = true, absolute_centres_ = false;
  double feed_;                          // mm/s
  bool fed_ = false;                     // a feed is known
  bool spindle_ = true, output_ = true;  // on as long as the program does not use them
  std::optional<int> switch_output_;
  std::optional<Vec> last_handle_;  // of the G5 before: P Q
  double dwelt_ = 0;                // s, of all dwells
  std::size_t away_ = 0;            // line of a move to a point of the machine, after the first move

  std::optional<std::size_t> first_spindle_, first_output_;  // block where the switch is first used
  // of the line at hand
  std::uint32_t used_ = 0;
  std::optional<double> dwell_;  // s
  bool sound_ = true, ends_ = false, moves_machine_ = false, unknown_m_ = false;
};

}  // namespace bahnwerk::gcode
