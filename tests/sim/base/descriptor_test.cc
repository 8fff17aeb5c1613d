#include "sim/base/descriptor.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <thread>

namespace dodgesim {
namespace {

TEST(Descriptor, TransfersMoreThanAPipeTakesAtOnce) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  std::string sent(1 << 20, '\0'), got(sent.size(), 'x');
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<char>(i * i >> 8);
  std::thread writer([&] {
    EXPECT_TRUE(write_all(ends[1], sent));
    ::close(ends[1]);
  });
  EXPECT_TRUE(read_all(ends[0], got.data(), got.size()));
  EXPECT_EQ(got, sent);
  EXPECT_FALSE(read_all(ends[0], got.data(), 1));  // the end
  writer.join();
  ::close(ends[0]);
}

TEST(Descriptor, WritesAtAnOffset) {
  char name[] = "/tmp/descriptor_test_XXXXXX";
  const int file = ::mkstemp(name);
  ASSERT_GE(file, 0);
  ::unlink(name);
  EXPECT_TRUE(write_all(file, "0123456789"));
  EXPECT_TRUE(pwrite_all(file, "abc", 4));
  ::lseek(file, 0, SEEK_SET);
  std::string got(10, '\0');
  EXPECT_TRUE(read_all(file, got.data(), got.size()));
  EXPECT_EQ(got, "0123abc789");
  ::close(file);
}

TEST(Descriptor, SaysWhyItCouldNotWrite) {
  EXPECT_FALSE(write_all(-1, "a"));
  EXPECT_EQ(errno, EBADF);
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  ::close(ends[0]);
  EXPECT_FALSE(send_all(ends[1], "a"));  // and no signal
  EXPECT_EQ(errno, EPIPE);
  ::close(ends[1]);
}

}  // namespace
}  // namespace dodgesim
