#include "sim/recordings/event_reader.h"

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "sim/recordings/hdf5_event_reader.h"
#include "sim/recordings/npy_event_reader.h"
#include "sim/recordings/prophesee_reader.h"
#include "sim/recordings/raw_event.h"
#include "sim/recordings/text_columns.h"

namespace dodgesim {

namespace {

constexpr std::size_t kPortion = 1 << 14;  // events
constexpr std::size_t kCellsOfSize = 2;    // width and height, in a first line

// Whether one of the first events has a fraction in place of whole microseconds.
bool has_fractions(const std::string& path) {
  TextColumns file(path);
  const Column t = {"t", 0};
  for (std::size_t i = 0; i < kEventsThatTellUnit && file.next(); ++i) {
    if (file.cells() == kCellsOfSize) continue;
    const double stamp = file.number(t);
    if (stamp != std::floor(stamp)) return true;
  }
  return false;
}

// Lines of text, .txt and .csv.
class TextReader : public EventReader {
 public:
  TextReader(const std::string& path, const ImageSize& image, bool names_columns)
      : image_(image),
        may_be_size_(!names_columns),
        in_seconds_(!names_columns && has_fractions(path)),
        file_(path) {
    if (!names_columns) return;
    t_.name = "t_us";
    file_.read_names({"t_us", "x", "y", "p"});
    for (Column* column : {&t_, &x_, &y_, &p_}) *column = file_.column(column->name);
  }

  std::span<const Event> next() override {
    events_.clear();
    while (events_.size() < kPortion && file_.next()) {
      if (std::exchange(may_be_size_, false) && file_.cells() == kCellsOfSize) {
        expect_size();
        continue;
      }
      const RawEvent raw = {time_us(), file_.integer(x_), file_.integer(y_), file_.integer(p_)};
      events_.push_back(checked_event(raw, image_, [this] { return file_.place(); }));
    }
    return events_;
  }

  bool in_seconds() const override { return in_seconds_; }
  double part_read() const override { return share(file_.bytes_read(), file_.bytes()); }

 private:
  std::int64_t time_us() {
    if (!in_seconds_) return file_.integer(t_);
    const double t_s = file_.number(t_);
    if (std::abs(t_s) < 1e12) return std::llround(t_s * 1e6);
    file_.refuse(t_, "nearer to 0, as events of this file are in seconds");
  }

  void expect_size() const {
    const std::int64_t width = file_.integer({"width", 0}), height = file_.integer({"height", 1});
    if (width == image_.width && height == image_.height) return;
    throw ScenarioError(file_.place() + ": the image is " + std::to_string(width) + " x " +
                        std::to_string(height) + ", but the calibration says " +
                        std::to_string(image_.width) + " x " + std::to_string(image_.height) + ".");
  }

  ImageSize image_;
  bool may_be_size_;  // the next line
  bool in_seconds_;
  TextColumns file_;
  Column t_ = {"t", 0}, x_ = {"x", 1}, y_ = {"y", 2}, p_ = {"p", 3};
  std::vector<Event> events_;
};

}  // namespace

std::unique_ptr<EventReader> open_events(const std::string& path, const ImageSize& image) {
  const std::string end = std::filesystem::path(path).extension().string();
  if (end == ".txt") return std::make_unique<TextReader>(path, image, false);
  if (end == ".csv") return std::make_unique<TextReader>(path, image, true);
  if (end == ".npy") return open_npy_events(path, image);
  if (end == ".h5" || end == ".hdf5") return open_hdf5_events(path, image);
  if (end == ".raw") return open_prophesee_events(path, image);
  throw ScenarioError(path +
                      " must end in .h5 (or .hdf5), .npy, .txt, .csv or .raw, which decides on "
                      "the format of the events.");
}

}  // namespace dodgesim
