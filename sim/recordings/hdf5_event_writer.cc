#include "sim/recordings/hdf5_event_writer.h"

#include <cerrno>
#include <limits>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/files/staged_file.h"
#include "sim/recordings/hdf5_library.h"

namespace dodgesim {

namespace {

constexpr hsize_t kChunkValues = 1 << 15;  // values that are compressed together
constexpr unsigned kGzipLevel = 1;

class Hdf5Writer : public EventWriter {
 public:
  Hdf5Writer(const std::filesystem::path& path, const Recording& recording) : staged_(path) {
    prepare_hdf5();
    file_ = create_file();
    const hid_t group = checked(H5Gcreate2(file_, "events", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    x_.dataset = create_column("events/x", H5T_STD_U16LE);
    y_.dataset = create_column("events/y", H5T_STD_U16LE);
    t_.dataset = create_column("events/t", H5T_STD_U32LE);
    p_.dataset = create_column("events/p", H5T_STD_U8LE);
    if (recording.has_causes) cause_.dataset = create_column("events/cause", H5T_STD_U8LE);
    ms_to_idx_.dataset = create_column("ms_to_idx", H5T_STD_U64LE);
    write_scalar("events/height", recording.height);
    write_scalar("events/width", recording.width);
    write_scalar("t_offset", recording.t_offset_us);
    check(H5Gclose(group));
  }

  // A file that was not finished stays open until the program ends: the library crashes when it is
  // to close what it could not write.
  ~Hdf5Writer() override = default;

  void add(std::span<const Event> events, std::span<const Cause> causes) override {
    for (const Event& event : events) {
      while (static_cast<TimeUs>(milliseconds_) * 1000 <= event.t_us) {
        put(ms_to_idx_, count_);
        ++milliseconds_;
      }
      put(x_, event.x);
      put(y_, event.y);
      put(t_, static_cast<std::uint32_t>(event.t_us));
      put(p_, static_cast<std::uint8_t>(event.polarity > 0 ? 1 : 0));
      ++count_;
    }
    for (const Cause cause : causes) put(cause_, cause);
  }

  void finish() override {
    if (file_ < 0) return;
    if (milliseconds_ == 0) put(ms_to_idx_, count_);
    close_column(x_);
    close_column(y_);
    close_column(t_);
    close_column(p_);
    if (cause_.dataset >= 0) close_column(cause_);
    close_column(ms_to_idx_);
    // Closing a file reports no error when the disk is full: flushing does.
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL));
    check(H5Fclose(std::exchange(file_, -1)));
    staged_.sync();
  }

  void commit() override {
    finish();
    staged_.commit();
  }

 private:
  template <class T>
  struct Column {
    hid_t dataset = -1;
    hsize_t written = 0;
    std::vector<T> waiting;  // less than a chunk
  };

  static hid_t memory_type(std::uint8_t) { return H5T_NATIVE_UINT8; }
  static hid_t memory_type(std::uint16_t) { return H5T_NATIVE_UINT16; }
  static hid_t memory_type(std::uint32_t) { return H5T_NATIVE_UINT32; }
  static hid_t memory_type(std::uint64_t) { return H5T_NATIVE_UINT64; }

  template <class Result>
  Result checked(Result result) const {
    if (result < 0) staged_.fail("could not be written", errno);
    return result;
  }
  void check(herr_t status) const { checked(status); }

  hid_t create_file() const {
    const hid_t access = checked(H5Pcreate(H5P_FILE_ACCESS));
    check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));  // H5Fclose closes all that is in it
    check(H5Pset_file_locking(access, false, true));        // some network file systems have none
    errno = 0;
    const hid_t file =
        checked(H5Fcreate(staged_.partial().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
    check(H5Pclose(access));
    return file;
  }

  // Without time stamps, so that the same recording makes the same bytes.
  hid_t dataset_properties() const {
    const hid_t properties = checked(H5Pcreate(H5P_DATASET_CREATE));
    check(H5Pset_obj_track_times(properties, false));
    return properties;
  }

  hid_t create_column(const char* name, hid_t type) const {
    const hsize_t none = 0;
    const hsize_t unlimited = H5S_UNLIMITED;
    const hid_t space = checked(H5Screate_simple(1, &none, &unlimited));
    const hid_t properties = dataset_properties();
    check(H5Pset_chunk(properties, 1, &kChunkValues));
    check(H5Pset_shuffle(properties));
    check(H5Pset_deflate(properties, kGzipLevel));
    const hid_t dataset =
        checked(H5Dcreate2(file_, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    check(H5Pclose(properties));
    check(H5Sclose(space));
    return dataset;
  }

  void write_scalar(const char* name, std::int64_t value) const {
    const hid_t space = checked(H5Screate(H5S_SCALAR));
    const hid_t properties = dataset_properties();
    const hid_t dataset = checked(
        H5Dcreate2(file_, name, H5T_STD_I64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    check(H5Dwrite(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value));
    check(H5Dclose(dataset));
    check(H5Pclose(properties));
    check(H5Sclose(space));
  }

  template <class T>
  void put(Column<T>& column, T value) {
    column.waiting.push_back(value);
    if (column.waiting.size() == kChunkValues) write(column);
  }

  template <class T>
  void write(Column<T>& column) {
    const hsize_t count = column.waiting.size();
    if (count == 0) return;
    const hsize_t size = column.written + count;
    errno = 0;
    check(H5Dset_extent(column.dataset, &size));
    const hid_t memory = checked(H5Screate_simple(1, &count, nullptr));
    const hid_t disk = checked(H5Dget_space(column.dataset));
    check(H5Sselect_hyperslab(disk, H5S_SELECT_SET, &column.written, nullptr, &count, nullptr));
    check(H5Dwrite(column.dataset, memory_type(T{}), memory, disk, H5P_DEFAULT,
                   column.waiting.data()));
    check(H5Sclose(disk));
    check(H5Sclose(memory));
    column.written = size;
    column.waiting.clear();
  }

  template <class T>
  void close_column(Column<T>& column) {
    write(column);
    check(H5Dclose(column.dataset));
  }

  StagedFile staged_;
  hid_t file_ = -1;
  Column<std::uint16_t> x_, y_;
  Column<std::uint32_t> t_;
  Column<std::uint8_t> p_;
  Column<Cause> cause_;  // without a dataset when the recording has no causes
  Column<std::uint64_t> ms_to_idx_;
  std::uint64_t count_ = 0;         // events
  std::uint64_t milliseconds_ = 0;  // entries of ms_to_idx
};

}  // namespace

std::unique_ptr<EventWriter> make_hdf5_event_writer(const std::filesystem::path& path,
                                                    const Recording& recording) {
  if (recording.duration_us > std::numeric_limits<std::uint32_t>::max()) {
    throw ScenarioError(path.string() + " cannot hold the recording of " +
                        std::to_string(recording.duration_us) +
                        " us: time stamps of this format end at 2^32 - 1 us (71.6 minutes); " +
                        ".npy and .txt have no such limit.");
  }
  return std::make_unique<Hdf5Writer>(path, recording);
}

}  // namespace dodgesim
