#include "sim/recordings/hdf5_event_reader.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <vector>

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
    expect_size("events/width", image.width);
    expect_size("events/height", image.height);
    if (const std::optional<std::int64_t> offset_us = scalar("t_offset")) offset_us_ = *offset_us;
    const std::array<const char*, 4> names = {"events/t", "events/x", "events/y", "events/p"};
    for (std::size_t i = 0; i < names.size(); ++i) open_column(names[i], columns_[i]);
  }

  std::span<const Event> next() override {
    const hsize_t count = std::min(kChunkEvents, size_ - read_);
    for (Column& column : columns_) read(column, count);
    events_.clear();
    for (std::size_t i = 0; i < count; ++i, ++read_) {
      events_.push_back(checked_event({columns_[0].values[i] + offset_us_, columns_[1].values[i],
                                       columns_[2].values[i], columns_[3].values[i]},
                                      image_,
                                      [&] { return path_ + ", event " + std::to_string(read_); }));
    }
    return events_;
  }

 private:
  struct Column {
    const char* name = "";
    hid_t dataset = -1;
    std::vector<std::int64_t> values;  // of the portion
  };

  std::optional<std::int64_t> scalar(const char* name) const {
    if (H5Lexists(file_.id(), "events", H5P_DEFAULT) <= 0) return std::nullopt;
    if (H5Lexists(file_.id(), name, H5P_DEFAULT) <= 0) return std::nullopt;
    const hid_t dataset = H5Dopen2(file_.id(), name, H5P_DEFAULT);
    if (dataset < 0) return std::nullopt;
    const hid_t space = H5Dget_space(dataset);
    std::int64_t value = 0;
    const bool read =
        H5Sget_simple_extent_npoints(space) == 1 &&
        H5Dread(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) >= 0;
    H5Sclose(space);
    H5Dclose(dataset);
    if (!read) throw ScenarioError(path_ + ": " + name + " must be one whole number.");
    return value;
  }

  void expect_size(const char* name, int expected) const {
    const std::optional<std::int64_t> value = scalar(name);
    if (!value || *value == expected) return;
    throw ScenarioError(path_ + ": " + name + " is " + std::to_string(*value) +
                        ", but the calibration says " + std::to_string(expected) + ".");
  }

  void open_column(const char* name, Column& column) {
    column.name = name;
    const hid_t access = H5Pcreate(H5P_DATASET_ACCESS);
    H5Pset_chunk_cache(access, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, kChunkCacheBytes, 1);
    column.dataset = H5Dopen2(file_.id(), name, access);
    H5Pclose(access);
    if (column.dataset < 0) {
      throw ScenarioError(path_ + " has no " + name + "; it must have events/t, x, y and p.");
    }
    expect_whole_numbers(column);
    const hid_t space = H5Dget_space(column.dataset);
    const int dimensions = H5Sget_simple_extent_ndims(space);
    const auto size = static_cast<hsize_t>(H5Sget_simple_extent_npoints(space));
    H5Sclose(space);
    if (&column == &columns_.front()) size_ = size;
    if (dimensions == 1 && size == size_) return;
    throw ScenarioError(path_ + ": " + name + " must be a list as long as events/t.");
  }

  // The library would cut off what stands behind the point.
  void expect_whole_numbers(const Column& column) const {
    const hid_t type = H5Dget_type(column.dataset);
    const H5T_class_t kind = H5Tget_class(type);
    H5Tclose(type);
    if (kind == H5T_INTEGER || kind == H5T_ENUM) return;  // booleans are an enumeration
    throw ScenarioError(path_ + ": " + column.name +
                        " has no whole numbers; t must be in microseconds, x and y in pixels.");
  }

  void read(Column& column, hsize_t count) const {
    column.values.resize(count);
    if (count == 0) return;
    const hid_t memory = H5Screate_simple(1, &count, nullptr);
    const hid_t disk = H5Dget_space(column.dataset);
    H5Sselect_hyperslab(disk, H5S_SELECT_SET, &read_, nullptr, &count, nullptr);
    const herr_t status =
        H5Dread(column.dataset, H5T_NATIVE_INT64, memory, disk, H5P_DEFAULT, column.values.data());
    H5Sclose(disk);
    H5Sclose(memory);
    if (status >= 0) return;
    throw IoError(path_ + ": " + column.name +
                  " cannot be read: it is damaged, or packed with a filter that the HDF5 library "
                  "finds no plug-in for (blosc, say; h5repack -f GZIP=1 unpacks it).");
  }

  std::string path_;
  ImageSize image_;
  Hdf5File file_;
  std::int64_t offset_us_ = 0;
  std::array<Column, 4> columns_;  // t, x, y, p
  hsize_t size_ = 0, read_ = 0;    // events
  std::vector<Event> events_;
};

}  // namespace

std::unique_ptr<EventReader> open_hdf5_events(const std::string& path, const ImageSize& image) {
  return std::make_unique<Hdf5Reader>(path, image);
}

}  // namespace dodgesim
