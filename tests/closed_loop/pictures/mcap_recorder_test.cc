// A recorded throw, read back by a second reader of the format (tests/sim/files/mcap_reader.h).
#include "sim/observers/mcap_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/mujoco.h"
#include "sim/files/json.h"
#include "sim/flight/setup.h"
#include "sim/loop.h"
#include "sim/observers/foxglove_models.h"
#include "tests/closed_loop/flights.h"
#include "tests/closed_loop/pictures/decoded.h"
#include "tests/sim/files/mcap_reader.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::McapMessage;
using testing::McapReader;

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count >= 8) bytes.push_back(static_cast<char>(bits >> (count -= 8) & 255));
  }
  return bytes;
}

// Whether the message has the fields that its schema lists, of the types that it says, no others.
void expect_valid(const Json& value, const Json& schema, const std::string& where) {
  const std::string type = schema.at("type");
  if (type == "object") {
    ASSERT_TRUE(value.is_object()) << where;
    if (!schema.contains("properties") || schema["properties"].empty()) return;
    EXPECT_EQ(value.size(), schema["properties"].size()) << where;
    for (const auto& [key, inner] : schema["properties"].items()) {
      ASSERT_TRUE(value.contains(key)) << where << "." << key;
      expect_valid(value[key], inner, where + "." + key);
    }
  } else if (type == "array") {
    ASSERT_TRUE(value.is_array()) << where;
    for (const Json& item : value) expect_valid(item, schema.at("items"), where + "[]");
  } else if (type == "string") {
    EXPECT_TRUE(value.is_string()) << where;
  } else if (type == "boolean") {
    EXPECT_TRUE(value.is_boolean()) << where;
  } else {
    EXPECT_TRUE(type == "integer" ? value.is_number_integer() : value.is_number()) << where;
  }
}

Eigen::Vector3d vector_of(const Json& v) {
  return {v["x"].get<double>(), v["y"].get<double>(), v["z"].get<double>()};
}

// The cheapest flight with an object: a pilot that needs no eyes.
class McapRecorderTest : public ::testing::Test {
 protected:
  std::string record(const Scenario& s) {
    const std::string path = directory_ / "throw.mcap";
    McapRecorder recorder(path, intrinsics(s.sensors.camera), cameras_in_use(s),
                          s.delays.pilot_us());
    result_ = fly_throw(s, 0, &recorder);
    recorder.finish(result_);
    return testing::contents(path);
  }

  testing::TemporaryDirectory directory_;
  Scenario scenario_ = scenario(
      "pilot: oracle\nfly_oracle: false\nafter_s: 0.2\nmission: {start_m: [-2, 0, 2]}\n"
      "throw: {object: box, distance_m: 3, speed_mps: 5, launch_s: 0.2}\n");
  ThrowResult result_;
};

TEST_F(McapRecorderTest, EveryMessageIsWhatItsSchemaSays) {
  const McapReader reader(record(scenario_));
  ASSERT_GT(reader.messages().size(), 1000u);
  std::map<std::string, Json> schemas;
  for (const auto& [name, text] : reader.schemas()) schemas[name] = parse_json(text);
  for (const McapMessage& message : reader.messages()) {
    ASSERT_EQ(schemas.at(message.schema).at("title"), message.schema);
    expect_valid(parse_json(message.json), schemas.at(message.schema), message.topic);
    if (HasFatalFailure()) return;
  }
}

TEST_F(McapRecorderTest, ShowsEverythingWhereItTrulyIs) {
  const McapReader reader(record(scenario_));
  Diary diary;
  fly(scenario_, plan_throw(scenario_, 0), &diary);
  int objects = 0;
  for (const McapMessage& message : reader.of("/tf")) {
    const Snapshot truth = diary.at(static_cast<TimeUs>(message.time_ns / 1000));
    const Json transforms = parse_json(message.json);
    for (const Json& tf : transforms["transforms"]) {
      const std::string child = tf["child_frame_id"];
      if (child == "vehicle") {
        EXPECT_LT((vector_of(tf["translation"]) - truth.vehicle.p_W).norm(), 1e-12);
      } else if (child == "object_0") {
        EXPECT_LT((vector_of(tf["translation"]) - truth.objects[0].p_W).norm(), 1e-12);
        ++objects;
      } else {
        EXPECT_EQ(tf["parent_frame_id"], "vehicle") << child;
      }
    }
  }
  EXPECT_GT(objects, 50);
  ASSERT_GT(reader.of("/range").size(), 50u);
  for (const McapMessage& message : reader.of("/range")) {
    const Snapshot truth = diary.at(static_cast<TimeUs>(message.time_ns / 1000));
    const double up = (truth.vehicle.q_W * Eigen::Vector3d::UnitZ()).z();
    if (up < 0.9) continue;  // it may look at a wall
    const double height_m = truth.vehicle.p_W.z() / up;
    EXPECT_NEAR(parse_json(message.json)["range_m"], height_m, 0.05 + 0.05 * height_m);
  }
  const Json box = parse_json(reader.of("/scene/objects").at(0).json)["entities"][0];
  EXPECT_EQ(box["frame_id"], "object_0");
  EXPECT_LT((vector_of(box["cubes"][0]["size"]) - Eigen::Vector3d(0.2, 0.4 / 3, 0.1)).norm(), 1e-5);
  const Json room = parse_json(reader.of("/scene/room").at(0).json)["entities"][0];
  EXPECT_EQ(room["lines"].size(), 6u);  // its walls
  for (const Json& point : room["lines"][0]["points"]) {
    EXPECT_EQ(std::abs(point["x"].get<double>()), 6);
    EXPECT_EQ(std::abs(point["y"].get<double>()), 4);
    EXPECT_EQ(point["z"], 0);
  }
}

TEST(FoxgloveModels, OfARoomShowWhatStandsInBodiesWhereItStands) {
  const MjModelPtr model = compile_model(
      "<mujoco><worldbody><geom type='sphere' size='.1' pos='0 0 1'/>"
      "<body pos='2 0 0' euler='0 0 90'><geom type='box' size='.1 .2 .3' pos='0 1 0'/></body>"
      "<body><freejoint/><geom type='sphere' size='.1' mass='1'/></body></worldbody></mujoco>",
      ".", "test");
  Json room = foxglove::entity(0, "world", "room");
  foxglove::add_room(*model, foxglove::Colour::Ones(), room);
  ASSERT_EQ(room["cubes"].size(), 1u);
  EXPECT_LT((vector_of(room["cubes"][0]["pose"]["position"]) - Eigen::Vector3d(1, 0, 0)).norm(),
            1e-9);
  ASSERT_EQ(room["spheres"].size(), 1u);  // what flies is none of it
  EXPECT_LT((vector_of(room["spheres"][0]["pose"]["position"]) - Eigen::Vector3d(0, 0, 1)).norm(),
            1e-9);
}

TEST_F(McapRecorderTest, TellsWhatHappened) {
  const McapReader reader(record(scenario_));
  std::string log;
  for (const McapMessage& message : reader.of("/log")) {
    log += parse_json(message.json)["message"].get<std::string>() + "\n";
  }
  EXPECT_THAT(log, ::testing::HasSubstr("Object 0 is thrown, 3."));
  EXPECT_THAT(log, ::testing::HasSubstr("The vehicle evades."));
  EXPECT_THAT(log, ::testing::HasSubstr(result_.flown.hit ? "The vehicle is hit." : "Closest"));
  EXPECT_THAT(log, ::testing::HasSubstr("Without dodging it would have been hit."));
  bool evading = false;
  for (const McapMessage& message : reader.of("/command")) {
    const Json command = parse_json(message.json);
    EXPECT_NEAR(vector_of(command["velocity_mps"]).norm(), command["speed_mps"], 1e-12);
    evading = evading || command["evading"].get<bool>();
  }
  EXPECT_TRUE(evading);
}

// An arrow points along its own x.
TEST_F(McapRecorderTest, PointsAnArrowWhereTheVehicleIsToFly) {
  const McapReader reader(record(scenario_));
  const auto commands = reader.of("/command"), scenes = reader.of("/scene/command");
  ASSERT_EQ(commands.size(), scenes.size());
  int arrows = 0;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const Eigen::Vector3d v_W = vector_of(parse_json(commands[i].json)["velocity_mps"]);
    const Json arrow = parse_json(scenes[i].json)["entities"][0]["arrows"];
    if (v_W.norm() < 1e-6) continue;
    ASSERT_EQ(arrow.size(), 1u);
    const Json q = arrow[0]["pose"]["orientation"];
    const Eigen::Quaterniond orientation(q["w"].get<double>(), q["x"].get<double>(),
                                         q["y"].get<double>(), q["z"].get<double>());
    EXPECT_LT((orientation * Eigen::Vector3d::UnitX() - v_W.normalized()).norm(), 1e-9);
    ++arrows;
  }
  EXPECT_GT(arrows, 50);
}

TEST_F(McapRecorderTest, IsTheSameForTheSameThrow) {
  EXPECT_TRUE(record(scenario_) == record(scenario_));
}

// Plays a pilot that has detected something in its first cycle.
class DetectingPilot : public dodge::Pilot {
 public:
  void add_events(int, std::span<const dodge::Event>) override {}
  void add_imu(const dodge::ImuSample&) override {}
  void add_state(const dodge::StateEstimate&) override {}
  void set_goal(const dodge::Goal&) override {}
  dodge::VelocityCommand update(dodge::TimeUs) override { return {}; }
  std::span<const dodge::Detection> detections() const override { return found_; }
  std::span<const dodge::Obstacle> obstacles() const override { return {}; }

 private:
  std::vector<dodge::Detection> found_ = std::vector<dodge::Detection>(1);
};

TEST_F(McapRecorderTest, ShowsDetectionsWhenThePilotGivesThemOut) {
  const std::string path = directory_ / "late.mcap";
  McapRecorder recorder(path, intrinsics(scenario_.sensors.camera), 2, 20000);
  World world({scenario_.models_dir, scenario_.room, scenario_.vehicle, {}});
  const std::array<double, 4> thrust{2.45, 2.45, 2.45, 2.45};
  while (world.snapshot().t_us < 50000) {
    world.step(thrust);
    recorder.on_tick(world);
    const TimeUs now_us = world.snapshot().t_us;
    if (now_us == 10000 || now_us == 40000) recorder.on_cycle(now_us, DetectingPilot());
  }
  recorder.finish({});
  const McapReader reader(testing::contents(path));
  ASSERT_EQ(reader.of("/scene/detections").size(), 1u);  // the second never came out
  EXPECT_EQ(reader.of("/scene/detections").at(0).time_ns, 30'000'000u);
  ASSERT_FALSE(reader.of("/log").empty());
  EXPECT_EQ(reader.of("/log").at(0).time_ns, 30'000'000u);
}

// The test plays the event cameras, as the pilot needs none.
TEST_F(McapRecorderTest, ShowsTheEventsOfTenMilliseconds) {
  const std::string path = directory_ / "eyes.mcap";
  McapRecorder recorder(path, intrinsics(scenario_.sensors.camera), 2, 0);
  World world({scenario_.models_dir, scenario_.room, scenario_.vehicle, {}});
  const std::array<double, 4> thrust{2.45, 2.45, 2.45, 2.45};
  const std::vector<Event> on = {{9500, 100, 60, 1}}, off = {{15000, 7, 8, -1}};
  while (world.snapshot().t_us <= 30000) {
    world.step(thrust);
    recorder.on_tick(world);
    if (world.snapshot().t_us == 10000) recorder.on_events(0, {10000, on});
    if (world.snapshot().t_us == 15000) recorder.on_events(1, {15000, off});
  }
  recorder.finish({});
  const McapReader reader(testing::contents(path));
  const auto pixel = [&](const std::string& camera, std::size_t image, int y, int x) {
    const Json message = parse_json(reader.of("/camera/" + camera + "/events").at(image).json);
    EXPECT_EQ(message["format"], "png");
    const std::string file = directory_ / "picture.png";
    std::ofstream(file, std::ios::binary) << from_base64(message["data"]);
    const cv::Mat3b picture = testing::decoded(file).at(0);
    EXPECT_EQ(picture.size(), cv::Size(320, 240));
    return static_cast<int>(picture(y, x)[0]);
  };
  EXPECT_EQ(reader.of("/camera/top/events").at(0).time_ns, 10000000u);
  EXPECT_EQ(pixel("top", 0, 60, 100), 255);
  EXPECT_EQ(pixel("top", 1, 60, 100), 110);  // each is shown once
  EXPECT_EQ(pixel("bottom", 0, 8, 7), 110);
  EXPECT_EQ(pixel("bottom", 1, 8, 7), 0);
}

}  // namespace
}  // namespace dodgesim
