#include "sim/base/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace dodgesim {
namespace {

constexpr int kWallMs = 20000;

TEST(AskChild, HearsTheWholeAnswer) {
  const std::string text(1000000, 'x');
  const ChildAnswer answer = ask_child([&] { return text + "end"; }, kWallMs);
  EXPECT_TRUE(answer.in_time);
  EXPECT_EQ(answer.said, text + "end");
}

TEST(AskChild, WhatTheTaskDoesStaysInItsProcess) {
  int value = 1;
  const ChildAnswer answer = ask_child([&] { return std::to_string(++value); }, kWallMs);
  EXPECT_EQ(answer.said, "2");
  EXPECT_EQ(value, 1);
}

TEST(AskChild, ACrashOrAnExceptionSaysNothing) {
  EXPECT_EQ(ask_child([]() -> std::string { std::abort(); }, kWallMs).said, "");
  EXPECT_EQ(ask_child([]() -> std::string { throw std::runtime_error("no"); }, kWallMs).said, "");
}

TEST(AskChild, GivesUpInTime) {
  const ChildAnswer answer = ask_child(
      []() -> std::string {
        ::sleep(60);
        return "late";
      },
      50);
  EXPECT_FALSE(answer.in_time);
  EXPECT_EQ(answer.said, "");
}

}  // namespace
}  // namespace dodgesim
