#include "sim/events/event_camera.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/events/logarithm.h"

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr double kArmed = -std::numeric_limits<double>::infinity();
constexpr int kMaxSide = 65536;  // coordinates are 16 bits

// The bounds of the quick test are rounded to float; this keeps them on the safe side.
constexpr double kBoundMargin = 1e-6;

// Sortable word of an event: time since the last sample (31 bits), y, x (16 bits each), polarity.
constexpr int kTimeShift = 33;
constexpr int kRowShift = 17;
constexpr int kColumnShift = 1;
constexpr TimeUs kMaxIntervalUs = (TimeUs{1} << (64 - kTimeShift)) - 1;

std::string named(std::string_view camera, const char* what) {
  return std::string(camera) + "/" + what;
}

double share(double part, double other) { return part + other > 0 ? part / (part + other) : 0.5; }

// The random properties of one pixel of the device.
struct Draw {
  double on, off;  // standard normal
  double hot;      // uniform in (0, 1)
};

Draw draw_pixel(const RandomStream& device, std::uint32_t index) {
  const auto random = device.block(index);
  return {normal_quantile(unit_interval(random[0])), normal_quantile(unit_interval(random[1])),
          unit_interval(random[2])};
}

std::vector<std::uint32_t> draw_hot_pixels(const RandomStream& device, std::uint32_t count,
                                           double fraction) {
  std::vector<std::uint32_t> hot;
  if (fraction <= 0) return hot;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (draw_pixel(device, i).hot < fraction) hot.push_back(i);
  }
  return hot;
}

std::uint32_t checked_count(int width, int height) {
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    throw std::invalid_argument("An event camera has 1 to 65536 columns and rows.");
  }
  return static_cast<std::uint32_t>(width) * static_cast<std::uint32_t>(height);
}

float checked(float luminance) {
  if (!(luminance >= 0 && luminance <= std::numeric_limits<float>::max())) {
    throw SimulationError("An event camera was shown a luminance of " + std::to_string(luminance) +
                          "; it must be finite and not negative.");
  }
  return luminance;
}

}  // namespace

EventCamera::EventCamera(const EventCameraSpec& spec, int width, int height, std::uint64_t seed,
                         std::uint64_t throw_index, std::string_view name)
    : spec_(spec),
      refractory_us_(static_cast<double>(spec.refractory_us)),
      width_(width),
      height_(height),
      pixels_(checked_count(width, height)),
      background_(RandomStream(seed, throw_index, named(name, "background")),
                  checked_count(width, height), spec.background_on_hz + spec.background_off_hz,
                  share(spec.background_on_hz, spec.background_off_hz)),
      hot_pixels_(RandomStream(seed, throw_index, named(name, "hot")),
                  draw_hot_pixels(RandomStream(seed, 0, named(name, "device")),
                                  checked_count(width, height), spec.hot_pixel_fraction),
                  spec.hot_pixel_hz, share(spec.background_on_hz, spec.background_off_hz)),
      low_(pixels_.size()),
      high_(pixels_.size()),
      previous_(pixels_.size()),
      row_flags_((static_cast<std::size_t>(width) + 7) / 8 * 8) {
  candidates_.reserve(static_cast<std::size_t>(width));
  const RandomStream device(seed, 0, named(name, "device"));
  for (std::uint32_t i = 0; i < pixels_.size(); ++i) {
    Pixel& pixel = pixels_[i];
    pixel.threshold_on = spec.contrast_threshold_on;
    pixel.threshold_off = spec.contrast_threshold_off;
    if (spec.mismatch_sigma > 0) {
      const Draw draw = draw_pixel(device, i);
      pixel.threshold_on += spec.mismatch_sigma * draw.on;
      pixel.threshold_off += spec.mismatch_sigma * draw.off;
    }
    pixel.threshold_on = std::max(pixel.threshold_on, spec.threshold_min);
    pixel.threshold_off = std::max(pixel.threshold_off, spec.threshold_min);
  }
}

void EventCamera::reset(TimeUs t_us, const float* luminance) {
  t_us_ = t_us;
  std::copy_n(luminance, pixels_.size(), previous_.begin());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i].reference = log_luminance(checked(luminance[i]));
    pixels_[i].held_until_us = kArmed;
    set_bounds(i);
  }
  background_.reset(t_us);
  hot_pixels_.reset(t_us);
  patches_.clear();
  patch_luminance_.clear();
}

void EventCamera::add_region(TimeUs t_us, const Rect& region, const float* luminance) {
  if (t_us <= (patches_.empty() ? t_us_ : patches_.back().t_us)) {
    throw std::invalid_argument("The samples of an event camera must follow each other in time.");
  }
  if (region.empty()) return;
  if (region.x0 < 0 || region.y0 < 0 || region.x1 > width_ || region.y1 > height_) {
    throw std::invalid_argument("A region of an event camera's picture must lie in the picture.");
  }
  patches_.push_back({t_us, region, patch_luminance_.size()});
  for (std::ptrdiff_t y = region.y0; y < region.y1; ++y) {
    const float* const row = luminance + y * width_;
    patch_luminance_.insert(patch_luminance_.end(), row + region.x0, row + region.x1);
  }
}

void EventCamera::update(TimeUs t_us, const float* luminance, std::vector<Event>& out) {
  if (t_us <= (patches_.empty() ? t_us_ : patches_.back().t_us) || t_us - t_us_ > kMaxIntervalUs) {
    throw std::invalid_argument("The samples of an event camera must follow each other in time.");
  }
  noise_.clear();
  background_.take_until(t_us, noise_);
  hot_pixels_.take_until(t_us, noise_);
  std::sort(noise_.begin(), noise_.end(), [](const BackgroundEvent& a, const BackgroundEvent& b) {
    if (a.pixel != b.pixel) return a.pixel < b.pixel;
    return a.t_us != b.t_us ? a.t_us < b.t_us : a.on < b.on;
  });
  next_noise_ = 0;
  keys_.clear();
  for (int y = 0; y < height_; ++y) update_row(y, t_us, luminance);

  sort_events();
  for (const std::uint64_t key : keys_) {
    out.push_back({t_us_ + static_cast<TimeUs>(key >> kTimeShift),
                   static_cast<std::uint16_t>(key >> kColumnShift),
                   static_cast<std::uint16_t>(key >> kRowShift),
                   static_cast<std::int8_t>((key & 1) != 0 ? 1 : -1)});
  }
  t_us_ = t_us;
  patches_.clear();
  patch_luminance_.clear();
}

void EventCamera::update_row(int y, TimeUs t_us, const float* luminance) {
  const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
  const float* const now = luminance + begin;
  row_patches_.clear();
  for (const Patch& patch : patches_) {
    if (y >= patch.rect.y0 && y < patch.rect.y1) row_patches_.push_back(&patch);
  }
  find_candidates(begin, y, now);
  knots_.clear();
  for (Candidate& candidate : candidates_) add_knots(begin, y, t_us, now, candidate);
  for (const Candidate& candidate : candidates_) update_pixel(begin + candidate.x, y, candidate);
  std::copy_n(now, width_, previous_.begin() + static_cast<std::ptrdiff_t>(begin));
}

// Lists the pixels of the row that start at `begin` whose luminance left its bounds or that have a
// background event.
void EventCamera::find_candidates(std::size_t begin, int y, const float* now) {
  const auto width = static_cast<std::size_t>(width_);
  const float* const low = low_.data() + begin;
  const float* const high = high_.data() + begin;
  std::uint8_t* const flags = row_flags_.data();
  // Written so that a luminance that is not a number becomes a candidate, too.
  for (std::size_t x = 0; x < width; ++x) {
    flags[x] = static_cast<std::uint8_t>(!((now[x] > low[x]) & (now[x] < high[x])));
  }
  flag_patches(begin, y);
  for (std::size_t n = next_noise_; n < noise_.size() && noise_[n].pixel < begin + width; ++n) {
    flags[noise_[n].pixel - begin] = 1;
  }
  candidates_.clear();
  for (std::size_t word = 0; word < row_flags_.size(); word += 8) {
    std::uint64_t any = 0;
    std::memcpy(&any, flags + word, sizeof any);
    // Eight flags at once, each 0 or 1; the lowest byte is the leftmost pixel.
    for (; any != 0; any &= any - 1) {
      const std::size_t x = word + static_cast<std::size_t>(std::countr_zero(any)) / 8;
      candidates_.push_back({static_cast<std::uint32_t>(x), 0, 0});
      __builtin_prefetch(&pixels_[begin + x], 1);
    }
  }
}

// Marks the pixels of the row that left their bounds in one of the regions.
void EventCamera::flag_patches(std::size_t begin, int y) {
  for (const Patch* patch : row_patches_) {
    const auto x0 = static_cast<std::size_t>(patch->rect.x0);
    const auto width = static_cast<std::size_t>(patch->rect.x1) - x0;
    const float* const luminance = row_of(*patch, y);
    const float* const low = low_.data() + begin + x0;
    const float* const high = high_.data() + begin + x0;
    std::uint8_t* const flags = row_flags_.data() + x0;
    for (std::size_t x = 0; x < width; ++x) {
      flags[x] |= static_cast<std::uint8_t>(!((luminance[x] > low[x]) & (luminance[x] < high[x])));
    }
  }
}

// Lists what the samples since the last picture show at a pixel.
void EventCamera::add_knots(std::size_t begin, int y, TimeUs t_us, const float* now,
                            Candidate& candidate) {
  candidate.first_knot = knots_.size();
  knots_.push_back({t_us_, log_luminance(previous_[begin + candidate.x])});
  const int x = static_cast<int>(candidate.x);
  for (const Patch* patch : row_patches_) {
    if (x < patch->rect.x0 || x >= patch->rect.x1) continue;
    knots_.push_back({patch->t_us, log_luminance(checked(row_of(*patch, y)[x - patch->rect.x0]))});
  }
  knots_.push_back({t_us, log_luminance(checked(now[candidate.x]))});
  candidate.end_knot = knots_.size();
}

const float* EventCamera::row_of(const Patch& patch, int y) const {
  const std::ptrdiff_t width = patch.rect.x1 - patch.rect.x0;
  return patch_luminance_.data() + patch.first + (y - patch.rect.y0) * width;
}

void EventCamera::update_pixel(std::size_t index, int y, const Candidate& candidate) {
  Pixel& pixel = pixels_[index];
  const std::uint64_t address = static_cast<std::uint64_t>(y) << kRowShift |
                                static_cast<std::uint64_t>(candidate.x) << kColumnShift;
  for (std::size_t k = candidate.first_knot + 1; k < candidate.end_knot; ++k) {
    const Knot& a = knots_[k - 1];
    const Knot& b = knots_[k];
    const Line line = {static_cast<double>(a.t_us), static_cast<double>(b.t_us), a.l, b.l};
    for (; next_noise_ < noise_.size() && noise_[next_noise_].pixel == index &&
           noise_[next_noise_].t_us <= b.t_us;
         ++next_noise_) {
      const BackgroundEvent& event = noise_[next_noise_];
      fire_crossings(pixel, line, event.t_us, address);
      if (pixel.held_until_us != kArmed) continue;
      const auto t = static_cast<double>(event.t_us);
      emit(event.t_us, address, event.on);
      pixel.reference = line.at(t);
      if (refractory_us_ > 0) pixel.held_until_us = t + refractory_us_;
    }
    fire_crossings(pixel, line, b.t_us, address);
  }
  set_bounds(index);
}

// Moves the pixel along the line up to until_us, which must not go back from call to call.
void EventCamera::fire_crossings(Pixel& pixel, const Line& line, TimeUs until_us,
                                 std::uint64_t address) {
  const auto until = static_cast<double>(until_us);
  const double l_until = line.at(until);
  const bool on = line.l1 > line.l0;
  const double change = on ? pixel.threshold_on : -pixel.threshold_off;
  while (true) {
    if (pixel.held_until_us != kArmed) {
      if (pixel.held_until_us > until) return;
      pixel.reference = line.at(pixel.held_until_us);
      pixel.held_until_us = kArmed;
    }
    const double level = pixel.reference + change;
    if (on ? l_until < level : l_until > level) return;
    pixel.reference = level;
    const double crossing = line.time_of(level);
    // The stamp is rounded to the clock (halves of a microsecond are counted and halved) and kept
    // in (t0, until].
    const auto t0_us = static_cast<TimeUs>(line.t0_us);
    const TimeUs t_us = t0_us + (static_cast<TimeUs>(2 * (crossing - line.t0_us)) + 1) / 2;
    emit(std::clamp(t_us, t0_us + 1, until_us), address, on);
    if (refractory_us_ > 0) pixel.held_until_us = crossing + refractory_us_;
  }
}

void EventCamera::emit(TimeUs t_us, std::uint64_t address, bool on) {
  const auto dt = static_cast<std::uint64_t>(t_us - t_us_);
  keys_.push_back(dt << kTimeShift | address | static_cast<std::uint64_t>(on));
  // Of two events of a pixel in the same microsecond the OFF event goes first.
  for (std::size_t i = keys_.size() - 1; i > 0 && keys_[i - 1] == (keys_[i] | 1) && !on; --i) {
    std::swap(keys_[i - 1], keys_[i]);
  }
}

void EventCamera::rebase(const float* luminance) {
  if (!patches_.empty()) {
    throw std::invalid_argument("An event camera is rebased at the instant of a whole picture.");
  }
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (luminance[i] == previous_[i]) continue;
    pixels_[i].reference += log_luminance(checked(luminance[i])) - log_luminance(previous_[i]);
    previous_[i] = luminance[i];
    set_bounds(i);
  }
}

void EventCamera::set_bounds(std::size_t index) {
  const Pixel& pixel = pixels_[index];
  if (pixel.held_until_us != kArmed) {
    low_[index] = std::numeric_limits<float>::infinity();
    high_[index] = -std::numeric_limits<float>::infinity();
    return;
  }
  const double low = std::exp(pixel.reference - pixel.threshold_off);
  const double high = std::exp(pixel.reference + pixel.threshold_on);
  low_[index] = static_cast<float>(low * (1 + kBoundMargin) - spec_.log_epsilon);
  high_[index] = static_cast<float>(high * (1 - kBoundMargin) - spec_.log_epsilon);
}

// keys_ come in (y, x) order: a stable radix sort on the time gives (t, y, x, polarity).
void EventCamera::sort_events() {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kFew = 128;  // below, comparing is cheaper than counting
  if (keys_.size() < kFew) {
    std::sort(keys_.begin(), keys_.end());
    return;
  }
  std::uint64_t latest = 0;
  for (const std::uint64_t key : keys_) latest = std::max(latest, key >> kTimeShift);
  sorted_keys_.resize(keys_.size());
  for (int shift = 0; latest >> shift != 0; shift += kDigitBits) {
    const auto digit = [shift](std::uint64_t key) {
      return key >> (kTimeShift + shift) & ((1u << kDigitBits) - 1);
    };
    std::array<std::uint32_t, 1u << kDigitBits> position{};
    for (const std::uint64_t key : keys_) ++position[digit(key)];
    std::uint32_t sum = 0;
    for (std::uint32_t& p : position) sum += std::exchange(p, sum);
    for (const std::uint64_t key : keys_) sorted_keys_[position[digit(key)]++] = key;
    std::swap(keys_, sorted_keys_);
  }
}

double EventCamera::Line::at(double t_us) const {
  if (t_us >= t1_us) return l1;
  return l0 + (l1 - l0) * (t_us - t0_us) / (t1_us - t0_us);
}

double EventCamera::Line::time_of(double l) const {
  return t0_us + (l - l0) * (t1_us - t0_us) / (l1 - l0);
}

double EventCamera::log_luminance(float luminance) const {
  return natural_log(spec_.log_epsilon + static_cast<double>(luminance));
}

PixelState EventCamera::pixel(int x, int y) const {
  const std::size_t index =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  const Pixel& pixel = pixels_[index];
  return {log_luminance(previous_[index]), pixel.reference, pixel.threshold_on, pixel.threshold_off,
          pixel.held_until_us != kArmed};
}

}  // namespace dodgesim
