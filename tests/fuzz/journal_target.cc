#include "sim/campaign/journal.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/campaign/wire.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

namespace {

// A record as the journal frames it, so that checksums do not end every search.
std::string framed(std::string_view bytes) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  const auto mark = static_cast<std::uint32_t>(XXH64(&size, sizeof size, 1));
  const std::uint64_t checksum = XXH64(bytes.data(), bytes.size(), 0);
  std::string header(16, '\0');
  std::memcpy(header.data(), &size, 4);
  std::memcpy(header.data() + 4, &mark, 4);
  std::memcpy(header.data() + 8, &checksum, 8);
  return header + std::string(bytes);
}

// Of a journal that holds nothing yet.
std::string front() {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("dodgesim_fuzz_journal_" + std::to_string(::getpid()));
  { const Journal journal(path, CampaignIdentity{"seed: 1\n", "0.1.0", "12ab", "34cd", false}); }
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  std::filesystem::remove(path);
  return bytes.str();
}

std::string journal_of(std::string_view records) {
  static const std::string beginning = front();
  std::string file = beginning;
  // Each record after its length, in one byte and another.
  while (records.size() > 2) {
    const std::size_t size =
        static_cast<unsigned char>(records[0]) * 256u + static_cast<unsigned char>(records[1]);
    file += framed(records.substr(2, size));
    records.remove_prefix(std::min(records.size(), 2 + size));
  }
  return file;
}

}  // namespace

bool journal(Bytes bytes) {
  if (bytes.empty()) return false;
  const std::string_view rest = text_of(bytes.subspan(1));
  const MemoryFile file(bytes[0] % 2 == 1 ? journal_of(rest) : std::string(rest));
  JournalIndex index;
  if (!accepts([&] { index = read_journal(file.path()); })) return false;
  for (const auto& [number, record] : index.throws) {
    const ThrowResult result = read_result(file.path(), record);
    require(result.index == number, "a throw is found by its number");
    require(result_digest(result) == record.digest, "a result is what the index says");
  }
  return true;
}

}  // namespace dodgesim::fuzz
