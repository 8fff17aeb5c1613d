#include "sim/base/shell.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace dodgesim {
namespace {

// What a shell takes the word for.
std::string through_a_shell(const std::string& word) {
  FILE* pipe = ::popen(("printf %s " + shell_quoted(word)).c_str(), "r");
  std::array<char, 256> buffer;
  const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe);
  ::pclose(pipe);
  return {buffer.data(), size};
}

TEST(ShellQuoted, IsWhatWasMeant) {
  for (const char* word : {"plain", "it's", "!uniform [4, 6]", "$HOME", "a\\b", "", "*", "a\nb"}) {
    EXPECT_EQ(through_a_shell(word), word);
  }
}

TEST(ShellQuoted, LeavesPlainWordsAsTheyAre) {
  EXPECT_EQ(shell_quoted("out/demo_1.5+2,x:y"), "out/demo_1.5+2,x:y");
  EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
}

}  // namespace
}  // namespace dodgesim
