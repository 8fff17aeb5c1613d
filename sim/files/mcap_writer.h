// Recordings of messages on several topics in the MCAP format (https://mcap.dev/spec), which
// Foxglove and Lichtblick open.
//
// Messages are JSON with a JSON schema. The file is chunked, not compressed, and has an index of
// every chunk, a summary and all checksums. Same messages, same bytes. It appears only when it is
// whole (staged_file.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/time.h"
#include "sim/files/output_file.h"

namespace dodgesim {

class McapWriter {
 public:
  // All functions throw IoError with the path and the reason when the file cannot be written.
  explicit McapWriter(const std::filesystem::path& path);

  // A topic, whose messages are JSON of the named schema; its number for write(). Topics may share
  // a schema, which is the same text every time. At most 65535 topics.
  std::uint16_t add_topic(const std::string& topic, const std::string& schema_name,
                          const std::string& json_schema);

  // Times may come in any order; none before 0.
  void write(std::uint16_t topic, TimeUs t_us, std::string_view json);

  // Completes the file. Without it nothing is left behind.
  void finish();

 private:
  struct Topic {
    std::string record;  // its Channel record
    std::uint32_t count = 0;
  };
  struct IndexEntry {
    std::uint64_t time_ns;
    std::uint64_t offset;  // of the message's record in the chunk
  };
  struct Interval {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    void include(std::uint64_t time_ns, bool is_first);
  };

  void put(std::string_view bytes);
  void put_group(std::uint8_t opcode, const std::string& records, std::uint64_t summary_start,
                 std::string& summary, std::string& offsets) const;
  void end_chunk();
  std::string statistics() const;

  OutputFile file_;
  std::uint64_t size_ = 0;      // of the file so far
  std::uint32_t data_crc_ = 0;  // of the file so far

  std::map<std::string, std::uint16_t> schemas_;  // numbers, by name
  std::string schema_records_;
  std::vector<Topic> topics_;  // topic i has the number i + 1

  // The chunk that is being filled, and all together.
  std::string chunk_;
  std::map<std::uint16_t, std::vector<IndexEntry>> chunk_index_;  // by topic
  Interval chunk_times_, times_;
  std::uint64_t messages_ = 0;
  std::string chunk_indexes_;  // records of the summary
  std::uint32_t chunks_ = 0;
};

}  // namespace dodgesim
