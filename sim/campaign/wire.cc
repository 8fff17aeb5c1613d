#include "sim/campaign/wire.h"

#include <cstring>
#include <type_traits>
#include <utility>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

class ByteWriter {
 public:
  std::string take() { return std::move(bytes_); }

  void operator()(const char*, std::string& text) {
    number(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }

  void operator()(const char*, std::vector<AxisValue>& values) {
    number(static_cast<std::uint64_t>(values.size()));
    for (AxisValue& value : values) {
      (*this)("", value.key);
      (*this)("", value.value);
    }
  }

  template <class T>
  void operator()(const char*, std::optional<T>& value) {
    number(static_cast<char>(value.has_value()));
    if (value) (*this)("", *value);
  }

  template <class T, std::size_t N>
  void operator()(const char*, std::array<T, N>& values) {
    for (T& value : values) number(value);
  }

  template <class T>
  void operator()(const char*, T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      number(value);
    } else {
      value.visit(*this);
    }
  }

 private:
  template <class T>
  void number(const T& value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes_.append(raw, sizeof(T));
  }

  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  bool at_end() const { return bytes_.empty(); }

  void operator()(const char*, std::string& text) {
    std::uint64_t size = 0;
    number(size);
    text = std::string(take(size));
  }

  void operator()(const char*, std::vector<AxisValue>& values) {
    std::uint64_t count = 0;
    number(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      AxisValue& value = values.emplace_back();
      (*this)("", value.key);
      (*this)("", value.value);
    }
  }

  template <class T>
  void operator()(const char*, std::optional<T>& value) {
    char present = 0;
    number(present);
    if (present != 0) (*this)("", value.emplace());
  }

  template <class T, std::size_t N>
  void operator()(const char*, std::array<T, N>& values) {
    for (T& value : values) number(value);
  }

  template <class T>
  void operator()(const char*, T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      number(value);
    } else {
      value.visit(*this);
    }
  }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw IoError("A result is not whole.");
    const std::string_view head = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return head;
  }

  void number(bool& value) { value = take(1).front() != '\0'; }

  template <class T>
  void number(T& value) {
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
  }

  std::string_view bytes_;
};

template <class Row>
void write_rows(ByteWriter& writer, std::vector<Row>& rows) {
  auto count = static_cast<std::uint64_t>(rows.size());
  writer("", count);
  for (Row& row : rows) writer("", row);
}

template <class Row>
void read_rows(ByteReader& reader, std::vector<Row>& rows) {
  std::uint64_t count = 0;
  reader("", count);
  for (std::uint64_t i = 0; i < count; ++i) reader("", rows.emplace_back());
}

}  // namespace

std::string to_bytes(const ThrowResult& result) {
  ThrowResult copy = result;
  ByteWriter writer;
  copy.visit(writer);
  writer("", copy.trajectory);
  writer("", copy.wall_s);
  write_rows(writer, copy.object_rows);
  write_rows(writer, copy.detection_rows);
  write_rows(writer, copy.truth_rows);
  return writer.take();
}

ThrowResult result_from_bytes(std::string_view bytes) {
  ThrowResult result;
  ByteReader reader(bytes);
  result.visit(reader);
  reader("", result.trajectory);
  reader("", result.wall_s);
  read_rows(reader, result.object_rows);
  read_rows(reader, result.detection_rows);
  read_rows(reader, result.truth_rows);
  if (!reader.at_end()) throw IoError("A result is longer than one.");
  return result;
}

std::string to_bytes(const CampaignIdentity& identity) {
  CampaignIdentity copy = identity;
  ByteWriter writer;
  copy.visit(writer);
  return writer.take();
}

CampaignIdentity identity_from_bytes(std::string_view bytes) {
  CampaignIdentity identity;
  ByteReader reader(bytes);
  identity.visit(reader);
  if (!reader.at_end()) throw IoError("The identity of a campaign is longer than one.");
  return identity;
}

}  // namespace dodgesim
