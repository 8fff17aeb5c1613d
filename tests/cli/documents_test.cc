// Links of the texts for people lead somewhere.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> documents() {
  const fs::path source = DODGESIM_SOURCE_DIR;
  std::vector<fs::path> found = {source / "README.md"};
  for (const char* folder : {"dodge", "models", "results", "scenarios", "tests", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      if (entry.path().extension() == ".md") found.push_back(entry.path());
    }
  }
  return found;
}

TEST(Documents, LinkToFilesThatAreThere) {
  int links = 0;
  const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
  for (const fs::path& document : documents()) {
    std::ostringstream text;
    text << std::ifstream(document).rdbuf();
    const std::string all = text.str();
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
