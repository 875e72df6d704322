#include "core/contour/gcode/words/parameters.hpp"

#include <algorithm>

namespace bahnwerk::gcode {

/// Most programs have no parameters.
void Parameters::reserve() {
  if (!values_.empty()) return;
  values_.assign(most + 1, 0.0);
  known_.assign(most + 1, false);
}

double Parameters::get(int number, std::size_t line) {
  if (system(number)) return system_.system_parameter(number);
  reserve();
  const auto i = static_cast<std::size_t>(number);
  if (!known_[i] && unset_.count++ == 0) unset_.number = number, unset_.line = line;
  return values_[i];
}

void Parameters::set(int number, double value) {
  reserve();
  values_[static_cast<std::size_t>(number)] = value;
  known_[static_cast<std::size_t>(number)] = true;
}

std::optional<double> Parameters::get(std::string_view name) const {
  const Names& list = name.substr(0, 1) == "_" || frames_.empty() ? global_ : frames_.back().names;
  const auto at = list.find(name);
  return at == list.end() ? std::nullopt : std::optional(at->second);
}

bool Parameters::set(std::string_view name, double value) {
  Names& list = names(name);
  if (const auto at = list.find(name); at != list.end()) {
    at->second = value;
    return true;
  }
  if (name_count_ == max_names) return false;
  ++name_count_;
  list.emplace(name, value);
  return true;
}

void Parameters::enter(const std::vector<double>& arguments) {
  reserve();
  Frame& frame = frames_.emplace_back();
  for (std::size_t i = 0; i < locals; ++i) {
    frame.saved[i] = values_[i + 1];
    frame.known[i] = known_[i + 1];
    if (i < arguments.size()) set(static_cast<int>(i) + 1, arguments[i]);
  }
}

void Parameters::leave() {
  const Frame& frame = frames_.back();
  for (std::size_t i = 0; i < locals; ++i) {
    values_[i + 1] = frame.saved[i];
    known_[i + 1] = frame.known[i];
  }
  name_count_ -= frame.names.size();
  frames_.pop_back();
}

}  // namespace bahnwerk::gcode
