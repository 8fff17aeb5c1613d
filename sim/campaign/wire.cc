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

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char*, Number& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }

  void operator()(const char*, std::string& text) {
    size(text.size());
    bytes_ += text;
  }

  void operator()(const char*, AxisValue& value) {
    (*this)("", value.key);
    (*this)("", value.value);
  }

  template <class T>
  void operator()(const char*, std::optional<T>& value) {
    bool present = value.has_value();
    (*this)("", present);
    if (value) (*this)("", *value);
  }

  template <class T>
  void operator()(const char*, std::vector<T>& values) {
    size(values.size());
    for (T& value : values) (*this)("", value);
  }

  template <class T, std::size_t N>
  void operator()(const char*, std::array<T, N>& values) {
    for (T& value : values) (*this)("", value);
  }

  template <class T>
  void operator()(const char*, T& value) {
    value.visit(*this);
  }

 private:
  void size(std::uint64_t count) { (*this)("", count); }

  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  bool at_end() const { return bytes_.empty(); }

  void operator()(const char*, bool& value) { value = take(1).front() != '\0'; }

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char*, Number& value) {
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }

  void operator()(const char*, std::string& text) { text = take(read<std::uint64_t>()); }

  void operator()(const char*, AxisValue& value) {
    (*this)("", value.key);
    (*this)("", value.value);
  }

  template <class T>
  void operator()(const char*, std::optional<T>& value) {
    if (read<bool>()) (*this)("", value.emplace());
  }

  template <class T>
  void operator()(const char*, std::vector<T>& values) {
    const auto count = read<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) (*this)("", values.emplace_back());
  }

  template <class T, std::size_t N>
  void operator()(const char*, std::array<T, N>& values) {
    for (T& value : values) (*this)("", value);
  }

  template <class T>
  void operator()(const char*, T& value) {
    value.visit(*this);
  }

 private:
  template <class Number>
  Number read() {
    Number value{};
    (*this)("", value);
    return value;
  }

  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw IoError("A result is not whole.");
    const std::string_view head = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return head;
  }

  std::string_view bytes_;
};

}  // namespace

std::string to_bytes(const ThrowResult& result) {
  ThrowResult copy = result;
  ByteWriter writer;
  copy.visit(writer);
  writer("", copy.trajectory);
  writer("", copy.wall_s);
  writer("", copy.object_rows);
  writer("", copy.detection_rows);
  writer("", copy.truth_rows);
  return writer.take();
}

ThrowResult result_from_bytes(std::string_view bytes) {
  ThrowResult result;
  ByteReader reader(bytes);
  result.visit(reader);
  reader("", result.trajectory);
  reader("", result.wall_s);
  reader("", result.object_rows);
  reader("", result.detection_rows);
  reader("", result.truth_rows);
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
