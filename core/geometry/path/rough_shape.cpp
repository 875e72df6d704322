#include "core/geometry/path/rough_shape.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr double steps = 1 << 20;  // steps per unit of directions, and of lengths relative to themselves

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {  // the finaliser of MurmurHash3
  hash ^= word + 0x9e3779b97f4a7c15u;
  hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdu;
  hash = (hash ^ (hash >> 33)) * 0xc4ceb9fe1a85ec53u;
  return hash ^ (hash >> 33);
}

std::uint64_t rounded(double x) { return static_cast<std::uint64_t>(std::llround(std::clamp(x, -2.0, 2.0) * steps)); }

std::uint64_t with(std::uint64_t hash, Vec v) {
  return mixed(mixed(mixed(hash, rounded(v.x)), rounded(v.y)), rounded(v.z));
}

std::uint64_t with(std::uint64_t hash, double length) {
  int exponent = 0;
  auto mantissa = std::llround(std::frexp(length, &exponent) * steps);
  if (mantissa == static_cast<long long>(steps))
    mantissa /= 2, ++exponent;  // the mantissa was rounded up to a power of two
  return mixed(mixed(hash, static_cast<std::uint64_t>(mantissa)), static_cast<std::uint64_t>(exponent));
}

}  // namespace

std::uint64_t rough_shape(const Path& path, std::size_t first, std::size_t last) {
  const Segment &begin = path[first], &end = path[last - 1];
  const double length = end.s1() - begin.s0();
  const PathPoint from = begin.at_parameter(begin.curve().begin()), to = end.at_parameter(end.curve().end());
  std::uint64_t hash = mixed(0, last - first);
  hash = with(hash, length);
  hash = with(hash, begin.length());
  return with(with(with(hash, from.d1), to.d1), (to.value - from.value) / length);
}

std::span<const std::size_t> RoughIndex::of(std::uint64_t shape) const {
  const auto at = seen_.find(shape);
  if (at == seen_.end()) return {};
  return {at->second.index.data(), std::min(at->second.count, kept)};
}

void RoughIndex::add(std::uint64_t shape, std::size_t index) {
  Latest& latest = seen_[shape];
  std::shift_right(latest.index.begin(), latest.index.end(), 1);
  latest.index[0] = index;
  ++latest.count;
}

}  // namespace bahnwerk
