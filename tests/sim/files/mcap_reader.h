// A second reading of the MCAP specification: every record, checksum, offset and count of a file is
// held against the others. Failures are those of the test that calls it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dodgesim::testing {

struct McapMessage {
  std::string topic, schema;
  std::uint64_t time_ns = 0;
  std::string json;
};

class McapReader {
 public:
  explicit McapReader(std::string bytes) : bytes_(std::move(bytes)) { read(); }

  const std::vector<McapMessage>& messages() const { return messages_; }
  const std::map<std::string, std::string>& schemas() const { return schema_texts_; }
  int chunks() const { return static_cast<int>(chunks_.size()); }

  std::vector<McapMessage> of(const std::string& topic) const {
    std::vector<McapMessage> found;
    for (const McapMessage& message : messages_) {
      if (message.topic == topic) found.push_back(message);
    }
    return found;
  }

 private:
  // Takes values off the front of some bytes.
  struct Cursor {
    std::string_view rest;
    bool at_end() const { return rest.empty(); }
    std::string_view take(std::uint64_t size) {
      if (size > rest.size()) throw std::out_of_range("a record ends too early");
      const std::string_view head = rest.substr(0, size);
      rest.remove_prefix(size);
      return head;
    }
    std::uint64_t number(int bytes) {
      std::uint64_t value = 0;
      const std::string_view raw = take(static_cast<std::uint64_t>(bytes));
      for (int i = bytes; i-- > 0;) {
        value = value << 8 | static_cast<unsigned char>(raw[static_cast<std::size_t>(i)]);
      }
      return value;
    }
    std::string_view text() { return take(number(4)); }
  };
  struct Record {
    int opcode = 0;
    Cursor content;
    std::uint64_t begin = 0, end = 0;  // in the file, or in the chunk
  };
  struct Chunk {
    std::uint64_t begin = 0, end = 0, indexes_end = 0;
    std::uint64_t first_ns = 0, last_ns = 0, size = 0;
    std::map<int, std::map<std::uint64_t, std::uint64_t>> messages;  // topic: offset: time
    std::map<int, std::uint64_t> indexes;                            // topic: offset in the file
  };

  // Bit by bit.
  static std::uint32_t crc(std::string_view bytes) {
    std::uint32_t value = 0xFFFFFFFF;
    for (const char c : bytes) {
      value ^= static_cast<unsigned char>(c);
      for (int i = 0; i < 8; ++i) value = (value & 1) != 0 ? value >> 1 ^ 0xEDB88320 : value >> 1;
    }
    return value ^ 0xFFFFFFFF;
  }

  static std::vector<Record> split(std::string_view bytes, std::uint64_t offset) {
    std::vector<Record> records;
    Cursor cursor{bytes};
    while (!cursor.at_end()) {
      Record record;
      record.begin = offset + (bytes.size() - cursor.rest.size());
      record.opcode = static_cast<int>(cursor.number(1));
      record.content = {cursor.take(cursor.number(8))};
      record.end = offset + (bytes.size() - cursor.rest.size());
      records.push_back(record);
    }
    return records;
  }

  void read() {
    const std::string magic("\x89MCAP0\r\n", 8);
    ASSERT_GE(bytes_.size(), 2 * magic.size());
    ASSERT_EQ(bytes_.substr(0, 8), magic);
    ASSERT_EQ(bytes_.substr(bytes_.size() - 8), magic);
    const std::string_view all(bytes_);
    const std::vector<Record> records = split(all.substr(8, all.size() - 16), 8);
    ASSERT_GE(records.size(), 3u);
    ASSERT_EQ(records.front().opcode, 0x01);
    ASSERT_EQ(records.back().opcode, 0x02);
    std::size_t i = 1;
    for (; records.at(i).opcode != 0x0F; ++i) read_data(records[i]);
    Record end = records[i];
    EXPECT_EQ(end.content.number(4), crc(all.substr(0, end.begin))) << "of the data section";

    Record footer = records.back();
    const std::uint64_t summary_start = footer.content.number(8);
    const std::uint64_t offsets_start = footer.content.number(8);
    EXPECT_EQ(summary_start, end.end);
    EXPECT_EQ(footer.content.number(4),
              crc(all.substr(summary_start, bytes_.size() - 8 - 4 - summary_start)));
    std::map<int, std::pair<std::uint64_t, std::uint64_t>> groups;  // opcode: begin and end
    for (++i; i + 1 < records.size() && records[i].begin < offsets_start; ++i) {
      const auto [group, is_new] =
          groups.try_emplace(records[i].opcode, std::pair{records[i].begin, records[i].end});
      EXPECT_TRUE(is_new || group->second.second == records[i].begin) << "groups are together";
      group->second.second = records[i].end;
      read_summary(records[i]);
    }
    for (; i + 1 < records.size(); ++i) {
      Record offset = records[i];
      ASSERT_EQ(offset.opcode, 0x0E);
      const auto group = groups.find(static_cast<int>(offset.content.number(1)));
      ASSERT_NE(group, groups.end());
      EXPECT_EQ(offset.content.number(8), group->second.first);
      EXPECT_EQ(offset.content.number(8), group->second.second - group->second.first);
      groups.erase(group);
    }
    EXPECT_TRUE(groups.empty()) << "every group has its offset";
    EXPECT_EQ(channels_, summary_channels_);
    EXPECT_EQ(schemas_, summary_schemas_);
    EXPECT_EQ(chunks_indexed_, chunks_.size());
  }

  static void read_schema(Cursor content, std::map<int, std::pair<std::string, std::string>>& to) {
    const int id = static_cast<int>(content.number(2));
    EXPECT_GT(id, 0);
    const std::string name(content.text());
    EXPECT_EQ(content.text(), "jsonschema");
    to[id] = {name, std::string(content.text())};
    EXPECT_TRUE(content.at_end());
  }

  static void read_channel(Cursor content, std::map<int, std::pair<int, std::string>>& to) {
    const int id = static_cast<int>(content.number(2));
    const int schema = static_cast<int>(content.number(2));
    to[id] = {schema, std::string(content.text())};
    EXPECT_EQ(content.text(), "json");
    EXPECT_EQ(content.text(), "") << "metadata";
    EXPECT_TRUE(content.at_end());
  }

  void read_data(const Record& record) {
    if (record.opcode == 0x06) return read_chunk(record);
    ASSERT_EQ(record.opcode, 0x07);
    ASSERT_FALSE(chunks_.empty());
    Chunk& chunk = chunks_.back();
    chunk.indexes_end = record.end;
    Cursor content = record.content;
    const int topic = static_cast<int>(content.number(2));
    chunk.indexes[topic] = record.begin;
    std::map<std::uint64_t, std::uint64_t> entries;
    for (Cursor index{content.text()}; !index.at_end();) {
      const std::uint64_t time_ns = index.number(8);
      entries[index.number(8)] = time_ns;
    }
    EXPECT_EQ(entries, chunk.messages.at(topic));
  }

  void read_chunk(const Record& record) {
    Cursor content = record.content;
    Chunk chunk;
    chunk.begin = record.begin;
    chunk.end = chunk.indexes_end = record.end;
    chunk.first_ns = content.number(8);
    chunk.last_ns = content.number(8);
    chunk.size = content.number(8);
    const std::uint64_t checksum = content.number(4);
    EXPECT_EQ(content.text(), "") << "compression";
    const std::string_view inside = content.take(content.number(8));
    EXPECT_TRUE(content.at_end());
    EXPECT_EQ(inside.size(), chunk.size);
    EXPECT_EQ(crc(inside), checksum);
    std::uint64_t first = UINT64_MAX, last = 0;
    for (const Record& inner : split(inside, 0)) {
      if (inner.opcode == 0x03) {
        read_schema(inner.content, schemas_);
      } else if (inner.opcode == 0x04) {
        read_channel(inner.content, channels_);
      } else {
        ASSERT_EQ(inner.opcode, 0x05);
        read_message(inner, chunk, first, last);
      }
    }
    if (!chunk.messages.empty()) {
      EXPECT_EQ(chunk.first_ns, first);
      EXPECT_EQ(chunk.last_ns, last);
    }
    chunks_.push_back(chunk);
  }

  void read_message(const Record& record, Chunk& chunk, std::uint64_t& first, std::uint64_t& last) {
    Cursor content = record.content;
    const int topic = static_cast<int>(content.number(2));
    ASSERT_TRUE(channels_.count(topic)) << "a channel comes before its messages";
    const auto& [schema, name] = channels_.at(topic);
    ASSERT_TRUE(schemas_.count(schema)) << "a schema comes before its channels";
    EXPECT_EQ(content.number(4), counts_[topic]++) << "sequence";
    const std::uint64_t time_ns = content.number(8);
    content.number(8);
    first = std::min(first, time_ns);
    last = std::max(last, time_ns);
    chunk.messages[topic][record.begin] = time_ns;
    messages_.push_back({name, schemas_.at(schema).first, time_ns, std::string(content.rest)});
    schema_texts_[schemas_.at(schema).first] = schemas_.at(schema).second;
  }

  void read_summary(const Record& record) {
    Cursor content = record.content;
    if (record.opcode == 0x03) return read_schema(content, summary_schemas_);
    if (record.opcode == 0x04) return read_channel(content, summary_channels_);
    if (record.opcode == 0x08) return read_chunk_index(content);
    ASSERT_EQ(record.opcode, 0x0B);
    std::uint64_t first = UINT64_MAX, last = 0;
    for (const McapMessage& message : messages_) {
      first = std::min(first, message.time_ns);
      last = std::max(last, message.time_ns);
    }
    EXPECT_EQ(content.number(8), messages_.size());
    EXPECT_EQ(content.number(2), schemas_.size());
    EXPECT_EQ(content.number(4), channels_.size());
    EXPECT_EQ(content.number(4), 0u) << "attachments";
    EXPECT_EQ(content.number(4), 0u) << "metadata";
    EXPECT_EQ(content.number(4), chunks_.size());
    EXPECT_EQ(content.number(8), messages_.empty() ? 0 : first);
    EXPECT_EQ(content.number(8), last);
    for (Cursor counts{content.text()}; !counts.at_end();) {
      const int topic = static_cast<int>(counts.number(2));
      EXPECT_EQ(counts.number(8), counts_[topic]);
    }
    EXPECT_TRUE(content.at_end());
  }

  void read_chunk_index(Cursor content) {
    ASSERT_LT(chunks_indexed_, chunks_.size());
    const Chunk& chunk = chunks_[chunks_indexed_++];
    EXPECT_EQ(content.number(8), chunk.first_ns);
    EXPECT_EQ(content.number(8), chunk.last_ns);
    EXPECT_EQ(content.number(8), chunk.begin);
    EXPECT_EQ(content.number(8), chunk.end - chunk.begin);
    std::map<int, std::uint64_t> indexes;
    for (Cursor offsets{content.text()}; !offsets.at_end();) {
      const int topic = static_cast<int>(offsets.number(2));
      indexes[topic] = offsets.number(8);
    }
    EXPECT_EQ(indexes, chunk.indexes);
    EXPECT_EQ(content.number(8), chunk.indexes_end - chunk.end);
    EXPECT_EQ(content.text(), "") << "compression";
    EXPECT_EQ(content.number(8), chunk.size);
    EXPECT_EQ(content.number(8), chunk.size);
    EXPECT_TRUE(content.at_end());
  }

  std::string bytes_;
  std::map<int, std::pair<std::string, std::string>> schemas_, summary_schemas_;  // name, text
  std::map<int, std::pair<int, std::string>> channels_, summary_channels_;        // schema, topic
  std::map<std::string, std::string> schema_texts_;
  std::map<int, std::uint64_t> counts_;
  std::vector<Chunk> chunks_;
  std::size_t chunks_indexed_ = 0;
  std::vector<McapMessage> messages_;
};

}  // namespace dodgesim::testing
