#pragma once
/// Vectors of N numbers that are computed at once, such as one number per axis or per cell. Two doubles fit a vector
/// register of every 64-bit processor. The
/// functions below accept plain numbers as well, so that one piece of code serves both.
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
    friend type operator/(double a, const type& b) {
      return each([&](std::size_t i) { return a / b[i]; });
    }
    friend type operator-(const type& a) {
      return each([&](std::size_t i) { return -a[i]; });
    }
    friend type root(const type& a) {
      return each([&](std::size_t i) { return std::sqrt(a[i]); });
    }
    friend type magnitude(const type& a) {
      return each([&](std::size_t i) { return std::abs(a[i]); });
    }
    friend type smaller(const type& a, const type& b) {
      return each([&](std::size_t i) { return a[i] < b[i] ? a[i] : b[i]; });
    }
    friend type larger(const type& a, const type& b) {
      return each([&](std::size_t i) { return a[i] > b[i] ? a[i] : b[i]; });
    }
    friend type where_less(const type& a, const type& b, const type& yes) {
      return each([&](std::size_t i) { return a[i] < b[i] ? yes[i] : 0.0; });
    }
    friend double sum(const type& a) {
      double s = a[0];
      for (std::size_t i = 1; i < N; ++i) s += a[i];
      return s;
    }
    friend double largest(const type& a) {
      double most = a[0];
      for (std::size_t i = 1; i < N; ++i) most = a[i] > most ? a[i] : most;
      return most;
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

inline double root(double a) { return std::sqrt(a); }
inline Lanes<2> root(Lanes<2> a) { return Lanes<2>{std::sqrt(a[0]), std::sqrt(a[1])}; }

inline double magnitude(double a) { return std::abs(a); }
inline Lanes<2> magnitude(Lanes<2> a) {
  typedef long long Bits __attribute__((vector_size(16)));
  const Bits sign = {static_cast<long long>(1ULL << 63), static_cast<long long>(1ULL << 63)};
  return reinterpret_cast<Lanes<2>>(reinterpret_cast<Bits>(a) & ~sign);
}

inline double smaller(double a, double b) { return a < b ? a : b; }
inline Lanes<2> smaller(Lanes<2> a, Lanes<2> b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline Lanes<2> larger(Lanes<2> a, Lanes<2> b) { return a > b ? a : b; }

/// Returns `yes` where a < b, else 0.
inline double where_less(double a, double b, double yes) { return a < b ? yes : 0; }
inline Lanes<2> where_less(Lanes<2> a, Lanes<2> b, Lanes<2> yes) { return a < b ? yes : Lanes<2>{0, 0}; }

/// Reduce all lanes to one number.
inline double sum(Lanes<2> a) { return a[0] + a[1]; }
inline double largest(double a) { return a; }
inline double largest(Lanes<2> a) { return a[0] > a[1] ? a[0] : a[1]; }

/// Converts an array to lanes, and back.
template <std::size_t N>
inline Lanes<static_cast<int>(N)> lanes(const std::array<double, N>& a) {
  return std::bit_cast<Lanes<static_cast<int>(N)>>(a);
}
template <int N>
inline std::array<double, N> numbers(const Lanes<N>& a) {
  return std::bit_cast<std::array<double, N>>(a);
}

}  // namespace bahnwerk
