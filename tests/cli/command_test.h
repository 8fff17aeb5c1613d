// A directory of its own for each test of a command, and what lies in it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim::testing {

class CommandTest : public ::testing::Test {
 protected:
  // `folder` is the directory's own name.
  explicit CommandTest(const std::string& folder = "test") : root_(parent_ / folder) {
    std::filesystem::create_directories(root_);
  }

  std::string path(const std::string& name) const { return (root_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { put(root_ / name, text); }
  std::string contents(const std::string& name) const {
    EXPECT_TRUE(std::filesystem::exists(root_ / name)) << name;
    return testing::contents(root_ / name);
  }
  // The cells of one column of a CSV file without quoted cells.
  std::vector<std::string> column(const std::string& file, const std::string& name) const {
    std::istringstream lines(contents(file));
    std::vector<std::string> cells;
    std::ptrdiff_t at = -1;
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> row;
      std::istringstream in(line);
      for (std::string cell; std::getline(in, cell, ',');) row.push_back(cell);
      if (at < 0) {
        at = std::find(row.begin(), row.end(), name) - row.begin();
        EXPECT_LT(at, static_cast<std::ptrdiff_t>(row.size())) << name;
      } else {
        cells.push_back(row.at(static_cast<std::size_t>(at)));
      }
    }
    return cells;
  }
  // What two campaigns found.
  void expect_same(const std::string& a, const std::string& b) const {
    for (const char* file : {"/throws.csv", "/detections.csv", "/table.md", "/table.csv"}) {
      EXPECT_FALSE(contents(a + file).empty()) << file;
      EXPECT_EQ(contents(a + file), contents(b + file)) << file;
    }
  }

  const TemporaryDirectory parent_;
  const std::filesystem::path root_;
};

}  // namespace dodgesim::testing
