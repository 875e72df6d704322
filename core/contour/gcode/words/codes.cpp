#include "core/contour/gcode/words/codes.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr Code refused(const char* why) { return {Group::none, Action::refuse, why}; }
constexpr Code ignored() { return {Group::none, Action::nothing, ""}; }

constexpr Code motion(Action action) { return {Group::motion, action, ""}; }

}  // namespace

std::string name(int tenfold) {
  std::string text(1, 'G');
  text += std::to_string(tenfold / 10);
  if (tenfold % 10 != 0) text.append(1, '.').append(std::to_string(tenfold % 10));
  return text;
}

std::string m_name(int m) {
  std::string text(1, 'M');
  text += std::to_string(whole_m(m));
  if (m < 0) text.append(1, '.').append(std::to_string(-m % 10));
  return text;
}

bool known_m(int m) {
  return (m >= 0 && m <= 9) || m == 19 || m == 30 || (m >= 48 && m <= 53) || (m >= 60 && m <= 68) ||
         (m >= 70 && m <= 73) || (m >= 97 && m <= 99);
}

bool takes_words(int tenfold) {
  switch (meaning(tenfold).action) {
    case Action::no_motion:
    case Action::plane_xy:
    case Action::plane_zx:
    case Action::plane_yz:
    case Action::inch:
    case Action::millimetre:
    case Action::absolute:
    case Action::incremental:
    case Action::absolute_centres:
    case Action::incremental_centres:
    case Action::retract_to_start:
    case Action::retract_to_r:
    case Action::compensation_off:
    case Action::work_offset:
    case Action::reset_position:
    case Action::restore_position:
    case Action::store_reference:
    case Action::per_minute:
    case Action::inverse_time:
    case Action::cancel:
    case Action::nothing:
      return false;
    default:
      return true;
  }
}

bool printer_m(int m) {
  return m == 17 || m == 18 || (m >= 82 && m <= 85) || m == 92 || (m >= 104 && m <= 119) || (m >= 140 && m <= 150) ||
         (m >= 190 && m <= 192) || (m >= 200 && m <= 229) || (m >= 240 && m <= 360) || (m >= 400 && m <= 499) ||
         (m >= 500 && m <= 605) || (m >= 851 && m <= 928);
}

const char* printer_effect(int m) {
  switch (m) {
    case 92:
    case 206:
    case 218:
    case 290:
    case 428:
    case 556:
    case 579:
    case 851:
    case 852:
      return "shifts, turns or scales coordinates of a printer: skipped, they are taken as they are written";
    case 201:
    case 202:
    case 203:
    case 204:
    case 205:
    case 566:
      return "sets limits of a printer's motion: skipped, the limits of the document hold";
    case 220:
      return "changes the feeds of a printer: skipped, F is taken as it is written";
    default:
      return nullptr;
  }
}

Code meaning(int tenfold) {
  switch (tenfold) {
    case 0:
      return motion(Action::rapid);
    case 10:
      return motion(Action::line);
    case 20:
      return motion(Action::arc_cw);
    case 30:
      return motion(Action::arc_ccw);
    case 50:
      return motion(Action::cubic);
    case 51:
      return motion(Action::quadratic);
    case 800:
      return {Group::none, Action::no_motion, ""};  // headers put it beside G0
    case 170:
      return {Group::plane, Action::plane_xy, ""};
    case 180:
      return {Group::plane, Action::plane_zx, ""};
    case 190:
      return {Group::plane, Action::plane_yz, ""};
    case 200:
      return {Group::units, Action::inch, ""};
    case 210:
      return {Group::units, Action::millimetre, ""};
    case 900:
      return {Group::distance, Action::absolute, ""};
    case 910:
      return {Group::distance, Action::incremental, ""};
    case 901:
      return {Group::centres, Action::absolute_centres, ""};
    case 911:
      return {Group::centres, Action::incremental_centres, ""};
    case 40:
      return {Group::none, Action::dwell, ""};
    case 280:
    case 300:
      return {Group::none, Action::reference_point, ""};
    case 281:
    case 301:
      return {Group::none, Action::store_reference, ""};
    case 530:
      return {Group::none, Action::machine_coordinates, ""};
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
    case 591:
    case 592:
    case 593:
      return {Group::work, Action::work_offset, ""};
    case 100:
      return {Group::none, Action::set_data, ""};
    case 520:
      return {Group::none, Action::local_offset, ""};
    case 920:
      return {Group::none, Action::set_position, ""};
    case 921:
    case 922:
      return {Group::none, Action::reset_position, ""};
    case 923:
      return {Group::none, Action::restore_position, ""};
    case 930:
      return {Group::feed_mode, Action::inverse_time, ""};
    case 940:
      return {Group::feed_mode, Action::per_minute, ""};
    case 90:
    case 610:
    case 611:
    case 620:
    case 640:
    case 1870:
      return {Group::none, Action::path_control,
              "path control (G9, G61, G64) ignored: the planning of the job says how corners are taken"};
    case 430:
    case 431:
      return {Group::none, Action::tool_length, "tool length (G43) ignored: the contour is that of the tool's tip"};
    case 80:   // radii, not diameters
    case 131:  // no interpolation of a rotary axis
    case 150:  // no polar coordinates
    case 230:  // no forbidden zone
    case 401:  // no tool direction normal to the contour
    case 490:  // no tool length
    case 670:  // no macro
    case 690:  // no rotation
    case 970:  // spindle speed per minute
      return ignored();
    case 500:
    case 501:
      return {Group::none, Action::cancel, ""};
    case 980:
      return {Group::retract, Action::retract_to_start, ""};
    case 990:
      return {Group::retract, Action::retract_to_r, ""};
    case 400:
      return {Group::compensation, Action::compensation_off, ""};
    case 410:
    case 411:
      return {Group::compensation, Action::compensation_left, ""};
    case 420:
    case 421:
      return {Group::compensation, Action::compensation_right, ""};
    case 730:
    case 810:
    case 820:
    case 830:
    case 850:
    case 860:
    case 890:
      return motion(Action::cycle);
    case 740:
    case 840:
      return refused("tapping turns the spindle with the feed, which is not planned: program its moves");
    case 760:
    case 870:
    case 880:
      return refused(
          "this canned cycle is not supported (G73, G81, G82, G83, G85, G86 and G89 are): program its moves");
    case 950:
      return refused("feed per revolution is not supported: use G94 with F per minute, which needs no spindle speed");
    case 960:
      return refused("constant surface speed is not supported");
    case 52:
    case 53:
      return refused("NURBS blocks are not supported: use G5, or the job's own form of a NURBS");
    case 160:
      return refused("polar coordinates are not supported");
    case 510:
    case 680:
      return refused("scaling and rotation of the coordinates are not supported");
    case 511:
      return refused("mirroring of the coordinates is not supported");
    case 71:
    case 121:
      return refused("interpolation of a rotary axis (G7.1, G12.1) is not supported");
    case 171:
    case 181:
    case 191:
      return refused("planes of the axes U, V, W are not supported: only X, Y and Z are");
    case 541:
      return refused("further work offsets are not supported: G54 to G59.3 are");
    case 700:
    case 710:
      return refused(
          "a cycle of lathes, or inches and mm as older controls have them: with g70_g71 \"units\" the document says "
          "so");
    case 720:
      return refused("cycles of lathes are not supported: program its moves");
    case 70:
      return refused("diameters (G7) are not supported");
    case 110:
    case 290:
    case 291:
    case 292:
      return {Group::none, Action::printer, ""};
    case 310:
    case 360:
    case 370:
    case 380:
    case 381:
    case 382:
    case 383:
    case 384:
    case 385:
      return refused("probing is not supported: where the head stops is not known before");
    case 320:
    case 330:
    case 331:
    case 630:
      return refused("threading is not supported");
    case 440:
    case 432:
      return refused("only G43 and G49 are supported for the tool's length");
    case 650:
    case 660:
      return refused("macros are not supported");
    default:
      return refused("is not known");
  }
}

}  // namespace bahnwerk::gcode
