#pragma once
/// Builds a contour segment by segment. It collects every fault instead of stopping at the first, and cleans what real
/// part files bring: segments without length are dropped with a note, ends that miss by rounding are joined.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/contour.hpp"

namespace bahnwerk {

/// Segments shorter than this carry no direction: they are dropped, mm.
inline constexpr double min_segment_length = 1e-6;
/// A curve may start this far from where the last one ended, mm; it is then moved there.
inline constexpr double joint_tolerance = 1e-3;

/// Cost: O(1) per line and arc, O(degree · panels) per polynomial or NURBS.
class ContourBuilder {
 public:
  /// `reader`: empty for a document of blocks and segments. For a text, its name in the job ("gcode"): faults then have
  /// the place {"contour", reader} and, like notes, begin with "line 12: ", the line last given to at_line(). Equal
  /// faults of a text are one, "line 12 and 3 more: ".
  ContourBuilder(std::size_t dimension, Vec start, std::string reader = {});

  void at_line(std::size_t number) { line_ = number; }  ///< counted from 1; also the `source` of path segments
  std::size_t line() const { return line_; }
  void start(Vec at) { position_ = at; }  ///< where the contour starts, if only known now: no segment yet
  void block(Mode mode, double feed);     ///< mm/s; infinity = limited by the axes alone
  void line(Vec to);
  /// `normal` points to the viewer who sees the sense of rotation. Different heights along it make a helix.
  /// The radii at both ends may differ by `tolerance`, mm (Arc::through). After a fault the contour stands at `to`, so
  /// that one wrong arc does not make the next one wrong too.
  void arc(Vec to, Vec centre, bool counter_clockwise, Vec normal = {0, 0, 1}, double tolerance = 0.01);
  /// Power basis on u ∈ [0,1], one row per coordinate.
  void polynomial(const std::vector<std::vector<double>>& rows);
  void nurbs(int degree, std::vector<Vec> points, std::vector<double> weights, std::vector<double> knots);

  /// The head rests at the current point, s; 0 = it only stops.
  void dwell(double seconds);

  /// A finding of the reader's own about the current segment's document.
  void fault(std::vector<std::string> place, std::string message);
  bool full() const { return std::max(faults_.size(), causes_.size()) >= max_faults; }  ///< no others are kept

  Vec position() const { return position_; }
  std::size_t segments() const { return total_; }  ///< given so far, dropped ones included
  std::size_t blocks() const { return contour_.blocks.size(); }
  /// Throws InvalidInput with places like {"contour","blocks","3","segments","0","arc","center"}, relative to the job's
  /// spec. At most 100 faults.
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
  std::size_t segment_ = 0;  // of the current block, counted from 1
  std::size_t total_ = 0;
  std::size_t dropped_ = 0, first_dropped_ = 0, moved_ = 0;
  double worst_move_ = 0;
  std::vector<InputFault> faults_;
  struct Cause {
    std::string message;
    std::size_t line, count;
  };
  std::vector<Cause> causes_;  // faults of a text
};

}  // namespace bahnwerk
