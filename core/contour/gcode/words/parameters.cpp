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
  const auto missing = [&] {
    if (unset_.count++ == 0) unset_.number = number, unset_.line = line;
    return 0.0;
  };
  if (system(number)) {
    const auto value = system_.system_parameter(number);
    return value ? *value : missing();
  }
  reserve();
  const auto i = static_cast<std::size_t>(number);
  return known_[i] ? values_[i] : missing();
}

void Parameters::set(int number, double value) {
  reserve();
  values_[static_cast<std::size_t>(number)] = value;
  known_[static_cast<std::size_t>(number)] = true;
}

std::optional<double> Parameters::get(std::string_view name, std::size_t line) const {
  const Names& list = name.substr(0, 1) == "_" || frames_.empty() ? global_ : frames_.back().names;
  const auto at = list.find(name);
  if (at != list.end()) return at->second;
  if (name == "_line") return static_cast<double>(line);
  if (name == "_call_level") return static_cast<double>(frames_.size());
  if (name == "_value" || name == "_value_returned") return 0;
  return name.substr(0, 1) == "_" ? system_.predefined(name) : std::nullopt;
}

bool Parameters::kept(std::string_view name) const {
  if (name.substr(0, 1) != "_") return false;
  return name == "_line" || name == "_call_level" || name == "_value" || name == "_value_returned" ||
         system_.predefined(name);
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
