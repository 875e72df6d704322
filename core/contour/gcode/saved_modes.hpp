#pragma once
/// Modes that M70 and M73 save and M72 or the end of a subprogram restores, as in LinuxCNC; the motion word is not
/// saved.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/contour/gcode/moves/mover.hpp"

namespace bahnwerk::gcode {

/// The modes that are saved.
struct Modes {
  double unit = 1;  ///< length of the program's unit, mm
  Plane plane = Plane::xy;
  bool absolute = true, absolute_centres = false;
  double feed = 0;  ///< mm/s; with G93 1/s
  bool fed = false, feed_lost = false, inverse_time = false;
  std::size_t work_offset = 0;  ///< index of the active work offset
  bool back_to_start = true;    ///< whether G98 is active
  bool spindle = false;         ///< whether the spindle is switched on
  double aside = 0;             ///< cutter radius compensation, mm; 0: off
  double speed = 0;             ///< last S word
};

/// Holds the saved modes of the main program and of each active subprogram.
class SavedModes {
 public:
  void save(const Modes& modes, bool at_return) { levels_.back() = {modes, at_return}; }
  void forget() { levels_.back() = {}; }
  const std::optional<Modes>& saved() const { return levels_.back().modes; }
  void enter() { levels_.emplace_back(); }
  /// Returns the modes that the ending subprogram restores.
  std::optional<Modes> leave() {
    const Level level = levels_.back();
    levels_.pop_back();
    return level.at_return ? level.modes : std::nullopt;
  }

 private:
  struct Level {
    std::optional<Modes> modes;
    bool at_return = false;
  };
  std::vector<Level> levels_{1};
};

}  // namespace bahnwerk::gcode
