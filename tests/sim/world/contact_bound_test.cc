#include "sim/world/contact_bound.h"

#include <gtest/gtest.h>

#include "sim/base/random.h"
#include "sim/world/world.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

class ContactBoundTest : public ::testing::TestWithParam<const char*> {
 protected:
  ContactBoundTest() {
    WorldSpec spec = test_spec({{"ball", 0.3}, {"box", 0.2}});
    spec.room = GetParam();
    model_ = compose_model(spec);
    data_.reset(mj_makeData(model_.get()));
    for (const char* name : {"vehicle", "object0/body", "object1/body"}) {
      bodies_.push_back(mj_name2id(model_.get(), mjOBJ_BODY, name));
      EXPECT_GT(bodies_.back(), 0) << name;
    }
  }
  mjtNum* pose(int i) { return data_->qpos + 7 * i; }
  void place(int i, const Eigen::Vector3d& p_W) { Eigen::Map<Eigen::Vector3d>(pose(i)) = p_W; }
  void turn(int i, RandomStream& random) {
    Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
    Eigen::Map<Eigen::Vector4d>(pose(i) + 3) = q.normalized();
  }
  int contacts() {
    mj_fwdPosition(model_.get(), data_.get());
    return data_->ncon;
  }

  MjModelPtr model_;
  MjDataPtr data_;
  std::vector<int> bodies_;
  std::vector<bool> all_ = {true, true, true};
};

TEST_P(ContactBoundTest, IsNeverWrongAndSeldomTooCareful) {
  RandomStream random(1, 0, "places");
  ContactBound bound(*model_, bodies_);
  int apart = 0, free = 0, touching = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    for (int i = 0; i < 3; ++i) {
      place(i, {random.uniform(-6, 6), random.uniform(-4, 4), random.uniform(0, 5)});
      turn(i, random);
    }
    // Again and again near places where it has been asked before.
    for (int step = 0; step < 3; ++step) {
      for (int i = 0; i < 3; ++i) pose(i)[step] += random.uniform(-0.2, 0.2);
      const bool told = bound.apart(*model_, data_->qpos, all_);
      const bool touch = contacts() > 0;
      ASSERT_FALSE(told && touch) << trial;
      apart += told ? 1 : 0;
      free += touch ? 0 : 1;
      touching += touch ? 1 : 0;
    }
  }
  EXPECT_GT(touching, 500);
  EXPECT_GT(apart, free / 2);
}

TEST_P(ContactBoundTest, WhatIsNotInFlightDoesNotCount) {
  ContactBound bound(*model_, bodies_);
  place(0, {0, 0, 2});
  place(1, {0.1, 0, 2});
  place(2, {0, 0, -9});
  EXPECT_FALSE(bound.apart(*model_, data_->qpos, {true, true, false}));
  EXPECT_FALSE(bound.apart(*model_, data_->qpos, {true, false, true}));
  EXPECT_TRUE(bound.apart(*model_, data_->qpos, {true, false, false}));
}

TEST_P(ContactBoundTest, ClaimsNothingOfModelsWithPairsOfTheirOwn) {
  model_->npair = 1;
  ContactBound bound(*model_, bodies_);
  place(0, {0, 0, 2});
  EXPECT_FALSE(bound.apart(*model_, data_->qpos, {true, false, false}));
  model_->npair = 0;
}

INSTANTIATE_TEST_SUITE_P(Rooms, ContactBoundTest, ::testing::Values("room", "field"));

}  // namespace
}  // namespace dodgesim
