#include "core/winding/wire.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bahnwerk::winding {
namespace {

/// Tables of dimensions of IEC 60317-0-1: for each nominal diameter of the R 20 series the smallest increase by the
/// enamel and the largest one (largest overall diameter less the nominal one), grades 1 to 3. The R 40 size before it
/// has the same increases. Values are in µm.
struct Row {
  int r20, r40;
  std::array<int, 3> least, most;
};
constexpr Row rows[] = {
    {200, 0, {14, 27, 40}, {26, 39, 52}},        {224, 212, {15, 29, 43}, {28, 42, 56}},
    {250, 236, {17, 32, 48}, {31, 47, 62}},      {280, 265, {18, 33, 50}, {32, 49, 65}},
    {315, 300, {19, 35, 53}, {34, 52, 69}},      {355, 335, {20, 38, 57}, {37, 56, 73}},
    {400, 375, {21, 40, 60}, {39, 59, 78}},      {450, 425, {22, 42, 64}, {41, 63, 83}},
    {500, 475, {24, 45, 67}, {44, 66, 87}},      {560, 530, {25, 47, 71}, {46, 70, 93}},
    {630, 600, {27, 50, 75}, {49, 74, 98}},      {710, 670, {28, 53, 80}, {52, 79, 104}},
    {800, 750, {30, 56, 85}, {55, 84, 111}},     {900, 850, {32, 60, 90}, {59, 89, 118}},
    {1000, 950, {34, 63, 95}, {62, 94, 124}},    {1120, 1060, {34, 65, 98}, {64, 97, 128}},
    {1250, 1180, {35, 67, 100}, {66, 99, 131}},  {1400, 1320, {36, 69, 103}, {68, 102, 135}},
    {1600, 1500, {38, 71, 107}, {70, 106, 140}}, {1800, 1700, {39, 73, 110}, {72, 109, 144}},
    {2000, 1900, {40, 75, 113}, {74, 112, 148}}, {2240, 2120, {41, 77, 116}, {76, 115, 152}},
    {2500, 2360, {42, 79, 119}, {78, 118, 156}}, {2800, 2650, {43, 81, 123}, {80, 122, 161}},
    {3150, 3000, {45, 84, 127}, {83, 126, 166}}, {3550, 3350, {46, 86, 130}, {85, 129, 171}},
    {4000, 3750, {47, 89, 134}, {88, 133, 176}}, {4500, 4250, {49, 92, 138}, {91, 137, 181}},
    {5000, 4750, {50, 94, 142}, {93, 141, 186}},
};

Wire wire(const Row& row, int nominal, int grade) {
  const auto g = static_cast<std::size_t>(grade - 1);
  const int outer = nominal + row.most[g];
  return {nominal / 1000.0, outer / 1000.0, static_cast<double>(row.most[g] - row.least[g]) / outer};
}

}  // namespace

std::vector<Wire> standard_wires(int grade, double least, double most, Series series) {
  std::vector<Wire> list;
  const auto add = [&](const Row& row, int nominal) {
    if (nominal > 0 && nominal >= std::lround(1000 * least) && nominal <= std::lround(1000 * most))
      list.push_back(wire(row, nominal, grade));
  };
  for (const Row& row : rows) {
    if (series == Series::r40) add(row, row.r40);
    add(row, row.r20);
  }
  return list;
}

std::optional<Wire> standard_wire(double copper, int grade) {
  for (const Wire& wire : standard_wires(grade, copper, copper, Series::r40))
    if (std::abs(wire.copper - copper) < 1e-9) return wire;
  return std::nullopt;
}

int nearest_grade(const Wire& wire) {
  int nearest = 1;
  double least = std::numeric_limits<double>::infinity();
  for (const int grade : {1, 2, 3}) {
    const std::vector<Wire> list = standard_wires(grade, 0, 10, Series::r40);
    const auto like = std::min_element(list.begin(), list.end(), [&](const Wire& a, const Wire& b) {
      return std::abs(a.copper - wire.copper) < std::abs(b.copper - wire.copper);
    });
    const double off = std::abs(wire.outer - wire.copper - (like->outer - like->copper));
    if (off < least) least = off, nearest = grade;
  }
  return nearest;
}

}  // namespace bahnwerk::winding
