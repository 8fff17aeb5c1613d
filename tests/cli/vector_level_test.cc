// The program gives the same bytes with whatever vectors it is told to use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "sim/base/vector_level.h"
#include "tests/cli/command_test.h"
#include "tests/cli/emulate_command.h"

namespace {

using dodgesim::testing::contents;
using ::testing::HasSubstr;

// Of the environment of the programs that are started meanwhile.
class Vectors {
 public:
  explicit Vectors(const std::string& name) { ::setenv("DODGESIM_VECTORS", name.c_str(), 1); }
  ~Vectors() { ::unsetenv("DODGESIM_VECTORS"); }
  Vectors(const Vectors&) = delete;
  Vectors& operator=(const Vectors&) = delete;
};

std::vector<std::string> narrower_vectors() {
  std::vector<std::string> names = {"portable", "avx2"};
  names.resize(static_cast<std::size_t>(dodgesim::widest_vector_level()));
  return names;
}

class VectorLevelEmulate : public dodgesim::testing::EmulateCommandTest {};

TEST_F(VectorLevelEmulate, MakesTheSameEvents) {
  for (const std::string camera : {"ideal", "sees1", "noisy", "low_light"}) {
    const auto events = [&] {
      EXPECT_EQ(emulate("--camera " + camera + " --out " + out_).exit_code, 0);
      return contents(out_);
    };
    const std::string widest = events();
    EXPECT_GT(widest.size(), 10000u);
    for (const std::string& name : narrower_vectors()) {
      const Vectors vectors(name);
      EXPECT_EQ(events(), widest) << camera << " " << name;
    }
  }
}

TEST_F(VectorLevelEmulate, IsOneThatTheProcessorHas) {
  const Vectors vectors("mmx");
  const auto outcome = ideal();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output,
              HasSubstr("DODGESIM_VECTORS is mmx, but must be one of those that this processor "
                        "has: portable"));
}

class VectorLevelRun : public dodgesim::testing::CommandTest {};

// A ball in front of a room, of which the events' hash is in throws.csv.
TEST_F(VectorLevelRun, FliesTheSameThrow) {
  write("s.yaml",
        "seed: 5\nfly_oracle: false\nroom: room\nmission: {start_m: [-2, 0, 2]}\n"
        "throw: {size_m: 0.2, distance_m: 2, speed_mps: 6, launch_s: 0.1}\nafter_s: 0.1\n"
        "sensors: {camera: {width: 160, height: 120}}\n");
  const auto fly = [this](const std::string& out) {
    const auto outcome =
        dodgesim::testing::dodgesim("run " + path("s.yaml") + " --throws 1 --out " + path(out));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  };
  fly("widest");
  for (const std::string& name : narrower_vectors()) {
    const Vectors vectors(name);
    fly(name);
    expect_same(name, "widest");
  }
}

}  // namespace
