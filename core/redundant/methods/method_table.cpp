#include "core/redundant/methods/method_table.hpp"

#include <stdexcept>

#include "core/redundant/iterative/iterative.hpp"
#include "core/redundant/joint/joint_method.hpp"
#include "core/redundant/known/filter_plan.hpp"
#include "core/redundant/known/follow_up.hpp"
#include "core/redundant/known/geometric.hpp"
#include "core/redundant/known/lag_compensation.hpp"

namespace bahnwerk {
namespace {

// The plan of a lag is not one of the lag backwards, and the curve of the geometric split is the same both ways.
constexpr RedundancyRow rows[] = {
    //  method                              planner  order  every_axis  centres  either_way
    {RedundancyMethod::joint, plan_joint_method, 3, false, false, true},
    {RedundancyMethod::iterative, plan_iterative, 3, true, true, true},
    {RedundancyMethod::geometric, plan_geometric, 2, true, true, false},
    {RedundancyMethod::filter, plan_filter, 2, true, true, true},
    {RedundancyMethod::follow_up, plan_follow_up, 2, true, true, true},
    {RedundancyMethod::lag_compensation, plan_lag_compensation, 2, true, true, false},
};

}  // namespace

const RedundancyRow& redundancy_row(RedundancyMethod method) {
  for (const RedundancyRow& row : rows)
    if (row.method == method) return row;
  throw std::logic_error("a redundancy method without a row");
}

}  // namespace bahnwerk
