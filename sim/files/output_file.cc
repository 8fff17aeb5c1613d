#include "sim/files/output_file.h"

#include <cerrno>

#include "sim/base/descriptor.h"

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
  if (!pwrite_all(staged_.fd(), text, 0)) staged_.fail("could not be written", errno);
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
  if (!write_all(staged_.fd(), buffer_)) staged_.fail("could not be written", errno);
  buffer_.clear();
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace dodgesim
