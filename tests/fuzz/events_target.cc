#include <unistd.h>

#include <array>
#include <filesystem>

#include "sim/recordings/event_reader.h"
#include "sim/recordings/sensor_log.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

namespace {

// A file in memory under a name with that end.
class NamedFile {
 public:
  NamedFile(std::string_view contents, const std::string& end)
      : file_(contents),
        path_((std::filesystem::temp_directory_path() /
               ("dodgesim_fuzz_" + std::to_string(::getpid()) + end))
                  .string()) {
    std::filesystem::remove(path_);
    std::filesystem::create_symlink(file_.path(), path_);
  }
  ~NamedFile() { std::filesystem::remove(path_); }
  NamedFile(const NamedFile&) = delete;
  NamedFile& operator=(const NamedFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  MemoryFile file_;
  std::string path_;
};

void read_events(const std::string& path) {
  const ImageSize image = {320, 240};
  const auto reader = open_events(path, image);
  for (auto events = reader->next(); !events.empty(); events = reader->next()) {
    for (const Event& event : events) {
      require(event.x < image.width && event.y < image.height, "pixels lie in the image");
      require(event.polarity == 1 || event.polarity == -1, "an event is ON or OFF");
      require(event.t_us >= 0, "no event is before 0");
    }
  }
}

template <class Reading>
void expect_increasing(const std::vector<Reading>& log) {
  for (std::size_t i = 1; i < log.size(); ++i) {
    require(log[i].t_us > log[i - 1].t_us, "the time of readings goes on");
  }
}

}  // namespace

// The first byte says what the others are.
bool events(Bytes bytes) {
  if (bytes.empty()) return false;
  constexpr std::array<const char*, 6> kEnds = {".txt", ".csv", ".npy", ".imu", ".state", ".raw"};
  const std::string end = kEnds[bytes[0] % kEnds.size()];
  const NamedFile file(text_of(bytes.subspan(1)), end);
  return accepts([&] {
    if (end == ".imu") return expect_increasing(read_imu_log(file.path()));
    if (end == ".state") return expect_increasing(read_state_log(file.path()));
    read_events(file.path());
  });
}

}  // namespace dodgesim::fuzz
