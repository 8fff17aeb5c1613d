#include "sim/recordings/hdf5_event_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "sim/base/formatted.h"
#include "sim/recordings/hdf5_library.h"
#include "sim/recordings/raw_event.h"

namespace dodgesim {

namespace {

constexpr std::size_t kChunkCacheBytes = 256 << 20;  // larger chunks are unpacked again and again
constexpr hsize_t kChunkEvents = 1 << 15;            // events: the chunks of hdf5_event_writer.cc

// Open for reading; closes all that is in it, too.
class Hdf5File {
 public:
  explicit Hdf5File(const std::string& path) {
    prepare_hdf5();
    if (!std::filesystem::is_regular_file(path)) {
      throw IoError(path + " cannot be read: it is no file.");
    }
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    id_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
    H5Pclose(access);
    if (id_ < 0) throw ScenarioError(path + " cannot be opened as HDF5.");
  }
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File() { H5Fclose(id_); }

  hid_t id() const { return id_; }

 private:
  hid_t id_ = -1;
};

class Hdf5Reader : public EventReader {
 public:
  Hdf5Reader(const std::string& path, const ImageSize& image)
      : path_(path), image_(image), file_(path) {
    for (const char* name : {"CD/events", "events"}) {
      if (records_.empty() && is(name, H5I_DATASET)) records_ = name;
    }
    if (records_.empty() && !is("events", H5I_GROUP) &&
        (is("t", H5I_DATASET) || is("ts", H5I_DATASET))) {
      group_ = "";
    }
    expect_size("width", image.width);
    expect_size("height", image.height);
    offset_us_ = scalar("t_offset").value_or(0);
    const std::array<const char*, 4> fields = {"t", "x", "y", "p"};
    const std::string plural = records_.empty() && is(group_ + "ts", H5I_DATASET) ? "s" : "";
    for (std::size_t i = 0; i < fields.size(); ++i) {
      columns_[i].index = i;
      open_column(fields[i] + plural, columns_[i]);
    }
    in_seconds_ = has_fractions();
  }

  bool in_seconds() const override { return in_seconds_; }

  double part_read() const override { return share(read_, size_); }

  std::span<const Event> next() override {
    const hsize_t count = std::min(kChunkEvents, size_ - read_);
    for (Hdf5Column& column : columns_) read(column, count);
    events_.clear();
    for (std::size_t i = 0; i < count; ++i, ++read_) {
      events_.push_back(
          checked_event({time_us(columns_[0].values[i]) + offset_us_, columns_[1].values[i],
                         columns_[2].values[i], columns_[3].values[i]},
                        image_, [&] { return path_ + ", event " + std::to_string(read_); }));
    }
    return events_;
  }

 private:
  struct Hdf5Column {
    std::string name;
    hsize_t index = 0;  // in columns_, and in a table
    hid_t dataset = -1;
    hid_t type = -1;       // of the values in memory or, of records, of the one field that is read
    bool is_real = false;  // then `values` are the bits of doubles
    std::vector<std::int64_t> values;  // of the portion
  };

  // Whether one of the first events has a fraction in place of whole microseconds.
  bool has_fractions() {
    if (!columns_[0].is_real) return false;
    read(columns_[0], std::min<hsize_t>(kEventsThatTellUnit, size_));
    return std::ranges::any_of(columns_[0].values, [](std::int64_t bits) {
      const auto t = std::bit_cast<double>(bits);
      return t != std::floor(t);
    });
  }

  std::int64_t time_us(std::int64_t value) const {
    constexpr std::int64_t kMostUs = 2 * kLastUs;  // whatever is added: checked_event() refuses it
    if (!columns_[0].is_real) return std::clamp(value, -kMostUs, kMostUs);
    const double t_us = std::bit_cast<double>(value) * (in_seconds_ ? 1e6 : 1);
    if (std::abs(t_us) < static_cast<double>(kMostUs)) return std::llround(t_us);
    throw ScenarioError(path_ + ", event " + std::to_string(read_) + ": t is " +
                        formatted("%g", std::bit_cast<double>(value)) +
                        ", which is no instant in " + (in_seconds_ ? "s." : "us."));
  }

  // Whether there is such an object, of that kind. Of "a/b", a must be looked for first.
  bool is(const std::string& name, H5I_type_t kind) const {
    const std::size_t slash = name.find('/');
    if (slash != name.npos && !is(name.substr(0, slash), H5I_GROUP)) return false;
    if (H5Lexists(file_.id(), name.c_str(), H5P_DEFAULT) <= 0) return false;
    const hid_t object = H5Oopen(file_.id(), name.c_str(), H5P_DEFAULT);
    if (object < 0) return false;
    const bool of_kind = H5Iget_type(object) == kind;
    H5Oclose(object);
    return of_kind;
  }

  // A whole number, of whatever type.
  std::optional<std::int64_t> scalar(const std::string& name) const {
    if (!is(name, H5I_DATASET)) return std::nullopt;
    const hid_t dataset = H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::int64_t value = 0;
    long double exact = 0;
    const bool read =
        H5Sget_simple_extent_npoints(space) == 1 &&
        H5Dread(dataset, H5T_NATIVE_LDOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &exact) >= 0 &&
        H5Dread(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) >= 0;
    H5Sclose(space);
    H5Dclose(dataset);
    if (!read || !std::isfinite(exact) || exact != std::floor(exact)) {
      throw ScenarioError(path_ + ": " + name + " must be one whole number.");
    }
    if (std::abs(exact) <= static_cast<long double>(kLastUs)) return value;
    throw ScenarioError(path_ + ": " + name + " is " + formatted("%.0Lf", exact) +
                        ", but must be from " + std::to_string(-kLastUs) + " to " +
                        std::to_string(kLastUs) +
                        (name == "t_offset" ? " us: are these nanoseconds?" : "."));
  }

  void expect_size(const std::string& side, int expected) const {
    const std::optional<std::int64_t> value = scalar(group_ + side);
    if (!value || *value == expected) return;
    throw ScenarioError(path_ + ": " + group_ + side + " is " + std::to_string(*value) +
                        ", but the calibration says " + std::to_string(expected) + ".");
  }

  void open_column(const std::string& field, Hdf5Column& column) {
    const std::string dataset = records_.empty() ? group_ + field : records_;
    column.name = records_.empty() ? dataset : records_ + ", " + field;
    const hid_t access = H5Pcreate(H5P_DATASET_ACCESS);
    H5Pset_chunk_cache(access, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, kChunkCacheBytes, 1);
    column.dataset = H5Dopen2(file_.id(), dataset.c_str(), access);
    H5Pclose(access);
    if (column.dataset < 0) {
      throw ScenarioError(path_ + " has no " + dataset +
                          "; it must have events/t, x, y and p, or these at its root, or records " +
                          "of them as CD/events.");
    }
    std::array<hsize_t, H5S_MAX_RANK> sides{};
    const hid_t space = H5Dget_space(column.dataset);
    const int dimensions = H5Sget_simple_extent_dims(space, sides.data(), nullptr);
    H5Sclose(space);
    is_table_ = !records_.empty() && dimensions == 2 && sides[1] == columns_.size();
    set_type(field, column);
    if (column.index == 0) size_ = sides[0];
    if ((dimensions == 1 || is_table_) && sides[0] == size_) return;
    throw ScenarioError(path_ + ": " + column.name + " must be a list as long as " +
                        columns_.front().name + ".");
  }

  // Refuses other than whole numbers, but for t: the library would cut off what stands behind the
  // point.
  void set_type(const std::string& field, Hdf5Column& column) const {
    hid_t type = H5Dget_type(column.dataset);
    const bool of_records = !records_.empty() && !is_table_;
    if (of_records) {
      const bool compound = H5Tget_class(type) == H5T_COMPOUND;
      const int member = compound ? H5Tget_member_index(type, field.c_str()) : -1;
      if (member < 0) throw ScenarioError(path_ + ": " + records_ + " has no field " + field + ".");
      const hid_t of_member = H5Tget_member_type(type, static_cast<unsigned>(member));
      H5Tclose(std::exchange(type, of_member));
    }
    const H5T_class_t kind = H5Tget_class(type);
    H5Tclose(type);
    column.is_real = kind == H5T_FLOAT && column.index == 0 && !is_table_;
    const hid_t in_memory = column.is_real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
    column.type = in_memory;
    if (of_records) {
      column.type = H5Tcreate(H5T_COMPOUND, sizeof(std::int64_t));
      H5Tinsert(column.type, field.c_str(), 0, in_memory);
    }
    if (kind == H5T_INTEGER || kind == H5T_ENUM || column.is_real) return;  // enum: booleans
    throw ScenarioError(path_ + ": " + column.name +
                        " has no whole numbers, as pixels, polarities and a table's "
                        "microseconds are.");
  }

  void read(Hdf5Column& column, hsize_t count) const {
    column.values.resize(count);
    if (count == 0) return;
    const hid_t memory = H5Screate_simple(1, &count, nullptr);
    const hid_t disk = H5Dget_space(column.dataset);
    const std::array<hsize_t, 2> from = {read_, column.index}, size = {count, 1};  // of a table
    const bool read =
        H5Sselect_hyperslab(disk, H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr) >=
            0 &&
        H5Dread(column.dataset, column.type, memory, disk, H5P_DEFAULT, column.values.data()) >= 0;
    H5Sclose(disk);
    H5Sclose(memory);
    if (read) return;
    throw IoError(path_ + ": " + column.name +
                  " cannot be read: it is damaged, or packed with a filter that the HDF5 library "
                  "finds no plug-in for (blosc, say; h5repack -f GZIP=1 unpacks it).");
  }

  std::string path_;
  ImageSize image_;
  Hdf5File file_;
  std::string group_ = "events/";  // of the four lists; empty: the root
  std::string records_;            // the list of records, or table; empty: there are four lists
  bool is_table_ = false;
  bool in_seconds_ = false;
  std::int64_t offset_us_ = 0;
  std::array<Hdf5Column, 4> columns_;  // t, x, y, p
  hsize_t size_ = 0, read_ = 0;        // events
  std::vector<Event> events_;
};

}  // namespace

std::unique_ptr<EventReader> open_hdf5_events(const std::string& path, const ImageSize& image) {
  return std::make_unique<Hdf5Reader>(path, image);
}

}  // namespace dodgesim
