// The bytes that fuzzing began with and has found, through the targets that it ran, in any build.
#include <gtest/gtest.h>
#include <unistd.h>

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
using Input = std::vector<std::uint8_t>;

Input contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Input input_of(const std::string& bytes) { return {bytes.begin(), bytes.end()}; }

// A journal with one result, as this version writes it.
Input written_journal(const CampaignIdentity& identity, const ThrowResult& result) {
  const fs::path path =
      fs::temp_directory_path() / ("dodgesim_fuzz_written_" + std::to_string(::getpid()));
  Journal(path, identity).add(result);
  Input file = contents(path);
  fs::remove(path);
  return file;
}

enum class Found { kLeftOut, kTaken };

// The corpus of a target, with or without what libFuzzer found (those files are named by 40
// digits). Formats that change with the version also as they are today.
std::vector<Input> corpus(const std::string& target, Found found) {
  constexpr std::size_t kDigits = 40;
  std::vector<Input> inputs;
  const fs::path folder = fs::path(DODGESIM_SOURCE_DIR) / "tests/fuzz/corpus" / target;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_found = entry.path().filename().string().size() == kDigits;
    if (!is_found || found == Found::kTaken) inputs.push_back(contents(entry.path()));
  }
  const CampaignIdentity identity = {"seed: 1\n", "0.1.0", "12ab", "34cd", false};
  ThrowResult result;
  result.index = 7;
  result.flown.error = "none";
  result.detection_rows.resize(2);
  if (target == "result") {
    inputs.push_back(input_of(to_bytes(result)));
    inputs.push_back(input_of(to_bytes(identity)));
  }
  if (target == "journal") {
    inputs.push_back(written_journal(identity, result));
    inputs.back().insert(inputs.back().begin(), 0);  // a whole file
    inputs.push_back(input_of(to_bytes(result)));
    const std::size_t size = inputs.back().size();  // a record after its length
    inputs.back().insert(inputs.back().begin(), {1, static_cast<std::uint8_t>(size / 256),
                                                 static_cast<std::uint8_t>(size % 256)});
  }
  return inputs;
}

class Corpus : public ::testing::TestWithParam<Target> {};
INSTANTIATE_TEST_SUITE_P(Readers, Corpus, ::testing::ValuesIn(kTargets),
                         [](const auto& info) { return info.param.name; });

TEST_P(Corpus, BreaksNoPromise) {
  int accepted = 0;
  for (const Input& input : corpus(GetParam().name, Found::kTaken)) {
    accepted += GetParam().run(input) ? 1 : 0;
  }
  EXPECT_GT(accepted, 0) << "nothing behind the reader's first check is tested";
}

// Every input cut off and with a byte turned over, at a few places: what fuzzing begins with.
TEST_P(Corpus, BreaksNoPromiseWhenDamaged) {
  for (const Input& whole : corpus(GetParam().name, Found::kLeftOut)) {
    const std::size_t step = whole.size() / 16 + 1;
    for (std::size_t at = 0; at < whole.size(); at += step) {
      GetParam().run({whole.data(), at});
      Input turned = whole;
      turned[at] = static_cast<std::uint8_t>(~turned[at]);
      GetParam().run(turned);
    }
  }
}

}  // namespace
}  // namespace dodgesim::fuzz
