// Motions of one axis in pieces, and sums of them.
#include "core/motion/axes/motion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace bahnwerk {
namespace {

/// x = a t²/2 with its own acceleration in every piece.
class Ramps final : public Motion {
 public:
  Ramps(std::vector<double> ends, std::vector<double> accelerations)
      : ends_(std::move(ends)), acceleration_(std::move(accelerations)) {
    double t = 0;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      start_.push_back(state_);
      const double d = ends_[i] - t, a = acceleration_[i];
      state_ = {state_.x + d * (state_.v + a * d / 2), state_.v + a * d};
      t = ends_[i];
    }
  }
  std::size_t axes() const override { return 1; }
  std::size_t pieces() const override { return ends_.size(); }
  double begin(std::size_t piece) const override { return piece == 0 ? 0 : ends_[piece - 1]; }
  double duration() const override { return ends_.back(); }
  MotionState in_piece(std::size_t piece, double t) const override {
    const double d = t - begin(piece), a = acceleration_[piece];
    MotionState s;
    s[0][0] = start_[piece].x + d * (start_[piece].v + a * d / 2);
    s[1][0] = start_[piece].v + a * d;
    s[2][0] = a;
    return s;
  }

 private:
  struct Start {
    double x = 0, v = 0;
  };
  std::vector<double> ends_, acceleration_;
  std::vector<Start> start_;
  Start state_;
};

TEST(Motion, EvaluatesTheRightLimitWhereverItComesFrom) {
  const Ramps motion({1, 2, 4}, {2, -2, 0.5});
  for (const std::size_t hint : {0u, 1u, 2u, 9u}) {
    std::size_t piece = hint;
    EXPECT_EQ(motion.evaluate(1, piece)[2][0], -2);
    EXPECT_EQ(piece, 1u);
    piece = hint;
    EXPECT_EQ(motion.evaluate(4, piece)[1][0], 1);
    EXPECT_EQ(piece, 2u);
    piece = hint;
    EXPECT_EQ(motion.evaluate(0.5, piece)[0][0], 0.25);
    EXPECT_EQ(piece, 0u);
  }
}

TEST(Motion, SumsHaveThePiecesOfBoth) {
  const auto coarse = std::make_shared<Ramps>(std::vector<double>{1, 2, 4}, std::vector<double>{2, -2, 0.5});
  const auto fine = std::make_shared<Ramps>(std::vector<double>{0.5, 2, 4}, std::vector<double>{-1, 3, 0});
  const SumOfMotions sum(coarse, fine);
  ASSERT_EQ(sum.pieces(), 4u);
  EXPECT_EQ(sum.begin(1), 0.5);
  EXPECT_EQ(sum.begin(2), 1);
  EXPECT_EQ(sum.begin(3), 2);
  for (const double t : {0.0, 0.3, 0.5, 0.99, 1.0, 1.7, 2.0, 3.1, 4.0}) {
    const MotionState a = coarse->evaluate(t), b = fine->evaluate(t), both = sum.evaluate(t);
    EXPECT_DOUBLE_EQ(both[0][0], a[0][0] + b[0][0]) << t;
    EXPECT_DOUBLE_EQ(both[1][0], a[1][0] + b[1][0]) << t;
    EXPECT_DOUBLE_EQ(both[2][0], a[2][0] + b[2][0]) << t;
  }
  EXPECT_THROW(SumOfMotions(coarse, std::make_shared<Ramps>(std::vector<double>{1.0}, std::vector<double>{1.0})),
               std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
