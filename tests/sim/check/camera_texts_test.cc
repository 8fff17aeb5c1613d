// What the texts of the event camera's keys say of their values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <map>
#include <numbers>
#include <string>

#include "sim/events/photoreceptor.h"
#include "sim/events/spec.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

// Collects the numbers and the texts.
struct Keys {
  void operator()(const char* name, const std::string&, std::initializer_list<const char*>,
                  const char* text) {
    texts[name] = text;
  }
  template <class T, class Least, class Most>
  void operator()(const char* name, const T& value, Least, Most, const char* text) {
    values[name] = static_cast<double>(value);
    texts[name] = text;
  }
  std::map<std::string, double> values;
  std::map<std::string, std::string> texts;
};

Keys keys_of(const std::string& preset) {
  EventCameraSpec spec = event_camera_preset(preset);
  Keys keys;
  spec.visit(keys);
  return keys;
}

TEST(CameraTexts, OfThePresetNameEachValueThatIsNotTheDefault) {
  const Keys defaults = keys_of("sees1");
  const std::string& text = defaults.texts.at("preset");
  const std::size_t ideal = text.find(" ideal: "), low_light = text.find(" low_light: "),
                    noisy = text.find(" noisy, ");
  ASSERT_LT(ideal, low_light);
  ASSERT_LT(low_light, noisy);
  ASSERT_NE(noisy, std::string::npos);
  const std::map<std::string, std::string> parts = {
      {"ideal", text.substr(ideal, low_light - ideal)},
      {"low_light", text.substr(low_light, noisy - low_light)},
      {"noisy", text.substr(noisy)}};
  for (const auto& [preset, part] : parts) {
    for (const auto& [key, value] : keys_of(preset).values) {
      const std::size_t at = part.find(" " + key + " ");
      EXPECT_EQ(at != std::string::npos, value != defaults.values.at(key)) << preset << " " << key;
      if (at == std::string::npos) continue;
      EXPECT_EQ(std::stod(part.substr(at + key.size() + 2)), value) << preset << " " << key;
    }
    EXPECT_EQ(part.find("assumed") != std::string::npos, preset != "ideal");
  }
}

TEST(CameraTexts, OfTheBandwidthSayThatTheDarksIsAdded) {
  const EventCameraSpec spec;
  const double white = 1000 / spec.illuminance_lux;
  EXPECT_NEAR(Photoreceptor(spec).cutoff_rad_s(white) / (2 * std::numbers::pi),
              spec.photoreceptor_hz + spec.photoreceptor_dark_hz, 1e-6);
  EXPECT_THAT(keys_of("sees1").texts.at("photoreceptor_hz"),
              HasSubstr("photoreceptor_dark_hz is added"));
}

TEST(CameraTexts, OfTheLightSayWhatIsNotModelled) {
  EXPECT_THAT(keys_of("sees1").texts.at("illuminance_lux"),
              HasSubstr("results below some lux mean little"));
}

}  // namespace
}  // namespace dodgesim
