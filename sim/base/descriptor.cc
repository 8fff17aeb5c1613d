#include "sim/base/descriptor.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace dodgesim {

namespace {

template <class Write>
bool all(std::string_view bytes, Write write) {
  while (!bytes.empty()) {
    const ssize_t n = write(bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

bool write_all(int file, std::string_view bytes) {
  return all(bytes,
             [file](std::string_view left) { return ::write(file, left.data(), left.size()); });
}

bool send_all(int socket, std::string_view bytes) {
  return all(bytes, [socket](std::string_view left) {
    return ::send(socket, left.data(), left.size(), MSG_NOSIGNAL);
  });
}

}  // namespace dodgesim
