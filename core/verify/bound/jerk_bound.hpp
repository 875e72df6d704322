#pragma once
/// How long a section takes at least when jerk is limited: by duality, from the nodes of the bound without jerk.
///
/// Let b = v², c = 1/v, a_k = q″_k b + q′_k b′/2 the acceleration of axis k, so that time is ∫ c ds and |a_k′| ≤ J_k c.
/// Take any λ_k(s) that is continuously differentiable and any continuous μ_k(s). With η_k = μ_k − λ_k′,
///   w = 1 − Σ J_k |λ_k| ≥ 0   and   G = ½ Σ (η_k q″_k − η_k′ q′_k),
/// integrating λ_k a_k′ by parts twice gives, for every motion within the limits,
///   ∫ c ds ≥ ∫ (w c + G b) ds − Σ_k [ A_k ∫ |μ_k| ds + Σ_joints (|λ_k| |Δa_k| + ½ |η_k Δq′_k| b) ],
/// since acceleration and b vanish at rests; at a free end λ, λ′ and μ have to vanish instead. Because c = b^(−1/2) and
/// b ≤ cap (what the bound without jerk leaves), w c + G b is no less than
///   f(w, G) = min over 0 < b ≤ cap of w b^(−1/2) + G b:   3/2 w^(2/3) (2G)^(1/3), or w cap^(−1/2) + G cap.
/// So every choice of multipliers yields a lower bound; those of the convex problem in core/motion/relaxation come
/// close to the best. That solver is a source of numbers only: nothing it does can make the bound wrong.
///
/// What is enclosed. f is concave and grows in w and in G. Over a piece both have known means (∫ G ds follows from q
/// and q′ at its ends, w is no less than a quadratic) and known ranges (|G′| ≤ ½ Σ |η_k| |q‴_k|, for η_k is linear),
/// and the mean of a concave function is no less than the least mean over the corners of these ranges. Rounding is
/// covered by margins from the sizes of what is added up, as in lower_bound.hpp.
///
/// At a joint an axis may step by |Δa_k| ≤ min(J_k · cycle time, |Δq″_k| b + |Δq′_k| |v̇|): what the verifier allows,
/// for the acceleration along the path is continuous.
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/relaxation/relaxation.hpp"
#include "core/motion/relaxation/splines.hpp"
#include "core/verify/bound/bound_grid.hpp"

namespace bahnwerk::verify {

/// N axes as the BoundGrid has them.
template <int N>
class JerkBound {
 public:
  using Row = std::array<double, N>;
  JerkBound(const BoundGrid<N>& grid, const Machine& machine, ProgressScope& pulse);

  /// Whether any axis limits jerk at all.
  bool limited() const { return limited_; }
  /// Of the section whose grid is at hand, s. `b`: the largest v² that a motion may have at each of its nodes; `time`:
  /// what the section takes without limits of jerk, about. 0 where jerk cannot show.
  /// O(nodes): 2 to 5 µs per cell of two axes, in windows of 16,000 cells.
  double duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last);
  /// Of all relaxations so far.
  std::size_t cells() const { return cells_; }

 private:
  using Node = BoundNode<N>;
  using Cell = BoundCell<N>;
  /// A part of a cell of the grid: what the dual function is evaluated on.
  struct Piece {
    Row way{}, begin{}, end{};  ///< q at the end − at the begin, q′ at both ends
    Row bend{};                 ///< largest |q″_k| at its ends
    double swing = 0;           ///< by how much q″ b may change along it, over the axis' acceleration
    Row third{};                ///< bounds of |q‴_k|, 1/mm²
    double length = 0;
    double finest = 0;     ///< mm, longest cell here
    double cap = 0;        ///< largest b anywhere in it
    double time = 0;       ///< about, s
    double rounding = 0;   ///< of the length, relative
    bool joint = false;    ///< what follows stands before its begin
    Row step{}, kink{};    ///< |Δa_k| at most, and Δq′_k
    double along = 0;      ///< largest |v̇| in it
    double joint_cap = 0;  ///< of b at the joint
  };
  struct Sums {
    double now = 0, lost = 0;
    void add(double x);
  };

  void lay(const std::vector<double>& b, bool rest_first, bool rest_last);
  void grade(const std::vector<double>& b, bool rest_first, bool rest_last);
  double finest_at(std::size_t node, const std::vector<double>& b) const;
  void divide(std::size_t cell, const std::vector<double>& b);
  void append(const Node& a, const Node& b, double cap, double finest);
  double cap(std::size_t cell, const Node& a, const Node& b, const std::vector<double>& at_nodes, double part0,
             double part1) const;
  void join(const Node& a, const Node& b, double cap);
  /// Pieces of one window, which become cells of the relaxation; returns one past its last.
  std::size_t pose(std::size_t first, bool rest_first, bool rest_last, bool& ends_at_rest);
  double evaluate(std::size_t first, std::size_t last, const RelaxationMultipliers<N>& multipliers) const;

  const BoundGrid<N>& grid_;
  ProgressScope& pulse_;
  Row acceleration_{}, jerk_{};
  double cycle_time_;
  bool limited_ = false;
  std::size_t cells_ = 0;
  double ramp_ = std::numeric_limits<double>::infinity();  ///< s, shortest time from no acceleration to the limit
  double acceleration_of_ramp_ = 0;                        ///< of that axis
  double spacing_ = 0;                                     ///< s, time of a cell
  double first_piece_ = 0;                                 ///< mm, next to rest
  /// Per node of the grid: the longest piece, mm, that rests and steps of acceleration before and behind it allow here.
  std::vector<double> before_, behind_;
  std::vector<Piece> pieces_;
  std::vector<std::size_t> cell_of_;  ///< per piece of the window
  Piece joint_;                       ///< of the piece to come
  RelaxationProblem<N> problem_;
  RelaxationSolver<N> solver_;
};

extern template class JerkBound<2>;
extern template class JerkBound<3>;
extern template class JerkBound<8>;

}  // namespace bahnwerk::verify
