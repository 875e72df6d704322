#pragma once
/// The pictures and tables of the documentation, one function each. Pictures go to the file given.
#include <string>

namespace bahnwerk::draw {

// docs/methods/contour.md
void speeds_on_circle(const std::string& file);
void speeds_on_window(const std::string& file);
void bracket_in_colour(const std::string& file);
void use_on_window(const std::string& file);
void convergence_tables();

// docs/methods/contour_machines.md
void machines_along_the_bracket(const std::string& file);

// docs/methods/motion.md
void straight_moves(const std::string& file);
void plate_in_colour(const std::string& file);
void use_on_plate(const std::string& file);
void corner_enlarged(const std::string& file);

// docs/methods/fill_factor.md
void fill_pictures(const std::string& folder);  ///< nine files
void fill_table();

// docs/methods/winding_path.md
void needle_access(const std::string& file);

}  // namespace bahnwerk::draw
