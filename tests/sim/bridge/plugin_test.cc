#include "sim/bridge/plugin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <langinfo.h>
#include <locale.h>

#include <cfenv>
#include <filesystem>
#include <fstream>
#include <utility>

#include "dodge/dodger.h"
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
  return make_plugin_pilot(read_plugin(file), dodge::Config(), parameters);
}

std::unique_ptr<dodge::Pilot> told_to(const std::string& parameters) {
  return pilot_of(library("obedient"), parameters);
}

TEST(Plugin, MakesAPilot) {
  const auto pilot = told_to("");
  const dodge::VelocityCommand command = pilot->update(7);
  EXPECT_EQ(command.t_us, 7);
  EXPECT_EQ(command.v_W.y(), 2);
  EXPECT_TRUE(command.evading);
}

TEST(Plugin, DoesNotChangeHowTheSimulatorRounds) {
  for (const char* order : {"round up", "round up at once"}) {
    const auto pilot = told_to(order);
    pilot->update(0);
    EXPECT_EQ(std::fegetround(), FE_TONEAREST) << order;
    std::fesetround(FE_TONEAREST);
  }
}

TEST(Plugin, DoesNotChangeHowTheSimulatorWritesNumbers) {
  told_to("");
  ASSERT_NE(::uselocale(nullptr), LC_GLOBAL_LOCALE) << "which setlocale() changes";
  EXPECT_STREQ(::nl_langinfo_l(RADIXCHAR, ::uselocale(nullptr)), ".");
}

TEST(Plugin, MakesAPilotForEachFlight) {
  const auto first = told_to(""), second = told_to("");
  EXPECT_NE(first.get(), second.get());
}

TEST(Plugin, IsHandedTheConfigurationAndItsParameters) {
  EXPECT_THAT([] { told_to("refuse"); },
              ThrowsMessage<SimulationError>(
                  AllOf(HasSubstr("libobedient.so makes no pilot: I take no such parameters."))));
  // Stereo without cameras, which the paper's pilot itself refuses.
  EXPECT_THAT([] { told_to("be the dodger"); },
              ThrowsMessage<SimulationError>(HasSubstr("2 camera(s)")));
}

// Whose private parts may be others than the simulator's.
TEST(Plugin, IsNoDodgerOfTheSimulators) {
  dodge::Config config;
  config.position.depth = "mono";
  config.cameras.resize(1);
  config.cameras[0].fx = config.cameras[0].fy = 190;
  config.cameras[0].width = 320;
  config.cameras[0].height = 240;
  const auto pilot = make_plugin_pilot(read_plugin(library("obedient")), config, "be the dodger");
  EXPECT_EQ(dynamic_cast<dodge::Dodger*>(pilot.get()), nullptr);
}

TEST(Plugin, WithoutAPilotIsRefused) {
  EXPECT_THAT([] { told_to("make nothing"); },
              ThrowsMessage<SimulationError>(HasSubstr("libobedient.so makes no pilot.")));
  EXPECT_THAT([] { told_to("refuse with a number"); },
              ThrowsMessage<SimulationError>(HasSubstr("what is no std::exception")));
  EXPECT_THAT([] { pilot_of(library("without_a_pilot"), ""); },
              ThrowsMessage<SimulationError>(HasSubstr("has no dodge_plugin_interface()")));
}

TEST(Plugin, OfOtherHeadersIsRefused) {
  EXPECT_THAT([] { pilot_of(library("of_other_headers"), ""); },
              ThrowsMessage<SimulationError>(HasSubstr("compile it anew")));
}

TEST(Plugin, OfHeadersAloneHasTheCameraModel) {
  dodge::Config config;
  config.cameras.resize(1);
  const Plugin plugin = read_plugin(library("of_headers_alone"));
  EXPECT_THAT([&] { make_plugin_pilot(plugin, config, ""); },
              ThrowsMessage<SimulationError>(HasSubstr("I see 76800 pixels, one of them at 3.0")));
}

TEST(Plugin, ThatLacksAPartIsToldWhatToLink) {
  EXPECT_THAT([] { pilot_of(library("with_a_missing_part"), ""); },
              ThrowsMessage<SimulationError>(
                  AllOf(HasSubstr("made_elsewhere"), HasSubstr("link the library that has it"))));
}

TEST(Plugin, ThatIsNoLibraryOrMissingIsRefused) {
  const testing::TemporaryDirectory directory;
  const std::string file = (directory / "text.so").string();
  for (const std::string content : {"no library", ""}) {
    std::ofstream(file) << content;
    EXPECT_THAT([&] { pilot_of(file, ""); },
                ThrowsMessage<SimulationError>(HasSubstr(file + " cannot be loaded: file too")));
  }
  EXPECT_THAT([&] { read_plugin(file + ".missing"); },
              ThrowsMessage<IoError>(AllOf(HasSubstr(file), HasSubstr("is missing"))));
  for (const std::string& no_file : {directory.path().string(), std::string("/dev/zero")}) {
    EXPECT_THAT([&] { read_plugin(no_file); },
                ThrowsMessage<IoError>(HasSubstr("is not a regular file")));
  }
}

TEST(Plugin, StaysWhatItWasWhenItWasRead) {
  const testing::TemporaryDirectory directory;
  const fs::path file = directory / "mine.so";
  fs::copy_file(library("obedient"), file);
  std::ofstream(file, std::ios::app) << "unlike any that has been loaded";
  const Plugin before = read_plugin(file.string());
  EXPECT_EQ(read_plugin(file.string()).digest, before.digest);
  std::ofstream(file, std::ios::app) << "x";
  EXPECT_NE(read_plugin(file.string()).digest, before.digest);
  std::ofstream{file} << "no library any more";
  EXPECT_EQ(make_plugin_pilot(before, dodge::Config(), "")->update(7).t_us, 7);
}

TEST(GuardedPilot, WhatItThrowsIsOneSentence) {
  const auto pilot = told_to("throw");
  EXPECT_THAT([&] { pilot->update(0); },
              ThrowsMessage<SimulationError>("The pilot failed: I have lost my way, and my map."));
  EXPECT_THAT([&] { told_to("throw Latin 1")->update(0); },
              ThrowsMessage<SimulationError>("The pilot failed: Verst\xef\xbf\xbdrker aus."));
  EXPECT_THAT([&] { told_to("throw a number")->update(0); },
              ThrowsMessage<SimulationError>("The pilot threw what is no std::exception."));
}

TEST(GuardedPilot, CommandsOnlyWhatCanBe) {
  EXPECT_THAT([&] { told_to("command nothing")->update(310000); },
              ThrowsMessage<SimulationError>(
                  "The pilot commanded a velocity that is no number at 0.31 s."));
  EXPECT_THAT([&] { told_to("race")->update(0); },
              ThrowsMessage<SimulationError>(HasSubstr("beyond a million m/s")));
  EXPECT_THAT([&] { told_to("foresee")->update(0); },
              ThrowsMessage<SimulationError>(HasSubstr("a time stamp in the future")));
}

TEST(GuardedPilot, DetectsOnlyWhatCanBe) {
  EXPECT_EQ(told_to("detect all right")->update(310000).t_us, 310000);
  const std::pair<const char*, const char*> faults[] = {
      {"nowhere", "detected something that is nowhere"},
      {"tomorrow", "gave a detection a time stamp in the future"},
      {"long ago", "gave a detection no instant, or one before the flight"},
      {"without a stamp", "gave a detection no instant, or one before the flight"},
      {"of the past", "gave a detection an instant more than a second ago"},
      {"less than nothing", "gave a detection a size_m that is not between 0 and a million m"},
      {"at no depth", "gave a detection a depth_m that is no number"},
      {"without certainty", "gave a detection a depth_sigma_m that is not between 0"}};
  for (const auto& [fault, complaint] : faults) {
    const auto pilot = told_to(std::string("detect ") + fault);
    EXPECT_THAT(
        [&] { pilot->update(1310000); },
        ThrowsMessage<SimulationError>(AllOf(HasSubstr(complaint), HasSubstr("at 1.31 s."))));
  }
}

// Unlike other failures, it may be the machine's.
TEST(GuardedPilot, WhoseMemoryIsShortIsNamed) {
  EXPECT_THAT([] { told_to("take all memory")->update(0); },
              ThrowsMessage<MemoryError>(HasSubstr("The pilot threw std::bad_alloc, as when ")));
  EXPECT_THAT([] { told_to("take all memory at once"); },
              ThrowsMessage<MemoryError>(
                  HasSubstr("libobedient.so makes no pilot: it threw std::bad_alloc, as when ")));
}

}  // namespace
}  // namespace dodgesim
