#pragma once
/// Cutter radius compensation (G41, G42). It sits between the program and a Mover and offsets lines and arcs in the
/// plane of x and y, one move late.
///
/// - Outside corners are rounded by an arc about the corner, inside corners trimmed to the crossing of the offset
/// curves.
/// - The first move leads in. A straight one ends beside the beginning of the next move, or, where the cutter would
///   touch that beginning on its way, continues along the tangent and round it; an arc ends beside its programmed end,
///   in its direction, with another radius. The first move behind G40 is straight and leads out in the mirrored manner.
///   At another height than the contour both are straight.
/// - Moves along z alone, dwells and switches happen at the cutter's position at that time.
///
/// These are refused as gouges: an arc narrower than the cutter, an inside corner in which one of its two moves is
/// trimmed away, a closed contour that begins in an inside corner, a lead-in or lead-out that is shorter than the
/// radius or comes from the wrong side. Only neighbours are compared: a wall elsewhere that the cutter would touch is
/// not detected.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/contour/gcode/moves/mover.hpp"
#include "core/contour/gcode/moves/offset_piece.hpp"

namespace bahnwerk::gcode {

/// A Mover whose moves are offset while compensation is on. With it off, moves are passed on unchanged.
class Compensation {
 public:
  static constexpr double slack = 1e-3;  ///< mm by which moves may be too short, since coordinates are rounded

  explicit Compensation(bool flat) : mover_(flat) {}

  /// Begins the offset of `aside` ≠ 0 mm (positive: to the left) with the next move.
  void begin(double aside);
  /// Ends the offset; the next move leads out.
  void end();
  bool on() const { return state_ == State::leads_in || state_ == State::on; }
  double aside() const { return aside_; }

  // The interface of Mover; places are those of the program.
  void use(Mode mode, double feed) { off() ? mover_.use(mode, feed) : keep(mode, feed); }
  void first_switch();
  void place(Vec at) { mover_.place(programmed_ = at); }
  void start(Vec at) { mover_.start(programmed_ = at); }
  bool started() const { return mover_.started(); }
  /// `across` says that the program names x or y, even if they do not change.
  void line(Vec to, bool across = true) { off() ? mover_.line(to) : offset(to, across); }
  void arc(Vec to, Vec centre, ArcMove how) { off() ? mover_.arc(to, centre, how) : offset(to, centre, how); }
  void spline(Vec to, Vec first, std::optional<Vec> second);
  void dwell(Mode mode, double seconds);
  Vec position() const { return off() ? mover_.position() : programmed_; }
  bool climbs() const { return mover_.climbs(); }
  ContourBuilder& builder() { return mover_.builder(); }
  Contour finish();

 private:
  enum class State { off, leads_in, on, leads_out };
  /// Mode and feed of a move, and its line for faults.
  struct Manner {
    Mode mode = Mode::cut;
    double feed = std::numeric_limits<double>::infinity();
    std::size_t line = 0;
  };
  /// An event between two moves in the plane.
  struct Event {
    enum class Kind { height, dwell, first_switch } kind;
    Manner manner;
    double value;  // mm, s
  };
  struct Move {
    OffsetPiece piece;
    Manner manner;
    double z;  // height of its end
    double tolerance;
  };

  bool off() const { return state_ == State::off; }
  void keep(Mode mode, double feed) { manner_.mode = mode, manner_.feed = feed; }
  Manner manner() { return {manner_.mode, manner_.feed, mover_.builder().line()}; }

  void offset(Vec to, bool across);
  void offset(Vec to, Vec centre, ArcMove how);
  void add(Move move);
  void lead_in(const Move& next);
  void lead_in(Vec to, Vec along, double sense);
  void lead_out(Vec to);
  void corner(Move& next);
  void round(Vec corner, Vec to, const Manner& manner);
  void drive(const Move& move);
  void drive(Vec to, double z, const Manner& manner);
  void happens(const Event& event);
  void happen();
  void flush();
  void fault(std::size_t line, const char* message);

  Mover mover_;
  State state_ = State::off;
  double aside_ = 0;
  Vec programmed_;
  Manner manner_;
  std::optional<Vec> lead_;  // end of the move that leads in
  Manner lead_manner_;
  std::optional<Move> last_;          // last move, not written yet because its end depends on the next one
  std::optional<OffsetPiece> first_;  // first piece since the lead-in
  std::vector<Event> events_;         // events behind the last move
};

}  // namespace bahnwerk::gcode
