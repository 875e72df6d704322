#pragma once
/// One number per axis, calculated with at once: two axes fit a vector register of every 64-bit processor.
#include <array>
#include <cmath>
#include <cstddef>

namespace bahnwerk {

/// N numbers with + − · / lane by lane and with a single number, and [i].
template <int N>
struct LanesOf {
  struct type {
    std::array<double, N> lane;
    double& operator[](std::size_t i) { return lane[i]; }
    double operator[](std::size_t i) const { return lane[i]; }
    template <class F>
    static type each(F f) {
      type r;
      for (std::size_t i = 0; i < N; ++i) r.lane[i] = f(i);
      return r;
    }
    friend type operator+(const type& a, const type& b) {
      return each([&](std::size_t i) { return a[i] + b[i]; });
    }
    friend type operator-(const type& a, const type& b) {
      return each([&](std::size_t i) { return a[i] - b[i]; });
    }
    friend type operator*(const type& a, const type& b) {
      return each([&](std::size_t i) { return a[i] * b[i]; });
    }
    friend type operator/(const type& a, const type& b) {
      return each([&](std::size_t i) { return a[i] / b[i]; });
    }
    friend type operator+(double a, const type& b) {
      return each([&](std::size_t i) { return a + b[i]; });
    }
    friend type operator-(double a, const type& b) {
      return each([&](std::size_t i) { return a - b[i]; });
    }
    friend type operator*(double a, const type& b) {
      return each([&](std::size_t i) { return a * b[i]; });
    }
    friend type operator*(const type& a, double b) { return b * a; }
    friend type operator/(double a, const type& b) {
      return each([&](std::size_t i) { return a / b[i]; });
    }
  };
};
/// A vector extension of GCC and Clang.
template <>
struct LanesOf<2> {
  typedef double type __attribute__((vector_size(16)));
};
template <int N>
using Lanes = typename LanesOf<N>::type;

/// |a| lane by lane.
template <int N>
inline Lanes<N> magnitude(const Lanes<N>& a) {
  if constexpr (N == 2) {
    typedef long long Bits __attribute__((vector_size(16)));
    const Bits sign = {static_cast<long long>(1ULL << 63), static_cast<long long>(1ULL << 63)};
    return reinterpret_cast<Lanes<2>>(reinterpret_cast<Bits>(a) & ~sign);
  } else {
    return Lanes<N>::each([&](std::size_t i) { return std::abs(a[i]); });
  }
}

/// a with its sign changed where b is negative.
template <int N>
inline Lanes<N> turned(const Lanes<N>& a, const Lanes<N>& b) {
  if constexpr (N == 2) {
    typedef long long Bits __attribute__((vector_size(16)));
    const Bits sign = {static_cast<long long>(1ULL << 63), static_cast<long long>(1ULL << 63)};
    return reinterpret_cast<Lanes<2>>(reinterpret_cast<Bits>(a) ^ (reinterpret_cast<Bits>(b) & sign));
  } else {
    return Lanes<N>::each([&](std::size_t i) { return std::signbit(b[i]) ? -a[i] : a[i]; });
  }
}

}  // namespace bahnwerk
