#pragma once
/// Collects the obstacles of a part, with names for reports.
#include <memory>
#include <string>
#include <vector>

#include "core/winding/needle/rotor_obstacles.hpp"

namespace bahnwerk::winding {

inline constexpr const char* winding_tool = "winding tool";  ///< name of the posts of winding tools

class PartObstacles {
 public:
  void add(std::unique_ptr<Obstacle> obstacle, std::string name);
  /// Returns the list for clearance(); valid as long as this object.
  const std::vector<const Obstacle*>& list() const { return list_; }
  /// Returns the name of entry i of the list, such as "stack" or "winding tool".
  const std::string& name(std::size_t i) const { return names_.at(i); }

 private:
  std::vector<std::unique_ptr<Obstacle>> owned_;
  std::vector<const Obstacle*> list_;
  std::vector<std::string> names_;
};

/// Returns "stack", and a "winding tool" per slot side of each coil. Throws like StatorIron and tool_posts.
PartObstacles part_obstacles(const StatorPart& part, const Slot& slot, const ToolPost& post,
                             const std::vector<Coil>& coils);
/// Returns "pole", and an "end cap" wall above and below each pole. Throws like RotorIron and cap_walls.
PartObstacles part_obstacles(const RotorPart& part, const Slot& slot, const RotorShape& shape = {});

}  // namespace bahnwerk::winding
