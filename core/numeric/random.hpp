#pragma once
/// Seeded random numbers with equal values on every platform (the distributions of <random> differ).
#include <array>
#include <cmath>
#include <cstdint>

namespace bahnwerk {

/// xoshiro256** [Blackman, Vigna: Scrambled linear pseudorandom number generators, 2021], seeded by SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (auto& word : state_) {
      seed += 0x9e3779b97f4a7c15ULL;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      word = z ^ (z >> 31);
    }
  }

  std::uint64_t next() {
    const std::uint64_t result = rotate(state_[1] * 5, 7) * 9, t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotate(state_[3], 45);
    return result;
  }

  /// Returns a uniform number in [0, 1), a multiple of 2⁻⁵³.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Returns a uniform number among 0 … n−1 without bias, n ≥ 1.
  std::uint64_t below(std::uint64_t n) {
    const std::uint64_t reject = (0 - n) % n;  // 2⁶⁴ mod n
    std::uint64_t x = next();
    while (x < reject) x = next();
    return x % n;
  }
  bool chance(double probability) { return uniform() < probability; }

  /// Returns a standard normal number by Marsaglia's polar method; one draw per pair is stored for the next call.
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double a = 0, b = 0, q = 0;
    do {
      a = 2 * uniform() - 1;
      b = 2 * uniform() - 1;
      q = a * a + b * b;
    } while (q >= 1 || q == 0);
    const double k = std::sqrt(-2 * log(q) / q);
    spare_ = b * k;
    has_spare_ = true;
    return a * k;
  }

 private:
  static std::uint64_t rotate(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

  // std::log may differ in the last bit between libraries; +, −, ×, ÷ and √ may not.
  static double log(double x) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);
    if (m < 0.70710678118654752440) {
      m *= 2;
      --exponent;
    }
    const double f = (m - 1) / (m + 1), g = f * f;
    double sum = 0;
    for (int k = 23; k >= 1; k -= 2) sum = sum * g + 1.0 / k;
    return exponent * 0.69314718055994530942 + 2 * f * sum;
  }

  std::array<std::uint64_t, 4> state_{};
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace bahnwerk
