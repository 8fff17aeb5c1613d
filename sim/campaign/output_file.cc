#include "sim/campaign/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

constexpr std::size_t kBufferBytes = 64 * 1024;

}  // namespace

OutputFile::OutputFile(std::filesystem::path path)
    : path_(std::move(path)), partial_(path_.string() + ".partial") {
  fd_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd_ < 0) fail("could not be created");
}

OutputFile::~OutputFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(partial_.c_str());
}

void OutputFile::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::commit() {
  flush();
  // Some file systems report a full disk only here.
  if (::fsync(fd_) != 0 && errno != EINVAL) fail("could not be written");
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0) {
    const int reason = errno;
    ::unlink(partial_.c_str());
    errno = reason;
    fail("could not be written");
  }
  if (::rename(partial_.c_str(), path_.c_str()) != 0) fail("could not be put in place");
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t n = ::write(fd_, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("could not be written");
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  buffer_.clear();
}

void OutputFile::fail(const std::string& what) const {
  throw IoError(path_.string() + " " + what + ": " + std::strerror(errno) + ".");
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace dodgesim
