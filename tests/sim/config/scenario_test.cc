#include "sim/config/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "sim/base/error.h"
#include "sim/config/closest_name.h"
#include "tests/complaint.h"
#include "tests/sim/config/parse.h"

namespace dodgesim {
namespace {

TEST(Scenario, GivenValuesAreReadAndOthersKeepTheirDefaults) {
  const Scenario scenario = parse(
      "seed: 18446744073709551615\nfly_oracle: false\nroom: field\n"
      "mission: {type: goal, goal_m: [4, 0, +2.5e0], speed_mps: .5}\n"
      "delays: {compute_us: 60000}\nthrow: {size_m: 1e-2}\n");
  EXPECT_EQ(scenario.seed, 18446744073709551615u);
  EXPECT_FALSE(scenario.fly_oracle);
  EXPECT_EQ(scenario.room, "field");
  EXPECT_EQ(scenario.mission.goal_m, Eigen::Vector3d(4, 0, 2.5));
  EXPECT_EQ(scenario.mission.speed_mps, 0.5);
  EXPECT_EQ(scenario.delays.compute_us, 60000);
  EXPECT_EQ(scenario.throw_spec->size_m, Distribution::constant(0.01));
  EXPECT_EQ(scenario.name, "test");
  EXPECT_EQ(scenario.vehicle, Scenario{}.vehicle);
  EXPECT_EQ(scenario.delays.command_us, DelaySpec{}.command_us);
}

TEST(Scenario, KeysOfTheEventCameraChangeItsPreset) {
  const auto events = [](const std::string& keys) {
    return parse("sensors: {events: {" + keys + "}}\n").sensors.events;
  };
  // Whatever comes first.
  for (const char* keys : {"leak_hz: 3, preset: ideal", "preset: ideal, leak_hz: 3"}) {
    EXPECT_EQ(events(keys).leak_hz, 3);
    EXPECT_EQ(events(keys).latency_us, 0);
    EXPECT_EQ(events(keys).photoreceptor_hz, 0);
  }
  EXPECT_EQ(events("leak_hz: 3").latency_us, EventCameraSpec{}.latency_us);
  EXPECT_LT(events("preset: low_light").illuminance_lux, 10);
  const Scenario noisy = parse("sensors: {events: {preset: noisy, jitter_us: 7}}\n");
  const Scenario again = parse(to_yaml(noisy));
  EXPECT_EQ(again.sensors.events.jitter_us, 7);
  EXPECT_EQ(again.sensors.events.refractory_us, 500);
  EXPECT_EQ(to_yaml(again), to_yaml(noisy));
}

TEST(Scenario, WithoutTheKeyThrowNobodyThrows) {
  EXPECT_FALSE(parse("seed: 1\n").throw_spec.has_value());
  EXPECT_TRUE(parse("throw: {}\n").throw_spec.has_value());
}

TEST(Scenario, EventsMayComeLaterThanTheWindowIfTheTimeoutOrThePilotWaits) {
  const std::string late = "delays: {transport_us: 90000}\n";
  EXPECT_THROW(parse(late), ScenarioError);
  EXPECT_THROW(parse("pilot: dodgesim\n" + late), ScenarioError);
  EXPECT_NO_THROW(parse("dodger: {window: {event_timeout_us: 90000}}\n" + late));
  EXPECT_NO_THROW(parse("pilot: plugin\n" + late));
  EXPECT_NO_THROW(parse("pilot: oracle\n" + late));

  const std::string lower = "delays: {lower_camera_us: 12000}\n";
  EXPECT_THROW(parse(lower), ScenarioError);
  EXPECT_NO_THROW(parse("dodger: {window: {camera_lag_us: 3000}}\n" + lower));
  EXPECT_NO_THROW(parse("dodger: {position: {depth: mono}}\n" + lower));
  EXPECT_NO_THROW(parse("pilot: oracle\n" + lower));
}

TEST(Scenario, DistributionsAreRead) {
  const Scenario scenario = parse(
      "throw:\n"
      "  object: !choice [ball, box]\n"
      "  size_m: !choice [0.1, 0.2]\n"
      "  speed_mps: !uniform [3, 8]\n"
      "  distance_m: !normal {mean: 3, sd: 0.5}\n"
      "  bearing_deg: !normal {mean: 180, sd: 10, min: 150, max: 210}\n"
      "  aim_offset_m: !uniform [-0.1, 0.1]\n"
      "  spin_radps: [0, !uniform [0, 5], 1]\n");
  const ThrowSpec& spec = *scenario.throw_spec;
  EXPECT_EQ(spec.object.names, (std::vector<std::string>{"ball", "box"}));
  EXPECT_EQ(spec.size_m, Distribution::choice({0.1, 0.2}));
  EXPECT_EQ(spec.speed_mps, Distribution::uniform(3, 8));
  EXPECT_EQ(spec.distance_m, Distribution::normal(3, 0.5, 0.5, 20)) << "cut at the key's limits";
  EXPECT_EQ(spec.bearing_deg, Distribution::normal(180, 10, 150, 210));
  ASSERT_EQ(spec.aim_offset_m.parts.size(), 1u);
  EXPECT_EQ(spec.aim_offset_m.part(1), Distribution::uniform(-0.1, 0.1));
  ASSERT_EQ(spec.spin_radps.parts.size(), 3u);
  EXPECT_EQ(spec.spin_radps.part(1), Distribution::uniform(0, 5));
}

TEST(Scenario, TheResolvedScenarioReadsBackEqualToTheLastBit) {
  const std::string yaml =
      "name: \"a \\\"quoted\\\" title: # with \\\\ and \xc3\xa4\"\n"
      "description: |\n  several\n\n  lines\nseed: 12345678901234567890\nafter_s: "
      "0.30000000000000004\n"
      "mission: {type: goal, goal_m: [0.1, 1e-17, -3.3333333333333335]}\n"
      "throw:\n"
      "  object: !choice [ball, box]\n"
      "  size_m: !uniform [0.1, 0.7000000000000001]\n"
      "  distance_m: !normal {mean: 3, sd: 0.1}\n"
      "  speed_mps: !choice [3, 4.5]\n"
      "  aim_offset_m: [0.05, !normal {mean: 0, sd: 0.123456789012345678}]\n";
  const std::string resolved = to_yaml(parse(yaml));
  EXPECT_EQ(to_yaml(parse(resolved)), resolved);

  const Scenario again = parse(resolved);
  EXPECT_EQ(again.name, "a \"quoted\" title: # with \\ and \xc3\xa4");
  EXPECT_EQ(again.description, "several\n\nlines\n");
  EXPECT_EQ(again.after_s, 0.30000000000000004);
  EXPECT_EQ(again.mission.goal_m->z(), -3.3333333333333335);
  EXPECT_EQ(again.throw_spec->size_m, parse(yaml).throw_spec->size_m);
  EXPECT_EQ(again.throw_spec->aim_offset_m, parse(yaml).throw_spec->aim_offset_m);
}

TEST(Scenario, EveryKeyIsWrittenOnceAndDocumented) {
  const std::vector<ParameterDoc> docs = scenario_docs();
  EXPECT_GT(docs.size(), 100u);
  std::set<std::string> paths;
  for (const ParameterDoc& doc : docs) {
    EXPECT_TRUE(paths.insert(doc.path).second) << doc.path << " is listed twice";
    EXPECT_FALSE(doc.doc.empty()) << doc.path;
    EXPECT_EQ(doc.doc.back(), '.') << doc.path << " is not documented by a sentence";
  }
  Scenario scenario = parse("mission: {type: goal, goal_m: [1, 2, 3]}\nthrow: {}\n");
  const std::string resolved = to_yaml(scenario);
  std::size_t lines = 0;
  for (const char c : resolved) lines += c == '\n';
  EXPECT_EQ(lines, docs.size() - 8)
      << "extends, grid, sweep, stop and its two keys, throws, waypoints_m are not there";
}

TEST(Scenario, APilotBringsItsConfigurationAndTheFileChangesIt) {
  const auto read = [](const std::string& text) { return parse_scenario(text, "test.yaml", ""); };
  EXPECT_EQ(read("pilot: dodgesim\n").dodger.escape.law, "closest_approach");
  EXPECT_EQ(read("pilot: dodgesim\n").dodger.window.window_us,
            dodge::preset("dodgesim").window.window_us);
  const Scenario changed = read("dodger: {window: {window_us: 15000}}\npilot: dodgesim\n");
  EXPECT_EQ(changed.dodger.window.window_us, 15000) << "whatever the order of the keys";
  EXPECT_EQ(changed.dodger.escape.law, "closest_approach");
  EXPECT_EQ(to_yaml(read(to_yaml(changed))), to_yaml(changed));
  for (const char* pilot : {"falanga2020", "oracle", "none"}) {
    EXPECT_EQ(read(std::string("pilot: ") + pilot + "\n").dodger.escape.law, "potential_field");
  }
}

TEST(Scenario, EveryScenarioOfTheProjectIsValid) {
  const std::filesystem::path root = DODGESIM_SOURCE_DIR;
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(load_scenario(entry.path(), root / "models")) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(Explain, FindsAKeyByItsPathOrItsLastPart) {
  const std::vector<ParameterDoc> docs = scenario_docs();
  EXPECT_THAT(explain(docs, "throw.size_m"), ::testing::StartsWith("throw.size_m\n"));
  EXPECT_THAT(explain(docs, "compute_us"), ::testing::StartsWith("delays.compute_us\n"));
  EXPECT_THAT(explain(docs, "throw"), ::testing::HasSubstr("throw.launch_s\n"));
  EXPECT_EQ(testing::complaint<ScenarioError>([&] { explain(docs, "lux"); }),
            "There is no key lux in a scenario, but sensors.events.illuminance_lux.");
  EXPECT_THAT(explain(docs, "height_monitor"),
              ::testing::HasSubstr("dodger.height_monitor.persist_us\n"));
  EXPECT_THAT(
      explain(docs, "pilot"),
      ::testing::HasSubstr("falanga2020, dodgesim, oracle, none or plugin; default falanga2020"));
}

TEST(Explain, SuggestsTheKeyThatWasMeant) {
  try {
    explain(scenario_docs(), "sise_m");
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(error.what(), "There is no key sise_m in a scenario; did you mean size_m?");
  }
}

TEST(ClosestName, RecognisesSlipsOfTheFingerOnly) {
  const std::vector<std::string> names = {"size_m", "speed_mps", "distance_m"};
  EXPECT_EQ(closest_name("siez_m", names), "size_m");
  EXPECT_EQ(closest_name("distnce_m", names), "distance_m");
  EXPECT_EQ(closest_name("speed", names), "speed_mps");
  EXPECT_EQ(closest_name("colour", names), "");
  EXPECT_EQ(closest_name("", names), "");
}

}  // namespace
}  // namespace dodgesim
