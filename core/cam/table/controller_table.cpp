#include "core/cam/table/controller_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cam/bernstein.hpp"

namespace bahnwerk::cam {
namespace {

/// State of the law at t, order by order, unit/s^r, behind or before t.
std::array<double, 4> state(const CamLaw& law, double t, bool before) {
  const double slack = 1e-12 * law.duration();
  std::size_t piece = 0;
  while (piece + 1 < law.pieces() && law.breaks()[piece + 1] <= (before ? t - slack : t + slack)) ++piece;
  const double x = std::clamp((t - law.breaks()[piece]) / law.piece_duration(piece), 0.0, 1.0);
  std::array<double, 4> out{};
  for (int r = 0; r < 4; ++r) out[static_cast<std::size_t>(r)] = law.in_piece(piece, x, r);
  return out;
}

/// Returns the Bernstein coefficients of the curve that a controller drives between two states.
std::vector<double> driven(Between between, double duration, const std::array<double, 4>& from,
                           const std::array<double, 4>& to) {
  const int k = between == Between::straight ? 1 : between == Between::quintic ? 3 : 4, n = 2 * k - 1;
  std::vector<double> b(static_cast<std::size_t>(n + 1));
  for (int i = 0; i < k; ++i) {
    double forward = 0, backward = 0, binomial = 1, scale = 1;
    for (int r = 0; r <= i; ++r) {
      forward += binomial * scale * from[static_cast<std::size_t>(r)];
      backward += (r % 2 == 0 ? binomial : -binomial) * scale * to[static_cast<std::size_t>(r)];
      binomial *= static_cast<double>(i - r) / static_cast<double>(r + 1);
      scale *= duration / static_cast<double>(n - r);
    }
    b[static_cast<std::size_t>(i)] = forward, b[static_cast<std::size_t>(n - i)] = backward;
  }
  return b;
}

/// The part of a polynomial between two of its parameters, over [0, 1].
std::vector<double> part(const std::vector<double>& b, double from, double to) {
  BernsteinArray left{}, right{}, rest{};
  bernstein_split(b, to, left.data(), rest.data());
  bernstein_split({left.data(), b.size()}, to > 0 ? from / to : 0, rest.data(), right.data());
  return {right.begin(), right.begin() + static_cast<std::ptrdiff_t>(b.size())};
}

/// Takes the difference of law and table between t0 and t1 into the errors.
void take_difference(const CamLaw& law, double t0, double t1, const std::vector<double>& table,
                     std::array<double, 4>& error) {
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    const double begin = std::max(t0, law.breaks()[i]), end = std::min(t1, law.breaks()[i + 1]);
    if (!(end - begin > 1e-12 * law.duration())) continue;
    const double own = law.breaks()[i], length = law.piece_duration(i);
    auto a = part(law.piece(i).bernstein, (begin - own) / length, std::min(1.0, (end - own) / length));
    auto b = part(table, (begin - t0) / (t1 - t0), std::min(1.0, (end - t0) / (t1 - t0)));
    BernsteinArray p{}, q{};
    std::copy(a.begin(), a.end(), p.begin());
    std::copy(b.begin(), b.end(), q.begin());
    const std::size_t n = std::max(a.size(), b.size());
    bernstein_raise(p.data(), a.size() - 1, n - 1);
    bernstein_raise(q.data(), b.size() - 1, n - 1);
    for (std::size_t k = 0; k < n; ++k) p[k] -= q[k];
    std::size_t size = n;
    for (double& largest : error) {
      BernsteinExtremes found{-largest, largest};
      take_extremes({p.data(), size}, found);
      largest = std::max(found.high, -found.low);
      size = bernstein_derivative({p.data(), size}, p.data());
      for (std::size_t k = 0; k < size; ++k) p[k] /= end - begin;
    }
  }
}

/// Returns the table of points at given times, joined by `between`.
ControllerTable table_at(const CamLaw& law, const TableCycle& cycle, const std::vector<double>& times,
                         const std::vector<Between>& between, bool own_ends) {
  ControllerTable out;
  const double rate = cycle.duration / cycle.length;  // s per master's unit
  const auto point = [&](std::size_t k, const std::array<double, 4>& now) {
    const bool last = k + 1 == times.size();
    return TablePoint{cycle.begin + (last ? cycle.length : times[k] / rate),
                      now[0],
                      now[1] * rate,
                      now[2] * rate * rate,
                      now[3] * rate * rate * rate,
                      last ? between.back() : between[k]};
  };
  for (std::size_t k = 0; k < times.size(); ++k) {
    const bool last = k + 1 == times.size();
    const std::array<double, 4> now = state(law, times[k], last);
    out.points.push_back(point(k, now));
    if (last) break;
    // A controller that knows one state per point takes the one behind it.
    const std::array<double, 4> next = state(law, times[k + 1], own_ends || k + 2 == times.size());
    out.ends.push_back(point(k + 1, next));
    take_difference(law, times[k], times[k + 1], driven(between[k], times[k + 1] - times[k], now, next), out.error);
  }
  return out;
}

}  // namespace

ControllerTable even_table(const CamLaw& law, const TableCycle& cycle, std::size_t steps, Between between) {
  std::vector<double> times;
  for (std::size_t k = 0; k <= steps; ++k)
    times.push_back(law.duration() * static_cast<double>(k) / static_cast<double>(steps));
  return table_at(law, cycle, times, std::vector<Between>(times.size(), between), false);
}

ControllerTable breaks_table(const CamLaw& law, const TableCycle& cycle, std::size_t max_points, bool septic,
                             bool own_ends) {
  const auto range = law.extremes(0);
  const double stroke = range.highest.value - range.lowest.value, jerk = law.peak(3).value;
  std::vector<bool> jumps(law.pieces() + 1, false);
  for (std::size_t i = 0; i + 1 < law.pieces(); ++i)
    jumps[i + 1] = std::abs(law.in_piece(i, 1, 3) - law.in_piece(i + 1, 0, 3)) > 1e-7 * jerk;
  ControllerTable best;
  for (std::size_t parts = 1; parts <= 64; parts *= 2) {
    if (parts > 1 && law.pieces() * parts + 1 > max_points) break;
    std::vector<double> times;
    std::vector<Between> between;
    for (std::size_t i = 0; i < law.pieces(); ++i)
      for (std::size_t k = 0; k < parts; ++k) {
        times.push_back(law.breaks()[i] + law.piece_duration(i) * static_cast<double>(k) / static_cast<double>(parts));
        const bool rough = !septic || (k + 1 == parts && jumps[i + 1]) || law.piece(i).degree() <= 5;
        between.push_back(rough ? Between::quintic : Between::septic);
      }
    times.push_back(law.duration());
    between.push_back(between.back());
    best = table_at(law, cycle, times, between, own_ends);
    if (best.error[0] <= 1e-6 * stroke && best.error[3] <= 0.01 * jerk) break;
  }
  return best;
}

}  // namespace bahnwerk::cam
