#include "sim/campaign/journal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>

#include "sim/base/descriptor.h"
#include "sim/base/error.h"
#include "sim/campaign/campaign_files.h"
#include "sim/campaign/wire.h"
#include "sim/files/staged_file.h"

namespace dodgesim {

namespace {

constexpr std::chrono::seconds kSyncEvery(1);

// Changes with every change of what is written.
constexpr char kMagic[8] = {'d', 'o', 'd', 'g', 'e', 'j', '0', '7'};

// In front of the identity and of every record.
struct RecordHeader {
  std::uint32_t size = 0;
  std::uint32_t mark = 0;  // checksum of the size: whether the next record can be found
  std::uint64_t checksum = 0;
};
static_assert(sizeof(RecordHeader) == 16);

std::uint64_t checksum(const char* bytes, std::size_t size) { return XXH64(bytes, size, 0); }

std::uint32_t mark_of(std::uint32_t size) {
  return static_cast<std::uint32_t>(XXH64(&size, sizeof size, 1));
}

std::string framed(const std::string& bytes) {
  if (bytes.size() > kLargestRecord) throw IoError("A throw's results exceed a gigabyte.");
  RecordHeader header;
  header.size = static_cast<std::uint32_t>(bytes.size());
  header.mark = mark_of(header.size);
  header.checksum = checksum(bytes.data(), bytes.size());
  std::string out(sizeof header, '\0');
  std::memcpy(out.data(), &header, sizeof header);
  return out + bytes;
}

// Reads a journal from its start.
class RecordReader {
 public:
  explicit RecordReader(const std::filesystem::path& path) : path_(path) {
    std::error_code ignored;
    // A pipe, say, would be waited for.
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path)) {
      fail("is not a regular file");
    }
    file_.open(path, std::ios::binary);
    if (!file_) fail_to_open(errno);
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(file_.tellg());
  }

  // The next frame's bytes; `intact` says whether they are as they were written. Where no frame
  // begins, as after damage to a header, everything up to the next intact one counts as one that is
  // not. False when none follows.
  bool next(std::string& bytes, bool& intact) {
    RecordHeader header;
    if (size_ - at_ >= sizeof header) read(&header, sizeof header);
    if (size_ - at_ < sizeof header || !fits(header, size_ - at_)) {
      intact = false;
      return skip_to_intact();
    }
    bytes.resize(header.size);
    at_ += sizeof header;
    read(bytes.data(), header.size);
    at_ += header.size;
    intact = checksum(bytes.data(), bytes.size()) == header.checksum;
    return true;
  }

  void expect_magic() {
    char magic[sizeof kMagic] = {};
    if (size_ < sizeof magic) fail("is cut off at its beginning; --force flies everything again");
    read(magic, sizeof magic);
    if (std::memcmp(magic, kMagic, sizeof magic) != 0) {
      fail("holds no results of this version of dodgesim");
    }
    at_ += sizeof magic;
  }

  std::uint64_t at() const { return at_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(path_.string() + " " + what + ".");
  }

 private:
  [[noreturn]] void fail_to_open(int error) const {
    refuse_file(path_.parent_path());
    const bool nothing = error == ENOENT || error == ENOTDIR;
    fail(std::string("could not be opened: ") + std::strerror(error) +
         (nothing ? std::string("; ") + kWhatNamesACampaign : ""));
  }

  // Whether this is the header of a frame that ends within `room` bytes from its beginning.
  static bool fits(const RecordHeader& header, std::uint64_t room) {
    return header.mark == mark_of(header.size) && header.size <= kLargestRecord &&
           header.size <= room - sizeof header;
  }

  bool skip_to_intact() {
    std::string rest(size_ - at_, '\0');
    read(rest.data(), rest.size());
    for (std::size_t i = 1; i + sizeof(RecordHeader) <= rest.size(); ++i) {
      RecordHeader header;
      std::memcpy(&header, rest.data() + i, sizeof header);
      if (!fits(header, rest.size() - i) ||
          checksum(rest.data() + i + sizeof header, header.size) != header.checksum) {
        continue;
      }
      at_ += i;
      return true;
    }
    return false;
  }

  void read(void* data, std::size_t size) {
    if (size == 0) return;
    file_.seekg(static_cast<std::streamoff>(at_));
    file_.read(static_cast<char*>(data), static_cast<std::streamsize>(size));
    if (!file_) fail("could not be read");
  }

  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t at_ = 0, size_ = 0;
};

ThrowResult decoded(const std::string& bytes, const std::filesystem::path& path) {
  try {
    return result_from_bytes(bytes);
  } catch (const IoError& error) {
    throw IoError(path.string() + ": " + error.what());
  }
}

}  // namespace

std::uint64_t result_digest(const ThrowResult& result) {
  ThrowResult timeless = result;
  timeless.wall_s = 0;
  const std::string bytes = to_bytes(timeless);
  return checksum(bytes.data(), bytes.size());
}

JournalIndex read_journal(const std::filesystem::path& path) {
  RecordReader reader(path);
  reader.expect_magic();
  JournalIndex index;
  std::string bytes;
  bool intact = false;
  if (!reader.next(bytes, intact) || !intact) {
    reader.fail(
        "is damaged or cut off at its beginning: what it holds cannot be read. To fly everything "
        "again, add --force to the run");
  }
  index.identity = identity_from_bytes(bytes);
  index.end = reader.at();
  while (reader.next(bytes, intact)) {
    if (!intact) {
      ++index.damaged;
      continue;
    }
    index.end = reader.at();
    const ThrowResult result = decoded(bytes, path);
    const auto size = static_cast<std::uint32_t>(bytes.size());
    index.throws[result.index] = {reader.at() - size, size, result_digest(result), result.lost()};
  }
  return index;
}

std::string damage_text(const std::string& directories) {
  return "results.bin of " + directories +
         " is damaged or cut off, and --resume flies there what was lost";
}

namespace {

ThrowResult read_result(std::ifstream& file, const std::filesystem::path& path,
                        const JournalRecord& record) {
  std::string bytes(record.size, '\0');
  file.seekg(static_cast<std::streamoff>(record.offset));
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw IoError(path.string() + " could not be read.");
  ThrowResult result = decoded(bytes, path);
  if (result_digest(result) != record.digest) throw IoError(path.string() + " has changed.");
  return result;
}

}  // namespace

ThrowResult read_result(const std::filesystem::path& path, const JournalRecord& record) {
  std::ifstream file(path, std::ios::binary);
  return read_result(file, path, record);
}

void for_each_result(const std::filesystem::path& path, const JournalIndex& index,
                     const std::function<void(ThrowResult)>& take) {
  std::ifstream file(path, std::ios::binary);
  for (const auto& [number, record] : index.throws) take(read_result(file, path, record));
}

Journal::Journal(const std::filesystem::path& path, const CampaignIdentity& identity)
    : path_(path) {
  // Whole or not there at all.
  path_ = StagedFile::partial_name(path);
  open(O_CREAT | O_TRUNC);
  append(std::string(kMagic, sizeof kMagic) + framed(to_bytes(identity)));
  sync();
  if (::rename(path_.c_str(), path.c_str()) != 0) fail("could not be renamed", errno);
  path_ = path;
}

Journal::Journal(const std::filesystem::path& path, const JournalIndex& index)
    : path_(path), end_(index.end) {
  open(0);
  if (::ftruncate(file_.get(), static_cast<off_t>(end_)) != 0) fail("could not be cut", errno);
}

void Journal::open(int flags) {
  file_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_CLOEXEC | flags, 0644));
  if (!file_) fail("could not be opened", errno);
}

void Journal::add(const ThrowResult& result) {
  append(framed(to_bytes(result)));
  if (WallClock::now() - synced_ > kSyncEvery) sync();
}

void Journal::expect_only_writer() const {
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) fail("could not be examined", errno);
  if (static_cast<std::uint64_t>(status.st_size) == end_) return;
  throw IoError(path_.string() + " is being written to by another dodgesim, on another host?");
}

void Journal::append(const std::string& bytes) {
  expect_only_writer();
  if (!pwrite_all(file_.get(), bytes, end_)) {
    const int error = errno;
    if (::ftruncate(file_.get(), static_cast<off_t>(end_)) != 0) fail("could not be cut", errno);
    fail("could not be written", error);
  }
  end_ += bytes.size();
}

void Journal::sync() {
  synced_ = WallClock::now();
  if (::fdatasync(file_.get()) == 0 || errno == EINVAL || errno == ENOTSUP) return;
  fail("could not be written", errno);
}

void Journal::fail(const std::string& what, int error) const {
  throw IoError(path_.string() + " " + what + ": " + std::strerror(error) + ".");
}

}  // namespace dodgesim
