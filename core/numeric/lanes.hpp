#pragma once
/// One number per axis, calculated with at once: two axes fit a vector register of every 64-bit processor.
#include <array>
#include <bit>
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
    friend type operator-(const type& a) {
      return each([&](std::size_t i) { return -a[i]; });
    }
    friend type larger(const type& a, const type& b) {
      return each([&](std::size_t i) { return a[i] > b[i] ? a[i] : b[i]; });
    }
    friend type absolute(const type& a) {
      return each([&](std::size_t i) { return std::abs(a[i]); });
    }
    friend type where_less(const type& a, const type& b, const type& yes) {
      return each([&](std::size_t i) { return a[i] < b[i] ? yes[i] : 0.0; });
    }
    friend double largest_of(const type& a) {
      double most = a[0];
      for (std::size_t i = 1; i < N; ++i) most = a[i] > most ? a[i] : most;
      return most;
    }
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

/// What lanes and plain numbers have in common, for code that serves both.
inline double root(double a) { return std::sqrt(a); }
inline Lanes<2> root(Lanes<2> a) { return Lanes<2>{std::sqrt(a[0]), std::sqrt(a[1])}; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline Lanes<2> larger(Lanes<2> a, Lanes<2> b) { return a > b ? a : b; }
inline double absolute(double a) { return std::abs(a); }
inline Lanes<2> absolute(Lanes<2> a) { return magnitude<2>(a); }
/// `yes` where a < b, else 0.
inline double where_less(double a, double b, double yes) { return a < b ? yes : 0; }
inline Lanes<2> where_less(Lanes<2> a, Lanes<2> b, Lanes<2> yes) { return a < b ? yes : Lanes<2>{0, 0}; }
/// The largest lane.
inline double largest_of(double a) { return a; }
inline double largest_of(Lanes<2> a) { return a[0] > a[1] ? a[0] : a[1]; }

/// The numbers of an array as lanes, and back.
template <std::size_t N>
inline Lanes<static_cast<int>(N)> lanes(const std::array<double, N>& a) {
  return std::bit_cast<Lanes<static_cast<int>(N)>>(a);
}
template <int N>
inline std::array<double, N> numbers(const Lanes<N>& a) {
  return std::bit_cast<std::array<double, N>>(a);
}

}  // namespace bahnwerk
