#include "sim/files/staged_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

// Whether the path still names the file that is open.
bool is_open_file(const std::filesystem::path& path, int fd) {
  struct stat named {};
  struct stat open {};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(fd, &open) == 0 &&
         named.st_dev == open.st_dev && named.st_ino == open.st_ino;
}

}  // namespace

StagedFile::StagedFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(path_, ignored);
  // What is there will be replaced, and a device or a pipe would be lost. Of a link the target is.
  if (std::filesystem::is_directory(there)) fail("could not be created", EISDIR);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    fail("is not a regular file", 0);
  }
  path_ = target(path_);
  partial_ = partial_name(path_);
  do {
    file_ = Descriptor();  // its lock must be gone
    file_ = Descriptor(::open(partial_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
    if (!file_) fail("could not be created", errno);
    lock();
  } while (!is_open_file(partial_, fd()));  // another program has renamed or removed it meanwhile
  if (::ftruncate(fd(), 0) != 0 && errno != EINVAL) fail("could not be created", errno);
}

std::filesystem::path StagedFile::target(const std::filesystem::path& path) {
  constexpr int kMostLinks = 40;
  std::filesystem::path end = path;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code no_link;
    const std::filesystem::path next = std::filesystem::read_symlink(end, no_link);
    if (no_link) return end;
    end = end.parent_path() / next;
  }
  throw IoError(path.string() + " could not be created: " + std::strerror(ELOOP) + ".");
}

// Two programs must not write to one file; on file systems without locks nothing prevents it. The
// lock belongs to the open file, because HDF5 opens the same file by its name and closes it again.
void StagedFile::lock() {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (::fcntl(fd(), F_OFD_SETLK, &whole) == 0 || (errno != EAGAIN && errno != EACCES)) return;
  file_ = Descriptor();
  fail("is being written by another program", 0);
}

StagedFile::~StagedFile() {
  // While the lock is held, and not if the name is another program's file by now.
  if (file_ && is_open_file(partial_, fd())) ::unlink(partial_.c_str());
}

// Some file systems report a full disk only here.
void StagedFile::sync() {
  if (::fsync(fd()) != 0 && errno != EINVAL) fail("could not be written", errno);
}

void StagedFile::commit() {
  sync();
  // While the lock is held: once it is dropped, the partial file may be another writer's.
  if (::rename(partial_.c_str(), path_.c_str()) != 0) fail("could not be written", errno);
  file_ = Descriptor();
}

void StagedFile::fail(const std::string& what, int error_number) const {
  const std::string reason =
      error_number == 0 ? "" : std::string(": ") + std::strerror(error_number);
  throw IoError(path_.string() + " " + what + reason + ".");
}

}  // namespace dodgesim
