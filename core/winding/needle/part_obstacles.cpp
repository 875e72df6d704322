#include "core/winding/needle/part_obstacles.hpp"

#include <utility>

namespace bahnwerk::winding {

void PartObstacles::add(std::unique_ptr<Obstacle> obstacle, std::string name) {
  list_.push_back(obstacle.get());
  owned_.push_back(std::move(obstacle));
  names_.push_back(std::move(name));
}

PartObstacles part_obstacles(const StatorPart& part, const Slot& slot, const ToolPost& post,
                             const std::vector<Coil>& coils) {
  PartObstacles all;
  all.add(std::make_unique<StatorIron>(part, slot), "stack");
  for (const Coil& coil : coils)
    for (Block& block : tool_posts(part, post, coil)) all.add(std::make_unique<Block>(block), winding_tool);
  return all;
}

PartObstacles part_obstacles(const RotorPart& part, const Slot& slot, const RotorShape& shape) {
  PartObstacles all;
  all.add(std::make_unique<RotorIron>(part, slot, shape), "pole");
  for (Wall& wall : cap_walls(part, slot, shape)) all.add(std::make_unique<Wall>(std::move(wall)), "end cap");
  return all;
}

}  // namespace bahnwerk::winding
