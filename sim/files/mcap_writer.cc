#include "sim/files/mcap_writer.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
constexpr std::size_t kChunkBytes = 1 << 20;

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void append_text(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

std::string record(Opcode opcode, std::string_view content) {
  std::string bytes;
  append(bytes, static_cast<std::uint8_t>(opcode));
  append(bytes, static_cast<std::uint64_t>(content.size()));
  bytes += content;
  return bytes;
}

// Of data whose checksum is `before`, continued by `bytes`.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

void McapWriter::Interval::include(std::uint64_t time_ns, bool is_first) {
  first_ns = is_first ? time_ns : std::min(first_ns, time_ns);
  last_ns = is_first ? time_ns : std::max(last_ns, time_ns);
}

McapWriter::McapWriter(const std::filesystem::path& path) : file_(path) {
  std::string header;
  append_text(header, "");  // no profile
  append_text(header, "dodgesim");
  put(kMcapMagic);
  put(record(kHeader, header));
}

std::uint16_t McapWriter::add_topic(const std::string& topic, const std::string& schema_name,
                                    const std::string& json_schema) {
  const auto [schema, is_new] =
      schemas_.try_emplace(schema_name, static_cast<std::uint16_t>(schemas_.size() + 1));
  if (is_new) {
    std::string content;
    append(content, schema->second);
    append_text(content, schema_name);
    append_text(content, "jsonschema");
    append_text(content, json_schema);
    const std::string bytes = record(kSchema, content);
    schema_records_ += bytes;
    chunk_ += bytes;
  }
  const auto number = static_cast<std::uint16_t>(topics_.size() + 1);
  std::string content;
  append(content, number);
  append(content, schema->second);
  append_text(content, topic);
  append_text(content, "json");
  append(content, std::uint32_t{0});  // no metadata
  topics_.push_back({record(kChannel, content)});
  chunk_ += topics_.back().record;
  return number;
}

void McapWriter::write(std::uint16_t topic, TimeUs t_us, std::string_view json) {
  const std::uint64_t time_ns = static_cast<std::uint64_t>(t_us) * 1000;
  std::string content;
  append(content, topic);
  append(content, topics_.at(topic - 1u).count++);
  append(content, time_ns);  // logged
  append(content, time_ns);  // published
  content += json;
  chunk_times_.include(time_ns, chunk_index_.empty());
  times_.include(time_ns, messages_++ == 0);
  chunk_index_[topic].push_back({time_ns, chunk_.size()});
  chunk_ += record(kMessage, content);
  if (chunk_.size() >= kChunkBytes) end_chunk();
}

// The chunk with its index, and what the summary says about both.
void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t start = size_;
  std::string content;
  append(content, chunk_times_.first_ns);
  append(content, chunk_times_.last_ns);
  append(content, static_cast<std::uint64_t>(chunk_.size()));
  append(content, crc32(chunk_));
  append_text(content, "");  // no compression
  append(content, static_cast<std::uint64_t>(chunk_.size()));
  content += chunk_;
  put(record(kChunk, content));
  const std::uint64_t end = size_;

  std::string offsets;
  for (const auto& [topic, entries] : chunk_index_) {
    append(offsets, topic);
    append(offsets, size_);
    std::string index;
    append(index, topic);
    append(index, static_cast<std::uint32_t>(entries.size() * sizeof(IndexEntry)));
    for (const IndexEntry& entry : entries) {
      append(index, entry.time_ns);
      append(index, entry.offset);
    }
    put(record(kMessageIndex, index));
  }

  std::string summary;
  append(summary, chunk_times_.first_ns);
  append(summary, chunk_times_.last_ns);
  append(summary, start);
  append(summary, end - start);
  append_text(summary, offsets);
  append(summary, size_ - end);
  append_text(summary, "");
  append(summary, static_cast<std::uint64_t>(chunk_.size()));  // compressed
  append(summary, static_cast<std::uint64_t>(chunk_.size()));
  chunk_indexes_ += record(kChunkIndex, summary);
  ++chunks_;
  chunk_.clear();
  chunk_index_.clear();
  chunk_times_ = {};
}

std::string McapWriter::statistics() const {
  std::string counts;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    append(counts, static_cast<std::uint16_t>(i + 1));
    append(counts, std::uint64_t{topics_[i].count});
  }
  std::string content;
  append(content, messages_);
  append(content, static_cast<std::uint16_t>(schemas_.size()));
  append(content, static_cast<std::uint32_t>(topics_.size()));
  append(content, std::uint32_t{0});  // attachments
  append(content, std::uint32_t{0});  // metadata
  append(content, chunks_);
  append(content, times_.first_ns);
  append(content, times_.last_ns);
  append_text(content, counts);
  return record(kStatistics, content);
}

// A group of records of the summary and, in `offsets`, where it is.
void McapWriter::put_group(std::uint8_t opcode, const std::string& records,
                           std::uint64_t summary_start, std::string& summary,
                           std::string& offsets) const {
  if (records.empty()) return;
  std::string content;
  append(content, opcode);
  append(content, summary_start + summary.size());
  append(content, static_cast<std::uint64_t>(records.size()));
  offsets += record(kSummaryOffset, content);
  summary += records;
}

void McapWriter::finish() {
  end_chunk();
  std::string data_end;
  append(data_end, data_crc_);
  put(record(kDataEnd, data_end));

  const std::uint64_t start = size_;
  std::string channels, summary, offsets;
  for (const Topic& topic : topics_) channels += topic.record;
  put_group(kSchema, schema_records_, start, summary, offsets);
  put_group(kChannel, channels, start, summary, offsets);
  put_group(kStatistics, statistics(), start, summary, offsets);
  put_group(kChunkIndex, chunk_indexes_, start, summary, offsets);
  const std::uint64_t offsets_start = start + summary.size();
  summary += offsets;

  // The checksum is of everything from the summary's start up to itself, in the footer.
  std::string footer;
  append(footer, start);
  append(footer, offsets_start);
  append(footer, std::uint32_t{0});
  footer = record(kFooter, footer);
  footer.resize(footer.size() - sizeof(std::uint32_t));
  append(footer, crc32(footer, crc32(summary)));
  put(summary);
  put(footer);
  put(kMcapMagic);
  file_.commit();
}

void McapWriter::put(std::string_view bytes) {
  file_.write(bytes);
  size_ += bytes.size();
  data_crc_ = crc32(bytes, data_crc_);
}

}  // namespace dodgesim
