// dodgesim check-sensor: exit codes, lines and the report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/sim/files/temporary_directory.h"

namespace {

using dodgesim::testing::contents;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using dodgesim::testing::put;
using dodgesim::testing::TemporaryDirectory;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CheckSensorCommand, PassesAndWritesAReport) {
  const TemporaryDirectory directory;
  const auto out = directory / "not/yet/there";
  const Outcome outcome = dodgesim("check-sensor --camera ideal --out " + out.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("threshold.on.mean"));
  EXPECT_THAT(outcome.output, HasSubstr("leak_hz is 0"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("FAIL")));
  EXPECT_THAT(outcome.output, HasSubstr(out.string() + "/report.html"));
  const std::string report = contents(out / "report.html");
  EXPECT_THAT(report, HasSubstr("threshold.on.mean"));
  EXPECT_THAT(report, HasSubstr("check-sensor --camera ideal"));
}

TEST(CheckSensorCommand, SaysWhatItCannotTellOfACameraThatIsTooSlowForItsFilms) {
  const TemporaryDirectory directory;
  const std::string camera = put(directory / "camera.yaml",
                                 "preset: ideal\nphotoreceptor_hz: 0.1\n"
                                 "photoreceptor_dark_hz: 0.01\n");
  const Outcome outcome = dodgesim("check-sensor --camera " + camera);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("the bandwidth is too low for a ramp of 20 s off"));
}

TEST(CheckSensorCommand, RefusesWhatItCannotDo) {
  const TemporaryDirectory directory;
  EXPECT_EQ(dodgesim("check-sensor --camera none").exit_code, 2);
  const std::string wrong = put(directory / "camera.yaml", "contrast: 1\n");
  EXPECT_EQ(dodgesim("check-sensor --camera " + wrong).exit_code, 2);
  const Outcome both =
      dodgesim("check-sensor --sampling 1 --out " + (directory / "report").string());
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, HasSubstr("excludes"));
  const std::string file = put(directory / "file", "");
  const Outcome outcome = dodgesim("check-sensor --camera ideal --out " + file);
  EXPECT_EQ(outcome.exit_code, 4) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(file));
}

}  // namespace
