#include "sim/bridge/plugin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim/base/error.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string library(const std::string& name) {
  return DODGESIM_BINARY_DIR "/tests/plugins/lib" + name + ".so";
}

std::unique_ptr<dodge::Pilot> pilot_of(const std::string& file, const std::string& parameters) {
  return make_pilot(read_plugin(file), dodge::Config(), parameters);
}

TEST(Plugin, MakesAPilot) {
  const auto pilot = pilot_of(library("obedient"), "");
  const dodge::VelocityCommand command = pilot->update(7);
  EXPECT_EQ(command.t_us, 7);
  EXPECT_EQ(command.v_W.y(), 2);
  EXPECT_TRUE(command.evading);
}

TEST(Plugin, MakesAPilotForEachFlight) {
  const auto first = pilot_of(library("obedient"), ""), second = pilot_of(library("obedient"), "");
  EXPECT_NE(first.get(), second.get());
}

TEST(Plugin, IsHandedTheConfigurationAndItsParameters) {
  dodge::Config config;
  config.position.depth = "stereo";  // without cameras, which the pilot itself refuses
  EXPECT_THROW(make_pilot(read_plugin(library("obedient")), config, "dodger"),
               std::invalid_argument);
  EXPECT_THAT([] { pilot_of(library("obedient"), "refuse"); },
              ThrowsMessage<std::invalid_argument>("I take no such parameters."));
}

TEST(Plugin, WithoutAPilotIsRefused) {
  EXPECT_THAT([] { pilot_of(library("obedient"), "nothing"); },
              ThrowsMessage<SimulationError>(HasSubstr("libobedient.so made no pilot")));
  EXPECT_THAT([] { pilot_of(library("without_a_pilot"), ""); },
              ThrowsMessage<SimulationError>(HasSubstr("has no dodge_plugin_interface()")));
}

TEST(Plugin, OfOtherHeadersIsRefused) {
  EXPECT_THAT([] { pilot_of(library("of_other_headers"), ""); },
              ThrowsMessage<SimulationError>(HasSubstr("compile it anew")));
}

TEST(Plugin, ThatIsNoLibraryOrMissingIsRefused) {
  const testing::TemporaryDirectory directory;
  const std::string file = (directory / "text.so").string();
  std::ofstream(file) << "no library";
  EXPECT_THAT([&] { pilot_of(file, ""); }, ThrowsMessage<SimulationError>(AllOf(
                                               HasSubstr(file), HasSubstr("cannot be loaded"))));
  EXPECT_THAT([&] { read_plugin(file + ".missing"); },
              ThrowsMessage<IoError>(AllOf(HasSubstr(file), HasSubstr("No such file"))));
  EXPECT_THAT([&] { read_plugin(directory / ""); },
              ThrowsMessage<IoError>(HasSubstr("could not be read")));
}

TEST(Plugin, ThatHasChangedIsRefused) {
  const testing::TemporaryDirectory directory;
  const fs::path file = directory / "mine.so";
  fs::copy_file(library("obedient"), file);
  std::ofstream(file, std::ios::app) << "unlike any that has been loaded";
  const Plugin before = read_plugin(file.string());
  EXPECT_EQ(read_plugin(file.string()).digest, before.digest);
  std::ofstream(file, std::ios::app) << "x";
  EXPECT_NE(read_plugin(file.string()).digest, before.digest);
  EXPECT_THAT([&] { make_pilot(before, dodge::Config(), ""); },
              ThrowsMessage<SimulationError>(HasSubstr("has changed")));
}

}  // namespace
}  // namespace dodgesim
