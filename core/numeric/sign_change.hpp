#pragma once
/// Root finding by the Illinois method: secants inside a bracket, in which the value at an end that remains for a
/// second time is halved [Dowell, Jarratt, BIT 11 (1971), 168–174]. The caller evaluates and decides when to stop:
///
///   SignChange bracket{low, f(low), high, f(high)};
///   for (…) { const double x = bracket.next(); bracket.take(x, f(x)); }
namespace bahnwerk {

/// A bracket with a change of sign.
struct SignChange {
  double low, f_low, high, f_high;  ///< bracket and values; f_low and f_high have opposite signs and may be halved
  int side = 0;                     ///< end that the last place replaced: −1 low, 1 high

  /// Returns the next place. By rounding it may coincide with an end or lie beyond it.
  double next() const { return (low * f_high - high * f_low) / (f_high - f_low); }
  double middle() const { return low + (high - low) / 2; }
  bool holds(double x) const { return x > low && x < high; }
  void take(double x, double f) {
    if ((f > 0) == (f_low > 0)) {
      low = x, f_low = f;
      if (side < 0) f_high /= 2;
      side = -1;
    } else {
      high = x, f_high = f;
      if (side > 0) f_low /= 2;
      side = 1;
    }
  }
};

}  // namespace bahnwerk
