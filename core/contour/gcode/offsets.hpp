#pragma once
/// The zero of a part program: work offsets (G54 … G59.3, G10), and the additional offset of G52 or G92.
#include <array>
#include <cstddef>
#include <optional>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::gcode {

inline constexpr std::size_t work_offsets = 9;  ///< G54 … G59, G59.1, G59.2, G59.3

/// Returns the index of a work offset by ten times its word: G59.1 is 591.
constexpr std::size_t work_offset_index(int tenfold) {
  return static_cast<std::size_t>(tenfold <= 590 ? (tenfold - 540) / 10 : tenfold - 585);
}

/// Lengths are in mm, in the coordinates of the contour, which are machine coordinates where the document gives the
/// work offsets.
class Offsets {
 public:
  explicit Offsets(const std::array<std::optional<Vec>, work_offsets>& given) {
    for (std::size_t i = 0; i < work_offsets; ++i)
      if (given[i]) set_work(i, *given[i]);
  }

  Vec origin() const { return origin_; }  ///< zero of the program with the current offsets
  std::size_t active() const { return active_; }
  Vec work(std::size_t index) const { return work_[index]; }
  bool known(std::size_t index) const { return known_[index]; }  ///< whether document or program gave it; else it is 0
  Vec local() const { return on_ ? local_ : Vec{}; }
  bool shifted() const { return on_; }  ///< whether an offset of G52 or G92 is active

  void select(std::size_t index) { active_ = index, update(); }
  void set_work(std::size_t index, Vec at) { work_[index] = at, known_[index] = true, update(); }
  /// G52 and G92 share one offset, as in LinuxCNC: the later one replaces the earlier.
  void set_local(Vec by) { local_ = by, on_ = true, update(); }
  void clear_local(bool keep) {
    if (!keep) local_ = {};
    on_ = false, update();
  }
  void restore_local() { on_ = true, update(); }

 private:
  void update() { origin_ = work_[active_] + local(); }

  std::array<Vec, work_offsets> work_{};
  std::array<bool, work_offsets> known_{};
  Vec local_, origin_;
  std::size_t active_ = 0;
  bool on_ = false;
};

}  // namespace bahnwerk::gcode
