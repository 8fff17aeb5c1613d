// Tests with model files of their own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/models.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {

// A copy of the models in which a test may put files of its own.
class OwnModels : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = testing::copy_models(own_.path());
    spec_ = test_spec({{"own", 0.2}});
    spec_.models_dir = directory_.string();
  }
  void write_object(const std::string& text) {
    std::ofstream(directory_ / "objects" / "own.xml") << text;
  }

  static std::string object(const std::string& geom, const std::string& more = "") {
    return "<mujoco><custom><numeric name='reference_size_m' data='0.1'/>"
           "<numeric name='mass_exponent' data='3'/><numeric name='drag_coefficient' data='1'/>"
           "<numeric name='frontal_area_m2' data='0.01'/></custom>" +
           more +
           "<worldbody><body name='body'><freejoint/>"
           "<inertial pos='0 0 0' mass='1' diaginertia='1e-3 1e-3 1e-3'/>" +
           geom + "</body></worldbody></mujoco>";
  }

  // What is said of an object in whose text `to` stands in place of `from`.
  std::string changed_message(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    write_object(text);
    return world_message();
  }

  std::string world_message() const {
    return testing::complaint<ScenarioError>([&] { World world(spec_); });
  }

  testing::TemporaryDirectory own_;
  std::filesystem::path directory_;
  WorldSpec spec_;
};

}  // namespace dodgesim
