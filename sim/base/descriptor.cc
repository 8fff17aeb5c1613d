#include "sim/base/descriptor.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace dodgesim {

namespace {

// transfer(done) is a system call for what is left after the first `done` bytes.
template <class Transfer>
bool all(std::size_t size, Transfer transfer) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = transfer(done);
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = ENOSPC;  // of a write; a read has come to the end
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

bool write_all(int file, std::string_view bytes) {
  return all(bytes.size(), [&](std::size_t done) {
    return ::write(file, bytes.data() + done, bytes.size() - done);
  });
}

bool pwrite_all(int file, std::string_view bytes, std::uint64_t at) {
  return all(bytes.size(), [&](std::size_t done) {
    return ::pwrite(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
  });
}

bool send_all(int socket, std::string_view bytes) {
  return all(bytes.size(), [&](std::size_t done) {
    return ::send(socket, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
  });
}

bool read_all(int file, void* data, std::size_t size) {
  return all(size, [&](std::size_t done) {
    return ::read(file, static_cast<char*>(data) + done, size - done);
  });
}

}  // namespace dodgesim
