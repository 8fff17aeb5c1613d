// Links of the texts for people lead somewhere, and the README says what the results say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/input_file.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::vector<fs::path> documents() {
  const fs::path source = DODGESIM_SOURCE_DIR;
  std::vector<fs::path> found = {source / "README.md"};
  for (const char* folder : {"dodge", "models", "results", "scenarios", "sim", "tests", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      if (entry.path().extension() == ".md") found.push_back(entry.path());
    }
  }
  return found;
}

std::string text_of(const std::string& file) {
  return read_file(fs::path(DODGESIM_SOURCE_DIR) / file);
}

// The README with single spaces for its line breaks.
std::string readme() {
  std::string text = text_of("README.md");
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// What the pattern's brackets hold of where it is found first.
std::smatch found(const std::string& text, const std::string& pattern) {
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex(pattern))) << pattern;
  return match;
}

// Throws that were dodged at a range cap: by the pilot, and by the oracle.
std::pair<std::string, std::string> dodged_at_cap(const std::string& cap) {
  const std::string table = text_of("results/range_caps/range_cap_" + cap + ".md");
  return {found(table, R"(Dodged: (\d+) / 200)")[1],
          found(table, R"(\| all \| oracle \|[^\n]*\| (\d+) / 200 \([^|]*\|\n)")[1]};
}

TEST(Documents, TheReadmeQuotesTheRangeCaps) {
  const auto [near, oracle_near] = dodged_at_cap("1_5m");
  const auto [far, oracle_far] = dodged_at_cap("3m");
  EXPECT_THAT(readme(),
              HasSubstr("On 200 throws with the same range limit for both the pilot dodges " +
                        near + " where the oracle dodges " + oracle_near + " (1.5 m), and " + far +
                        " where it dodges " + oracle_far + " (3 m)"));
}

TEST(Documents, TheReadmeQuotesThePapersExperiments) {
  const std::string outdoor = text_of("results/paper/outdoor.md");
  const std::smatch hover =
      found(outdoor, R"(\| hover, all \| (\d+) / 80 [^|]*\|[^|]*\| (\d+) / 80 )");
  EXPECT_THAT(readme(),
              HasSubstr("dodges " + hover[2].str() + " of 80 balls of 4 to 8 m/s from 3 " +
                        "to 5 m at a vehicle that hovers outdoors, of which the paper's " +
                        "dodges " + hover[1].str() + ":"));
}

// Its rows of speeds begin like those of the table, with shorter intervals.
TEST(Documents, TheReadmeQuotesTheDemo) {
  const std::string demo = text_of("results/demo/table.md"), text = readme();
  const std::regex row(
      R"(\| (\d to \d m/s) \| (\d+ / \d+) [^|]*\| (\d+ / \d+) [^|]*\| (\d+ / \d+) )");
  int rows = 0;
  for (std::sregex_iterator it(demo.begin(), demo.end(), row), end; it != end; ++it, ++rows) {
    const std::smatch& cells = *it;
    const std::smatch quoted =
        found(text, "\\| " + cells[1].str() +
                        R"( \| (\d+ / \d+) [^|]*\| (\d+ / \d+) [^|]*\| (\d+ / \d+) )");
    for (const int i : {1, 2, 3}) EXPECT_EQ(quoted[i].str(), cells[i + 1].str()) << cells[1];
  }
  EXPECT_EQ(rows, 5);
}

TEST(Documents, LinkToFilesThatAreThere) {
  int links = 0;
  const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
  for (const fs::path& document : documents()) {
    const std::string all = read_file(document);
    for (std::sregex_iterator it(all.begin(), all.end(), link), end; it != end; ++it) {
      const std::string target = (*it)[1];
      if (target.find("://") != std::string::npos) continue;
      ++links;
      EXPECT_TRUE(fs::exists(document.parent_path() / target)) << document << ": " << target;
    }
  }
  EXPECT_GT(links, 30);
}

}  // namespace
}  // namespace dodgesim
