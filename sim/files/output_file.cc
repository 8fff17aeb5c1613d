#include "sim/files/output_file.h"

#include <unistd.h>

#include <cerrno>

namespace dodgesim {

namespace {

constexpr std::size_t kBufferBytes = 64 * 1024;

}  // namespace

void OutputFile::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::rewrite_front(std::string_view text) {
  flush();
  off_t at = 0;
  while (!text.empty()) {
    const ssize_t n = ::pwrite(staged_.fd(), text.data(), text.size(), at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) staged_.fail("could not be written", errno);
    text.remove_prefix(static_cast<std::size_t>(n));
    at += n;
  }
}

void OutputFile::finish() {
  flush();
  staged_.sync();
}

void OutputFile::commit() {
  flush();
  staged_.commit();
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t n = ::write(staged_.fd(), rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) staged_.fail("could not be written", errno);
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  buffer_.clear();
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace dodgesim
