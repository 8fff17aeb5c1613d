#include "sim/base/mujoco.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"

namespace dodgesim {
namespace {

constexpr const char* kBall =
    "<mujoco><option timestep='0.001'/><worldbody><body><freejoint/>"
    "<geom size='0.1'/></body></worldbody></mujoco>";

TEST(CompileModel, CompilesMjcfText) {
  const MjModelPtr model = compile_model(kBall, ".", "ball");
  EXPECT_EQ(model->nq, 7);
}

TEST(CompileModel, NamesTheModelAndTheReasonWhenItDoesNotCompile) {
  try {
    compile_model("<mujoco><worldbody><geom type='cube'/></worldbody></mujoco>", ".", "my model");
    FAIL() << "no exception";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("my model"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("cube"), std::string::npos) << error.what();
  }
}

TEST(CheckWarnings, AcceptsAStepThatWentWell) {
  const MjModelPtr model = compile_model(kBall, ".", "ball");
  const MjDataPtr data(mj_makeData(model.get()));
  mj_step(model.get(), data.get());
  EXPECT_NO_THROW(check_warnings(*data));
}

TEST(CheckWarnings, RefusesWhatMuJoCoOnlyWarnsOf) {
  const MjModelPtr model = compile_model(kBall, ".", "ball");
  for (const mjtWarning kind : {mjWARN_INERTIA, mjWARN_CONTACTFULL, mjWARN_CNSTRFULL}) {
    const MjDataPtr data(mj_makeData(model.get()));
    mj_warning(data.get(), kind, 1);
    EXPECT_THROW(check_warnings(*data), SimulationError) << kind;
  }
}

TEST(MujocoHandlers, TurnMuJoCoErrorsIntoExceptions) {
  compile_model(kBall, ".", "ball");
  EXPECT_THROW(mju_error("on purpose"), SimulationError);
  EXPECT_THROW(mju_error("Could not allocate mjData buffer"), MemoryError);
}

}  // namespace
}  // namespace dodgesim
