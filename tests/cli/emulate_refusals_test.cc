// What dodgesim emulate refuses: one sentence, and nothing half-written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/emulate_command.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::contents;
using dodgesim::testing::dodgesim;
using dodgesim::testing::EmulateCommandTest;
using dodgesim::testing::Film;
using dodgesim::testing::kPixels;
using dodgesim::testing::Outcome;
using dodgesim::testing::put;
using dodgesim::testing::random_film;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class EmulateRefusalsTest : public EmulateCommandTest {
 protected:
  void expect_refused(const Outcome& outcome, int exit_code, const std::string& message) const {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(message));
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    EXPECT_FALSE(fs::exists(out_));
    EXPECT_FALSE(fs::exists(out_ + ".partial"));
  }
};

TEST_F(EmulateRefusalsTest, RefusesBadCamerasWithFileLineAndKey) {
  const std::string path = (root_ / "camera.yaml").string();
  const auto refused = [&](const std::string& yaml) {
    put(path, yaml);
    const Outcome outcome = emulate("--camera " + path + " --out " + out_);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_FALSE(fs::exists(out_));
    return outcome.output;
  };
  EXPECT_EQ(refused("contrast_threshold_on: 99\n"),
            path + ":1:24: contrast_threshold_on is 99, but must be between 0.01 and 10.\n");
  EXPECT_EQ(refused("# mine\nrefractory: 5\n"),
            path + ":2:1: refractory is not a known key; did you mean refractory_us?\n");
  EXPECT_EQ(refused("mismatch_sigma: much\n"),
            path + ":1:17: mismatch_sigma is \"much\", but must be a number between 0 and 1.\n");
  EXPECT_THAT(refused("- 1\n"), StartsWith(path + ":1:1: The file must be a map of keys"));
  EXPECT_EQ(refused(""), path + ": The file is empty.\n");
  EXPECT_EQ(refused("events: {leak_hz: 1}\n"), path + ":1:1: events is not a known key.\n");
  EXPECT_EQ(
      refused("sensors: {events: {leak: 1}}\n"),
      path +
          ":1:20: sensors.events.leak is not a known key; did you mean sensors.events.leak_hz?\n");
  expect_refused(emulate("--camera sees --out " + out_), 2, "did you mean sees1?");
  expect_refused(emulate("--camera davis --out " + out_), 2,
                 "There is no event camera \"davis\"; known are sees1, ideal, noisy, low_light, "
                 "and files that end");
  expect_refused(emulate("--camera none.yaml --out " + out_), 2, "There is no such file.");
}

TEST_F(EmulateRefusalsTest, AFileThatMayNotGrowIsAnErrorOfWriting) {
  const std::string limited = "ulimit -f 1; " + std::string(DODGESIM_BINARY_DIR) + "/dodgesim " +
                              "emulate " + (root_ / "f.npy").string() + " --timestamps " +
                              (root_ / "t.npy").string() + " --camera ideal --out " + out_;
  expect_refused(dodgesim::testing::shell(limited), 4, "could not be written: File too large.");
}

TEST_F(EmulateRefusalsTest, RefusesBadVideosWithOneSentence) {
  const std::string good = contents(root_ / "f.npy");
  put(root_ / "f.npy", good.substr(0, good.size() - 1));
  expect_refused(ideal(), 2, "f.npy is truncated: ");
  put(root_ / "f.npy", good + "x");
  expect_refused(ideal(), 2, "f.npy holds 1 byte too many: ");
  Film film = film_;
  film.times.back() = film.times.front();
  write(film);
  expect_refused(ideal(), 2, "t.npy does not increase: ");
  film = film_;
  film.times.pop_back();
  write(film);
  expect_refused(ideal(), 2, "t.npy has the shape (99,), but ");
  film = film_;
  film.luminance[57 * kPixels] = -1;  // when many events have been written
  write(film);
  expect_refused(ideal(), 2, " in frame 57, row 0, column 0, but luminance must be finite");
  film = random_film(1, 0);
  write(film);
  expect_refused(ideal(), 2, "events need at least two frames");
}

TEST_F(EmulateRefusalsTest, RefusesWhatHdf5CannotHold) {
  Film film = random_film(6, 0);
  for (std::size_t n = 0; n < 6; ++n) {
    film.times[n] = static_cast<std::int64_t>(n) * 1000000000;  // 83 minutes in all
  }
  write(film);
  out_ = (root_ / "events.h5").string();
  expect_refused(ideal(), 2, "cannot hold the recording of 5000000000 us");
  out_ = (root_ / "events.npy").string();
  EXPECT_EQ(ideal().exit_code, 0);
}

TEST_F(EmulateRefusalsTest, RefusesCausesInAFileThatHasNoPlaceForThem) {
  out_ = (root_ / "events.raw").string();
  expect_refused(emulate("--camera ideal --causes --out " + out_), 2,
                 "events.raw has no place for them; .h5, .npy and .txt have.");
  EXPECT_EQ(ideal().exit_code, 0);
}

TEST_F(EmulateRefusalsTest, ReportsFilesThatCannotBeReadOrWrittenWithExitCode4) {
  const std::string full = out_ + ".partial";
  fs::create_symlink("/dev/full", full);
  expect_refused(ideal(), 4, "events.txt could not be written: No space left on device.");
  out_ = (root_ / "no/such/events.h5").string();
  expect_refused(ideal(), 4, "events.h5 could not be created: No such file or directory.");
  fs::remove(root_ / "f.npy");
  expect_refused(ideal(), 4, "f.npy could not be opened: No such file or directory.");
}

TEST_F(EmulateRefusalsTest, DoesNotOverwriteItsInput) {
  const std::string before = contents(root_ / "t.npy");
  // The second name is taken while the file is being written.
  for (const char* times : {"t.npy", "events.npy.partial"}) {
    const std::string input = put(root_ / times, before);
    const std::string out = (root_ / (times == std::string("t.npy") ? times : "events.npy"));
    const Outcome outcome = dodgesim("emulate " + (root_ / "f.npy").string() + " --timestamps " +
                                     input + " --camera ideal --out " + out);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr("would overwrite the input"));
    EXPECT_EQ(contents(input), before);
  }
}

}  // namespace
