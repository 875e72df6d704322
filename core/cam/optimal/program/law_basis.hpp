#pragma once
/// The splines of a whole law: one basis per section, with the same degree everywhere.
#include <cstddef>
#include <deque>
#include <vector>

#include "core/cam/optimal/task/law_task.hpp"
#include "core/cam/optimal/task/section_basis.hpp"

namespace bahnwerk::cam {

/// Returns by how much rounding of published coefficients, which are positions, may move s^(order) of a piece of that
/// degree and length; in the task's units.
double published_rounding(const LawTask& task, int degree, double length, int order);

/// Returns the highest order of derivative, 3 at most, that a section has to keep: one that J counts, that it limits,
/// or in which it joins a neighbour.
int kept_order(const LawTask& task, std::size_t section);

/// Returns whether published coefficients of that degree tell each section's derivatives up to kept_order() from
/// rounding, with one piece per section: to 1e-4 of what they usually have.
bool is_expressible(const LawTask& task, std::size_t section, int degree);
bool is_expressible(const LawTask& task, int degree);

/// Returns what a program's variable is worth as coefficient k of a section of that length: (length/max(1, length))^j,
/// j the coefficient's order. In these variables derivatives have weights of the order of 1, however short the section.
double coefficient_of_variable(double length, std::size_t k);

class LawBasis {
 public:
  /// A section has `pieces` pieces, or the largest divisor of it at which published_rounding() of its kept_order() is
  /// below 1e-6 of what such a derivative has; at least 1. Lengths are those in the middle of the points' ranges.
  LawBasis(const LawTask& task, int degree, int pieces);

  /// `breaks` has the ends of the pieces of each section, from 0 to 1.
  LawBasis(int degree, const std::vector<std::vector<double>>& breaks);

  std::size_t degree() const { return degree_; }
  std::size_t pieces() const { return pieces_; }  ///< the number asked for, or the largest one of a section
  const SectionBasis& section(std::size_t s) const { return bases_[of_section_[s]]; }
  /// Returns the basis of the section seen backwards.
  const SectionBasis& mirrored(std::size_t s) const { return bases_[mirrored_[s]]; }
  std::size_t first(std::size_t s) const { return first_[s]; }  ///< number of a section's first coefficient
  std::size_t size() const { return first_.back(); }            ///< coefficients of all sections

 private:
  std::size_t find(const std::vector<double>& breaks);
  void add_section(const std::vector<double>& breaks);

  std::size_t degree_, pieces_;
  std::deque<SectionBasis> bases_;  // bases of different breaks
  std::vector<std::size_t> of_section_, mirrored_, first_{0};
};

}  // namespace bahnwerk::cam
