#pragma once
/// Builds a contour segment by segment. It collects every fault instead of stopping at the first one, and corrects
/// defects of real part files: segments without length are dropped with a note, ends that miss by rounding are joined.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/contour.hpp"

namespace bahnwerk {

/// Segments shorter than this have no direction and are dropped, mm.
inline constexpr double min_segment_length = 1e-6;
/// A curve may start this far from the end of the last one, mm; it is then moved there.
inline constexpr double joint_tolerance = 1e-3;

/// Cost: O(1) per line and arc, O(degree · panels) per polynomial or NURBS.
class ContourBuilder {
 public:
  /// `reader` is empty for a document of blocks and segments. For a text it is its name in the job ("gcode"): faults
  /// then have the place {"contour", reader} and, like notes, begin with "line 12: ", the line of the last at_line().
  /// Equal faults of a text are one, "line 12 and 3 more: ".
  ContourBuilder(std::size_t dimension, Vec start, std::string reader = {});

  void at_line(std::size_t number) { line_ = number; }  ///< lines count from 1; the `source` of segments
  std::size_t line() const { return line_; }
  void start(Vec at) { position_ = at; }  ///< sets the beginning of the contour; only before the first segment
  void block(Mode mode, double feed);     ///< begins a block; mm/s; infinite: limited by the axes alone
  void line(Vec to);
  /// Appends an arc. `normal` points to the viewer who sees the sense of rotation; different heights along it make a
  /// helix. The radii
  /// at both ends may differ by `tolerance`, mm (Arc::through). After a fault the contour continues from `to`, so that
  /// one wrong arc does not make the next one wrong.
  void arc(Vec to, Vec centre, bool counter_clockwise, Vec normal = {0, 0, 1}, double tolerance = 0.01);
  /// Appends a polynomial in the power basis on u ∈ [0, 1]; `rows` has one row of coefficients per coordinate.
  void polynomial(const std::vector<std::vector<double>>& rows);
  void nurbs(int degree, std::vector<Vec> points, std::vector<double> weights, std::vector<double> knots);

  /// Adds a rest of `seconds` at the current point; 0 only stops the motion.
  void dwell(double seconds);

  /// Adds a fault that the reader found in the current segment's document.
  void fault(std::vector<std::string> place, std::string message);
  /// Returns whether further faults are not stored.
  bool full() const { return std::max(faults_.size(), causes_.size()) >= max_faults; }

  Vec position() const { return position_; }
  std::size_t segments() const { return total_; }  ///< segments so far, dropped ones included
  std::size_t blocks() const { return contour_.blocks.size(); }
  /// Returns the contour. Throws InvalidInput with places like {"contour","blocks","3","segments","0","arc","center"},
  /// relative to the job's spec; at most 100 faults.
  Contour finish();

 private:
  static constexpr std::size_t max_faults = 100;

  void next_segment();
  bool add(const std::shared_ptr<const Curve>& curve, Vec end);
  bool meets(Vec start, const char* what);
  std::vector<std::string> place(std::vector<std::string> inner) const;
  void keep(std::vector<std::string> place, std::string message);
  void drop(const std::string& why);
  template <class Make>
  bool guarded(Make make);

  Contour contour_;
  Vec position_;
  std::string reader_;
  std::size_t line_ = 0;
  std::size_t segment_ = 0;  // number of the segment in the current block, from 1
  std::size_t total_ = 0;
  std::size_t dropped_ = 0, first_dropped_ = 0, moved_ = 0;
  double worst_move_ = 0;
  std::vector<InputFault> faults_;
  struct Cause {
    std::string message;
    std::size_t line, count;
  };
  std::vector<Cause> causes_;  // faults of a text, merged by message
};

}  // namespace bahnwerk
