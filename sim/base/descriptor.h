// Bytes from and to files, pipes and sockets, as many as are asked for. All functions block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace dodgesim {

// An open file, closed when it goes.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}  // negative: none
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor();

  explicit operator bool() const { return fd_ >= 0; }
  int get() const { return fd_; }

 private:
  int fd_ = -1;
};

// Write all bytes: to a file or pipe; to a file from the offset `at` on; to a socket, of which a
// reader that has gone makes an error and no signal. False, with errno, if not all could be
// written.
bool write_all(int file, std::string_view bytes);
bool pwrite_all(int file, std::string_view bytes, std::uint64_t at);
bool send_all(int socket, std::string_view bytes);

// Reads `size` bytes to `data`; false if there are fewer before the end, or reading fails.
bool read_all(int file, void* data, std::size_t size);

}  // namespace dodgesim
