#include "core/cam/optimal/program/vibration.hpp"

#include <algorithm>
#include <cmath>

#include "core/cam/optimal/task/extrema.hpp"

namespace bahnwerk::cam {
namespace {

struct GaussRule {
  std::array<double, 12> node, weight;  // nodes and weights on [0, 1]
};

/// Newton's iteration for the roots of the Legendre polynomial.
GaussRule gauss_rule() {
  GaussRule rule{};
  constexpr int n = 12;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(3.14159265358979323846 * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p, p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule.node[static_cast<std::size_t>(i)] = (1 + x) / 2;
    rule.weight[static_cast<std::size_t>(i)] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace

std::array<VibrationRow, 2> vibration_rows(const LawTask& task, const LawBasis& basis,
                                           const std::vector<double>& breaks, const LawTask::Vibration& vibration) {
  static const GaussRule rule = gauss_rule();
  const std::size_t sections = task.sections();
  std::vector<double> real(basis.size()), imaginary(basis.size()), weights;
  const std::size_t steps = (vibration.to + (vibration.to > vibration.from ? 0 : task.points())) - vibration.from;
  double whole = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t section = (vibration.from + k) % sections;
    whole += breaks[section + 1] - breaks[section];
  }
  std::array<VibrationRow, 2> rows;
  const auto parts_of = [&](double piece_length) {
    return static_cast<std::size_t>(
        std::ceil(std::max(1.0, std::hypot(vibration.decay, vibration.frequency) * piece_length)));
  };
  double t = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t section = (vibration.from + k) % sections;
    const SectionBasis& own = basis.section(section);
    const double length = breaks[section + 1] - breaks[section];
    weights.resize(own.size());
    if (task.is_given(section)) {
      const GivenSection& given = task.given[section]->law;
      for (std::size_t piece = 0; piece < given.bernstein.size(); ++piece) {
        const double begin = length * given.breaks[piece], duration = length * given.breaks[piece + 1] - begin;
        std::vector<double> a = given.bernstein[piece];
        differentiate_bernstein(a);
        differentiate_bernstein(a);
        const std::size_t parts = parts_of(duration);
        for (std::size_t part = 0; part < parts; ++part)
          for (std::size_t q = 0; q < rule.node.size(); ++q) {
            const double v = (static_cast<double>(part) + rule.node[q]) / static_cast<double>(parts);
            const double at = t + begin + v * duration;
            const double value = rule.weight[q] / static_cast<double>(parts) * evaluate_bernstein(a, v) / duration *
                                 std::exp(vibration.decay * (at - whole));
            rows[0].given += value * std::cos(vibration.frequency * at);
            rows[1].given += value * std::sin(vibration.frequency * at);
          }
      }
      t += length;
      continue;
    }
    for (std::size_t piece = 0; piece < own.pieces(); ++piece) {
      const double piece_length = length * own.length(piece);
      const std::size_t parts = parts_of(piece_length);
      for (std::size_t part = 0; part < parts; ++part)
        for (std::size_t q = 0; q < rule.node.size(); ++q) {
          const double v = (static_cast<double>(part) + rule.node[q]) / static_cast<double>(parts);
          const double at = t + length * own.begin(piece) + v * piece_length;
          const double factor = rule.weight[q] * piece_length / static_cast<double>(parts) / (length * length) *
                                std::exp(vibration.decay * (at - whole));
          own.weights(piece, v, 2, weights.data());
          const double c = factor * std::cos(vibration.frequency * at), s = factor * std::sin(vibration.frequency * at);
          for (std::size_t i = 0; i < own.size(); ++i) {
            const double weight = weights[i] * coefficient_of_variable(length, i);
            real[basis.first(section) + i] += c * weight;
            imaginary[basis.first(section) + i] += s * weight;
          }
        }
    }
    t += length;
  }
  for (std::size_t i = 0; i < real.size(); ++i)
    if (real[i] != 0 || imaginary[i] != 0) {
      rows[0].terms.emplace_back(i, real[i]);
      rows[1].terms.emplace_back(i, imaginary[i]);
    }
  return rows;
}

}  // namespace bahnwerk::cam
