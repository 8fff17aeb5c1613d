#include "sim/campaign/workers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace dodgesim {
namespace {

// A process that has ended stays in the system, without open files, until it is waited for.
void kill_and_await_end(const std::string& pid) {
  ::kill(std::stoi(pid), SIGKILL);
  std::string ignored, state;
  do {
    std::ifstream("/proc/" + pid + "/stat") >> ignored >> ignored >> state;
  } while (state != "Z");
}

TEST(Workers, OneThatDiesBetweenTwoThrowsCostsNeither) {
  std::vector<int> received;
  WorkerTasks tasks;
  tasks.next = [next = 0]() mutable {
    return next < 4 ? std::optional(Task{0, next++}) : std::nullopt;
  };
  tasks.fly = [](const Task& task) {
    ThrowResult result;
    result.index = task.throw_index;
    result.flown.error = std::to_string(::getpid());
    return result;
  };
  tasks.blank = [](const Task& task) {
    ThrowResult result;
    result.index = task.throw_index;
    return result;
  };
  tasks.receive = [&](const Task& task, const ThrowResult& result) {
    EXPECT_EQ(result.index, task.throw_index);
    EXPECT_FALSE(result.lost()) << result.flown.error;
    if (!result.lost() && task.throw_index % 2 == 0) kill_and_await_end(result.flown.error);
    received.push_back(task.throw_index);
  };
  fly_in_workers(tasks);
  EXPECT_THAT(received, ::testing::ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace dodgesim
