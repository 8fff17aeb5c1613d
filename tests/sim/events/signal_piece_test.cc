#include "sim/events/signal_piece.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/random.h"

namespace dodgesim {
namespace {

// The definition, without pieces.
double curve(double s0, double rise, double p, double decay, double t_us) {
  return s0 + rise * t_us - p * (1 - std::exp(-decay * t_us));
}

TEST(SignalPieces, FollowTheCurveCutItWhereItTurnsAndAreMonotone) {
  RandomStream random(1, 0, "pieces");
  int turned = 0;
  for (int n = 0; n < 2000; ++n) {
    const double t0_us = random.uniform(0, 1e6), dt_us = std::exp(random.uniform(0, 11));
    const double decay = std::exp(random.uniform(-14, -4)), rise = random.uniform(-1, 1) / dt_us;
    const double s0 = random.uniform(-1, 1), p = random.uniform(-1, 1);
    const double s1 = curve(s0, rise, p, decay, dt_us);
    const SignalPieces pieces = pieces_of(t0_us, t0_us + dt_us, s0, s1, rise, decay);
    turned += pieces.size == 2 ? 1 : 0;
    EXPECT_EQ(pieces.begin()->t0_us, t0_us);
    EXPECT_EQ((pieces.end() - 1)->t1_us, t0_us + dt_us);
    EXPECT_EQ((pieces.end() - 1)->s1, s1);
    for (const SignalPiece& piece : pieces) {
      double before = piece.s0;
      for (int k = 1; k <= 20; ++k) {
        const double t_us = piece.t0_us + (piece.t1_us - piece.t0_us) * k / 20;
        EXPECT_NEAR(piece.at(t_us), curve(s0, rise, p, decay, t_us - t0_us), 1e-7);
        EXPECT_GE((piece.at(t_us) - before) * (piece.s1 - piece.s0), -1e-9);
        before = piece.at(t_us);
      }
    }
  }
  EXPECT_GT(turned, 100);
  EXPECT_LT(turned, 1900);
}

TEST(SignalPieces, SayWhenALevelIsCrossed) {
  RandomStream random(2, 0, "pieces");
  for (int n = 0; n < 2000; ++n) {
    const double dt_us = std::exp(random.uniform(0, 11));
    const double decay = n % 3 == 0 ? 0 : std::exp(random.uniform(-14, -4));
    const SignalPieces pieces =
        pieces_of(5, 5 + dt_us, random.uniform(-1, 1), random.uniform(-1, 1),
                  random.uniform(-1, 1) / dt_us, decay);
    for (const SignalPiece& piece : pieces) {
      const double t_us = random.uniform(piece.t0_us, piece.t1_us);
      const double found_us = piece.time_of(piece.at(t_us));
      // Where the signal hardly changes, any instant of its value will do.
      EXPECT_TRUE(std::abs(found_us - t_us) < 0.02 ||
                  std::abs(piece.at(found_us) - piece.at(t_us)) < 1e-9)
          << found_us << " " << t_us << " " << decay;
    }
  }
}

TEST(SignalPieces, OfAStraightSignalAreOneLine) {
  const SignalPieces pieces = pieces_of(10, 20, 1, 3, 0.7, 0);
  ASSERT_EQ(pieces.size, 1u);
  EXPECT_DOUBLE_EQ(pieces.begin()->at(15), 2);
  EXPECT_DOUBLE_EQ(pieces.begin()->time_of(2.5), 17.5);
}

}  // namespace
}  // namespace dodgesim
