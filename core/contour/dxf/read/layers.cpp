#include "core/contour/dxf/read/layers.hpp"

#include <algorithm>
#include <map>

#include "core/contour/dxf/read/tags.hpp"

namespace bahnwerk {

DxfLayers::DxfLayers(const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted) wanted_.push_back(dxf_lower(name));
}

void DxfLayers::declare(const DxfFile& file) { declared_ = file.layers; }

const DxfLayers::Layer& DxfLayers::operator[](std::string_view name) {
  const auto [found, is_new] = layers_.try_emplace(name);
  if (is_new) {
    const std::string lower = dxf_lower(name);
    if (const auto declared = declared_.find(lower); declared != declared_.end())
      found->second.state = declared->second;
    // A layer that is requested by its name is read, plotted or not.
    if (!wanted_.empty()) found->second.state.unplotted = false;
    found->second.wanted = wanted_.empty() || std::find(wanted_.begin(), wanted_.end(), lower) != wanted_.end();
  }
  return found->second;
}

std::vector<InputFault> DxfLayers::missing() const {
  constexpr std::size_t max_listed = 30;
  if (wanted_.empty()) return {};
  std::map<std::string, std::string> existing;  // sorted; by the name in lower case, as written
  for (const auto& [lower, layer] : declared_) existing.emplace(lower, layer.name);
  for (const auto& [name, layer] : layers_) existing.emplace(dxf_lower(name), name);
  std::string list;
  std::size_t listed = 0;
  for (const auto& [lower, name] : existing) {
    if (listed == max_listed) break;
    list += (listed++ == 0 ? "" : ", ") + dxf_quoted(name);
  }
  if (existing.size() > listed) list += " and " + std::to_string(existing.size() - listed) + " more";
  std::vector<InputFault> faults;
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    if (!existing.contains(wanted_[i]))
      faults.push_back({{"contour", "layers", std::to_string(i)},
                        "is no layer of the drawing" + (list.empty() ? std::string() : "; it has " + list)});
  return faults;
}

}  // namespace bahnwerk
