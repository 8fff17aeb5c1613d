// dodgesim emulate, against a plain event camera written here from the definition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "tests/cli/emulate_command.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::contents;
using dodgesim::testing::EmulateCommandTest;
using dodgesim::testing::Film;
using dodgesim::testing::kHeight;
using dodgesim::testing::kPixels;
using dodgesim::testing::kWidth;
using dodgesim::testing::npy_array;
using dodgesim::testing::Outcome;
using dodgesim::testing::put;
using dodgesim::testing::random_film;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

struct Event {
  double t_us = 0;
  int x = 0, y = 0, p = 0;
};
using EventsByPixel = std::map<std::pair<int, int>, std::vector<Event>>;  // (y, x)

// The same film as it would stand in a file of bytes. No pixel comes back to its first value, which
// is a whole number of thresholds from its reference: rounding would decide on that event.
std::vector<std::uint8_t> as_bytes(const Film& film) {
  std::vector<std::uint8_t> bytes;
  for (const float value : film.luminance) {
    const auto byte = static_cast<std::uint8_t>(std::min(254.0f, 100 * value));
    const std::size_t i = bytes.size();
    const bool comes_back = i >= kPixels && byte == bytes[i % kPixels];
    bytes.push_back(static_cast<std::uint8_t>(byte + (comes_back ? 1 : 0)));
  }
  return bytes;
}

// What the camera `ideal` is: an event at every crossing of reference +- 0.2, time by time, of
// frames whose values / white are luminance.
template <class T>
EventsByPixel reference_events(const std::vector<std::int64_t>& times, const std::vector<T>& values,
                               double white) {
  constexpr double kThreshold = 0.2;
  EventsByPixel events;
  const auto l = [&](std::size_t frame, std::size_t pixel) {
    return std::log(1e-3 + static_cast<double>(values[frame * kPixels + pixel]) / white);
  };
  for (std::size_t i = 0; i < kPixels; ++i) {
    const int x = static_cast<int>(i % kWidth);
    const int y = static_cast<int>(i / kWidth);
    double reference = l(0, i);
    for (std::size_t n = 1; n < times.size(); ++n) {
      const double l0 = l(n - 1, i), l1 = l(n, i);
      const auto t0 = static_cast<double>(times[n - 1] - times[0]);
      const auto t1 = static_cast<double>(times[n] - times[0]);
      const double sign = l1 > l0 ? 1 : -1;
      while (sign * (l1 - reference) >= kThreshold) {
        reference += sign * kThreshold;
        events[{y, x}].push_back(
            {t0 + (reference - l0) / (l1 - l0) * (t1 - t0), x, y, sign > 0 ? 1 : 0});
      }
    }
  }
  return events;
}

std::size_t count(const EventsByPixel& events) {
  std::size_t n = 0;
  for (const auto& [pixel, stream] : events) n += stream.size();
  return n;
}

class EmulateTest : public EmulateCommandTest {
 protected:
  // The camera makes these events of the files.
  void expect_events(const EventsByPixel& expected, const std::string& camera = "ideal",
                     double tolerance_us = 1) const {
    const Outcome outcome = emulate("--camera " + camera + " --out " + out_);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, StartsWith("events: " + std::to_string(count(expected)) + " ("));
    EventsByPixel seen;
    std::ifstream file(out_);
    std::int64_t t_us = 0, before_us = 0;
    std::int64_t on = 0, off = 0;
    for (Event event; file >> t_us >> event.x >> event.y >> event.p;) {
      EXPECT_GE(t_us, before_us) << "in order of time";
      before_us = t_us;
      event.t_us = static_cast<double>(t_us - film_.times.front());
      seen[{event.y, event.x}].push_back(event);
      ++(event.p == 1 ? on : off);
    }
    EXPECT_THAT(outcome.output,
                HasSubstr("(" + std::to_string(on) + " ON, " + std::to_string(off) + " OFF)\n"));
    ASSERT_EQ(count(seen), count(expected));
    for (const auto& [pixel, stream] : expected) {
      ASSERT_EQ(seen[pixel].size(), stream.size());
      for (std::size_t i = 0; i < stream.size(); ++i) {
        EXPECT_EQ(seen[pixel][i].p, stream[i].p);
        EXPECT_LE(std::abs(seen[pixel][i].t_us - stream[i].t_us), tolerance_us);
      }
    }
  }
};

TEST_F(EmulateTest, TheIdealCameraMakesExactlyTheCrossings) {
  const EventsByPixel expected = reference_events(film_.times, film_.luminance, 1);
  ASSERT_GT(count(expected), 5000u);
  expect_events(expected);
}

// A camera with noise, which does not come in a lifetime, sees pictures between frames that are a
// quarter of a second apart.
TEST_F(EmulateTest, PicturesBetweenFramesDoNotMoveTheCrossings) {
  Film slow = film_;
  for (std::int64_t& t_us : slow.times) t_us = film_.times[0] + 100 * (t_us - film_.times[0]);
  write(slow);
  put(root_ / "quiet.yaml", "preset: ideal\nshot_noise_on_hz: 1.0e-12\n");
  expect_events(reference_events(slow.times, slow.luminance, 1), (root_ / "quiet.yaml").string(),
                3);  // the pictures' luminance is of single precision
}

TEST_F(EmulateTest, BytesAreSharesOf255) {
  const std::vector<std::uint8_t> bytes = as_bytes(film_);
  put(root_ / "f.npy", npy_array("|u1", bytes, kHeight, kWidth));
  const EventsByPixel expected = reference_events(film_.times, bytes, 255);
  ASSERT_GT(count(expected), 4000u);
  expect_events(expected);
}

TEST_F(EmulateTest, SaysHowFastTheEmulationIsBesideTheLogarithm) {
  const Outcome outcome = ideal();
  const std::string number = "[0-9]+(\\.[0-9]+)?";
  EXPECT_THAT(outcome.output, MatchesRegex("events: [0-9]+ \\([0-9]+ ON, [0-9]+ OFF\\)\n"
                                           "video: 100 frames of 19 x 7 px, " +
                                           number +
                                           " s\n"
                                           "emulation: " +
                                           number + " frames/s, " + number +
                                           " Mev/s\n"
                                           "cv::log: " +
                                           number +
                                           " frames/s\n"
                                           "emulation takes " +
                                           number + " of the time of cv::log\n"))
      << outcome.output;
}

TEST_F(EmulateTest, AsksWhetherUnitsAreMeantThatAreUnusual) {
  Film film = film_;
  for (float& value : film.luminance) value = 255 * std::min(value, 1.0f);
  write(film);
  EXPECT_THAT(ideal().output, HasSubstr(" lux on white: is its scale 0 to 255 instead of 0 to 1?"));
  const std::pair<std::int64_t, std::string> intervals[] = {
      {1, "1"}, {40, "40"}, {3333, ""}, {33333333, "3.33e+07"}};  // s, ms, us, ns
  for (const auto& [interval, shown] : intervals) {
    film = film_;
    for (std::size_t n = 0; n < film.times.size(); ++n) {
      film.times[n] = interval * static_cast<std::int64_t>(n);
    }
    write(film);
    const std::string question = "us apart: are all times in microseconds?";
    if (shown.empty()) {
      EXPECT_THAT(ideal().output, Not(HasSubstr(question)));
    } else {
      EXPECT_THAT(ideal().output, HasSubstr("The frames are " + shown + " " + question));
    }
  }
}

TEST_F(EmulateTest, EventsDoNotDependOnTheOriginOfTime) {
  for (const std::int64_t start_us : {std::int64_t{0}, std::int64_t{-5000}}) {
    const Film shifted = random_film(100, start_us);
    write(film_);
    ASSERT_EQ(emulate("--camera sees1 --out " + (root_ / "a.txt").string()).exit_code, 0);
    write(shifted);
    ASSERT_EQ(emulate("--camera sees1 --out " + (root_ / "b.txt").string()).exit_code, 0);
    std::ifstream a(root_ / "a.txt"), b(root_ / "b.txt");
    std::int64_t ta = 0, tb = 0;
    std::string rest_a, rest_b;
    while (a >> ta) {
      std::getline(a, rest_a);
      b >> tb;
      std::getline(b, rest_b);
      ASSERT_EQ(ta - film_.times.front(), tb - start_us);
      ASSERT_EQ(rest_a, rest_b);
    }
    EXPECT_FALSE(b >> tb);
  }
}

TEST_F(EmulateTest, TheSeedDecidesOnNoiseAndMismatchAlone) {
  const auto events = [this](const std::string& options) {
    EXPECT_EQ(emulate(options + " --out " + out_).exit_code, 0) << options;
    return contents(out_);
  };
  const std::string sees1 = events("--camera sees1 --seed 1");
  EXPECT_EQ(events("--camera sees1"), sees1);
  EXPECT_NE(events("--camera sees1 --seed 2"), sees1);
  EXPECT_EQ(events("--camera sees1 --clip 0"), sees1);
  EXPECT_NE(events("--camera sees1 --clip 1"), sees1);
  EXPECT_EQ(events("--camera ideal --seed 1"), events("--camera ideal --seed 2"));
  EXPECT_EQ(emulate("--camera ideal --seed -1 --out " + out_).exit_code, 2);
}

TEST_F(EmulateTest, ReadsACameraFromAFile) {
  const auto events = [this](const std::string& camera) {
    const Outcome outcome = emulate("--camera " + camera + " --out " + out_);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return contents(out_);
  };
  for (const std::string preset : {"sees1", "ideal", "noisy", "low_light"}) {
    EXPECT_EQ(events(put(root_ / "camera.yaml", "preset: " + preset + "\n")), events(preset));
  }
  EXPECT_EQ(events(put(root_ / "camera.yaml", "refractory_us: 100\n")), events("sees1"))
      << "the default";
  EXPECT_EQ(events(put(root_ / "camera.yaml", "log_epsilon: 0.01\npreset: ideal\n")),
            events(put(root_ / "other.yaml", "preset: ideal\nlog_epsilon: 0.01\n")));
  std::set<std::string> different;
  for (const std::string preset : {"sees1", "ideal", "noisy", "low_light"}) {
    different.insert(events(preset));
  }
  EXPECT_EQ(different.size(), 4u);
}

TEST_F(EmulateTest, ARecordingEndsWithItsLastFrame) {
  // What is still on its way from the pixel to its time stamp is not in it.
  constexpr std::int64_t kLatencyUs = 5000;
  ASSERT_EQ(ideal().exit_code, 0);
  std::istringstream all(contents(out_));
  std::string expected, rest;
  for (std::int64_t t_us = 0; all >> t_us && std::getline(all, rest);) {
    if (t_us + kLatencyUs > film_.times.back()) continue;
    expected += std::to_string(t_us + kLatencyUs) + rest + "\n";
  }
  const std::string late = put(root_ / "late.yaml", "preset: ideal\nlatency_us: 5000\n");
  ASSERT_EQ(emulate("--camera " + late + " --out " + out_).exit_code, 0);
  EXPECT_TRUE(contents(out_) == expected);
}

TEST_F(EmulateTest, ReportsEventsThatTheReadoutLoses) {
  const auto summary = [this](const std::string& readout_max_hz) {
    const std::string camera =
        put(root_ / "camera.yaml", "preset: ideal\nreadout_max_hz: " + readout_max_hz + "\n");
    const Outcome outcome = emulate("--camera " + camera + " --out " + out_);
    EXPECT_EQ(outcome.exit_code, 0);
    return outcome.output;
  };
  EXPECT_THAT(summary("0"), Not(HasSubstr("lost")));
  EXPECT_THAT(summary("1e4"), ContainsRegex("lost: [1-9][0-9]* events, because readout_max_hz "));
}

// The number behind `label` in a summary; 0 if it is not there.
long count_after(const std::string& summary, const std::string& label) {
  const std::size_t at = summary.find(label);
  return at == std::string::npos ? 0 : std::stol(summary.substr(at + label.size()));
}

TEST_F(EmulateTest, EveryEventIsWrittenLostOrNotYetOut) {
  const long all = count_after(ideal().output, "events: ");
  for (const char* readout_max_hz : {"1e4", "1e5", "3e5"}) {
    const std::string camera =
        put(root_ / "camera.yaml",
            std::string("preset: ideal\nreadout_max_hz: ") + readout_max_hz + "\n");
    const std::string summary = emulate("--camera " + camera + " --out " + out_).output;
    EXPECT_EQ(count_after(summary, "events: ") + count_after(summary, "lost: ") +
                  count_after(summary, "not yet out at the end: "),
              all)
        << summary;
  }
  EXPECT_GT(all, 1000);
}

TEST_F(EmulateTest, SaysWhyEventsHappened) {
  const std::string camera =
      put(root_ / "camera.yaml",
          "leak_hz: 100\nshot_noise_on_hz: 200\nhot_pixel_fraction: 0.2\nhot_pixel_hz: 1000\n");
  const auto written = [&](const std::string& options, const std::string& file) {
    const std::string out = (root_ / file).string();
    const Outcome outcome = emulate("--camera " + options + " --out " + out);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("video: 100 frames of 19 x 7 px"));
    return contents(out);
  };
  std::istringstream with(written(camera + " --causes", "with.txt"));
  std::istringstream without(written(camera, "without.txt"));
  std::map<int, int> causes;
  std::string bytes;
  for (std::string line, expected; std::getline(with, line);) {
    const std::size_t last = line.rfind(' ');
    ASSERT_TRUE(std::getline(without, expected));
    ASSERT_EQ(line.substr(0, last), expected);
    const int cause = std::stoi(line.substr(last));
    ++causes[cause];
    bytes += static_cast<char>(cause);
  }
  EXPECT_FALSE(std::getline(without, out_));
  for (const int cause : {0, 253, 254, 255}) EXPECT_GT(causes[cause], 100) << cause;
  EXPECT_EQ(causes.size(), 4u);

  const std::string npy = written(camera + " --causes", "with.npy");
  EXPECT_THAT(npy, HasSubstr("('cause', '|u1')"));
  constexpr std::size_t kRecord = 14;
  const std::size_t front = npy.size() - kRecord * bytes.size();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    ASSERT_EQ(npy.at(front + kRecord * i + kRecord - 1), bytes[i]) << i;
  }
  EXPECT_THAT(written(camera, "without.npy"), Not(HasSubstr("cause")));
  EXPECT_THAT(written(camera + " --causes", "with.h5"), HasSubstr("cause"));
  EXPECT_THAT(written(camera, "without.h5"), Not(HasSubstr("cause")));

  std::istringstream ideal(written("ideal --causes", "ideal.txt"));
  for (std::string line; std::getline(ideal, line);) ASSERT_THAT(line, EndsWith(" 0"));
  EXPECT_THAT(dodgesim::testing::dodgesim("emulate --help").output,
              AllOf(HasSubstr("--causes"), HasSubstr("253 the leak"), HasSubstr("events/cause")));
}

// Half a threshold up makes an ON event where the reference starts in the lower half, and a
// threshold down makes no OFF event where it starts below.
TEST_F(EmulateTest, AnyLeakPutsTheFirstReferencesAnywhereUpToAThresholdBelowTheFirstFrame) {
  const auto events = [this](double step, const std::string& leak_hz) {
    std::vector<float> luminance(2 * kPixels, 0.5f);
    std::fill(luminance.begin() + kPixels, luminance.end(),
              static_cast<float>(0.501 * std::exp(step) - 0.001));
    put(root_ / "f.npy", npy_array("<f4", luminance, kHeight, kWidth));
    put(root_ / "t.npy", npy_array("<i8", std::vector<std::int64_t>{0, 1000}));
    const std::string camera =
        put(root_ / "camera.yaml", "preset: ideal\nleak_hz: " + leak_hz + "\n");
    EXPECT_EQ(emulate("--camera " + camera + " --out " + out_).exit_code, 0);
    const std::string text = contents(out_);
    return std::count(text.begin(), text.end(), '\n');
  };
  constexpr auto kAll = static_cast<double>(kPixels);
  EXPECT_EQ(events(0.1, "0"), 0);
  EXPECT_NEAR(static_cast<double>(events(0.1, "1e-6")), 0.5 * kAll, 0.15 * kAll);
  EXPECT_EQ(events(-0.21, "0"), kPixels);
  EXPECT_LT(static_cast<double>(events(-0.21, "1e-6")), 0.15 * kAll);
  for (const char* text : {"emulate --help", "explain sensors.events.leak_hz"}) {
    EXPECT_THAT(dodgesim::testing::dodgesim(text).output, HasSubstr("random share")) << text;
  }
}

TEST_F(EmulateTest, WritesValidFilesWithoutEvents) {
  put(root_ / "f.npy", npy_array("<f4", std::vector<float>(3 * kPixels, 0.5f), kHeight, kWidth));
  put(root_ / "t.npy", npy_array("<i8", std::vector<std::int64_t>{1, 1001, 2001}));
  for (const std::string end : {".h5", ".npy", ".txt"}) {
    const fs::path out = root_ / ("none" + end);
    const Outcome outcome = emulate("--camera ideal --out " + out.string());
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.output, StartsWith("events: 0 (0 ON, 0 OFF)\n"));
    EXPECT_TRUE(fs::exists(out)) << end;
  }
}

TEST_F(EmulateTest, TakesPicturesOfAnyShape) {
  for (const auto& [height, width] :
       {std::pair<std::uint64_t, std::uint64_t>{1, 1}, {1, 3000}, {3000, 1}, {720, 1280}}) {
    std::vector<std::uint8_t> bytes(2 * height * width, 20);
    bytes.back() = 200;
    put(root_ / "f.npy", npy_array("|u1", bytes, height, width));
    put(root_ / "t.npy", npy_array("<i8", std::vector<std::int64_t>{0, 1073741823}));
    ASSERT_EQ(ideal().exit_code, 0);
    const std::string events = contents(out_);
    EXPECT_EQ(std::count(events.begin(), events.end(), '\n'), 11)
        << "ln((1e-3 + 200/255) / (1e-3 + 20/255)) / 0.2 is 11.4";
    EXPECT_THAT(events,
                EndsWith(std::to_string(width - 1) + " " + std::to_string(height - 1) + " 1\n"));
  }
}

}  // namespace
