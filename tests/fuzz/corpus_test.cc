// The bytes that fuzzing has found, through the targets that it ran, in any build.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "sim/campaign/journal.h"
#include "sim/campaign/wire.h"
#include "tests/fuzz/targets.h"

namespace dodgesim::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Corpus : public testing::TestWithParam<Target> {};
INSTANTIATE_TEST_SUITE_P(Readers, Corpus, testing::ValuesIn(kTargets),
                         [](const auto& info) { return info.param.name; });

TEST_P(Corpus, BreaksNoPromise) {
  const fs::path folder = fs::path(DODGESIM_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  int accepted = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    accepted += GetParam().run(contents(entry.path())) ? 1 : 0;
  }
  // Else nothing behind the first check would be tested. Formats of our own change with versions.
  const std::string name = GetParam().name;
  EXPECT_TRUE(accepted > 0 || name == "journal" || name == "result");
}

// Every input cut off and with a byte turned over, at a few places: what fuzzing begins with.
TEST_P(Corpus, BreaksNoPromiseWhenDamaged) {
  const fs::path folder = fs::path(DODGESIM_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::vector<std::uint8_t> whole = contents(entry.path());
    const std::size_t step = whole.size() / 16 + 1;
    for (std::size_t at = 0; at < whole.size(); at += step) {
      GetParam().run({whole.data(), at});
      std::vector<std::uint8_t> turned = whole;
      turned[at] = static_cast<std::uint8_t>(~turned[at]);
      GetParam().run(turned);
    }
  }
}

// Results and journals as this version writes them, whatever the corpus holds.
TEST(Targets, AcceptWhatWasWritten) {
  ThrowResult throw_7;
  throw_7.index = 7;
  throw_7.flown.error = "none";
  throw_7.detection_rows.resize(2);
  const CampaignIdentity identity = {"seed: 1\n", "0.1.0", false};
  for (const std::string& bytes : {to_bytes(throw_7), to_bytes(identity)}) {
    EXPECT_TRUE(result({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
  }
  const fs::path path =
      fs::temp_directory_path() / ("dodgesim_fuzz_written_" + std::to_string(::getpid()));
  Journal(path, identity).add(throw_7);
  std::vector<std::uint8_t> file = contents(path);
  fs::remove(path);
  file.insert(file.begin(), 0);  // a whole file
  EXPECT_TRUE(journal(file));
}

}  // namespace
}  // namespace dodgesim::fuzz
