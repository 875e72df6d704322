#pragma once
/// Cam tables as controllers read them, from a stored result of kind "motion_law".
///
/// Derivatives are by the master (unit per master's unit …), as controllers scale them with the master's own velocity.
/// twincat_nc, twincat_mc3: points at the law's breaks, polynomials of degree 5 or 7 between them; semicolons, CR LF.
/// isg: 1000 steps in a text file. lcamhdl_xy: 1000 points; lcamhdl_basic: 51 points, degree 5 between;
/// lcamhdl_advanced: up to 50 elements of degree 5, each with the states at both of its ends. codesys_xyva: structured
/// text, degree 5 between; codesys_xy: 1000 steps, straight.
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/named.hpp"

namespace bahnwerk::api {

enum class ControllerLayout {
  twincat_nc,
  twincat_mc3,
  isg,
  lcamhdl_xy,
  lcamhdl_basic,
  lcamhdl_advanced,
  codesys_xyva,
  codesys_xy,
};
inline constexpr Named<ControllerLayout> controller_layouts[] = {
    {ControllerLayout::twincat_nc, "twincat_nc"},
    {ControllerLayout::twincat_mc3, "twincat_mc3"},
    {ControllerLayout::isg, "isg"},
    {ControllerLayout::lcamhdl_xy, "lcamhdl_xy"},
    {ControllerLayout::lcamhdl_basic, "lcamhdl_basic"},
    {ControllerLayout::lcamhdl_advanced, "lcamhdl_advanced"},
    {ControllerLayout::codesys_xyva, "codesys_xyva"},
    {ControllerLayout::codesys_xy, "codesys_xy"},
};

struct ControllerFile {
  std::string text, content_type;
  std::string extension;  ///< csv, txt or st
  /// Largest differences of the controller's motion from the law, for people: "position 1.2e-07 mm, velocity … mm/s,
  /// …".
  std::string refit_error;
  std::array<double, 4> error{};  ///< the numbers of refit_error, unit/s^r
};
/// Returns the table of `result`, a result document of kind motion_law. `name` is the table's name inside the file,
/// letters and digits.
ControllerFile controller_file(const nlohmann::json& result, ControllerLayout layout, std::string_view name = "law");

}  // namespace bahnwerk::api
