#pragma once
/// Where a continuous function changes its sign: the Illinois method, secants kept inside a bracket, with the value at
/// an end that stays for a second time halved [Dowell, Jarratt, BIT 11 (1971), 168–174]. The caller evaluates, and
/// decides when it is enough:
///
///   SignChange bracket{low, f(low), high, f(high)};
///   for (…) { const double x = bracket.next(); bracket.take(x, f(x)); }
namespace bahnwerk {

struct SignChange {
  double low, f_low, high, f_high;  ///< f_low and f_high of opposite signs; values that count, halved ones too
  int side = 0;                     ///< that the last place replaced: low, −1, or high, 1

  /// May fall onto an end, or beyond it, by rounding.
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
