// Models of one's own, from the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/cli/command_test.h"
#include "tests/models.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::copy_models;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class OwnModelsCommandTest : public dodgesim::testing::CommandTest {
 protected:
  OwnModelsCommandTest() {
    write("s.yaml",
          "seed: 3\nrepeats: 2\npilot: none\nfly_oracle: false\nafter_s: 0.1\n"
          "throw: {speed_mps: !uniform [5, 8], launch_s: 0.1}\n");
  }
};

TEST_F(OwnModelsCommandTest, AMeshThatCrashesMujocoCostsASentenceAndExitCodeTwo) {
  copy_models(root_);
  write("models/objects/evil.xml",
        "<mujoco><custom><numeric name='reference_size_m' data='0.1'/>"
        "<numeric name='mass_exponent' data='3'/><numeric name='drag_coefficient' data='1'/>"
        "<numeric name='frontal_area_m2' data='0.01'/></custom>"
        "<asset><mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='0 1 "
        "400000000'/></asset><worldbody><body name='body'><freejoint/>"
        "<inertial pos='0 0 0' mass='1' diaginertia='1e-3 1e-3 1e-3'/>"
        "<geom type='mesh' mesh='m' contype='4' conaffinity='7'/></body></worldbody></mujoco>");
  for (const char* command : {"validate", "run --out x"}) {
    const Outcome refused = dodgesim(std::string(command) + " " + path("s.yaml") + " --models " +
                                     path("models") + " --set throw.object=evil");
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    EXPECT_THAT(refused.output, AllOf(HasSubstr("objects/evil.xml"), ::testing::EndsWith(".\n")));
  }
  EXPECT_FALSE(fs::exists("x"));
}

TEST_F(OwnModelsCommandTest, AVehicleThatThePilotTakesForASmallerOneIsNamed) {
  copy_models(root_);
  std::string large = contents("models/vehicles/qav_rxl.xml");
  const std::string size = "size=\"0.17 0.17 0.05\"";
  write("models/vehicles/large.xml",
        large.replace(large.find(size), size.size(), "size=\"0.3 0.4 0.05\""));
  const auto validate = [&](const std::string& settings) {
    return dodgesim("validate " + path("s.yaml") + " --models " + path("models") + settings);
  };
  const std::string own = " --set pilot=dodgesim";
  EXPECT_THAT(validate(own).output, Not(HasSubstr("hull")));
  const Outcome named = validate(own + " --set vehicle=large");
  EXPECT_EQ(named.exit_code, 0);
  EXPECT_THAT(named.output, HasSubstr("dodger.escape.hull_radius_m is 0.25, but the hull of "
                                      "vehicles/large.xml reaches 0.5 m from its centre."));
  const std::string told = " --set dodger.escape.hull_radius_m=0.5";
  EXPECT_THAT(validate(own + " --set vehicle=large" + told).output, Not(HasSubstr("hull of")));
  EXPECT_THAT(validate(" --set pilot=falanga2020 --set vehicle=large").output,
              Not(HasSubstr("hull of")));
}

TEST_F(OwnModelsCommandTest, AVehicleWithOneCameraFliesWhoeverNeedsNoMore) {
  copy_models(root_);
  const std::string two = contents("models/vehicles/qav_rxl.xml");
  const std::regex lower("<camera name=\"bottom\"[^>]*/>");
  write("models/vehicles/one_eyed.xml", std::regex_replace(two, lower, ""));
  const auto run = [&](const std::string& settings) {
    return dodgesim("run " + path("s.yaml") + " --models " + path("models") + " --out " +
                    path("out") + " --force --set repeats=1 --set vehicle=one_eyed" + settings);
  };
  EXPECT_EQ(run("").exit_code, 0) << "nobody looks";
  const Outcome stereo = run(" --set pilot=falanga2020");
  EXPECT_EQ(stereo.exit_code, 2);
  EXPECT_THAT(stereo.output,
              AllOf(HasSubstr("vehicles/one_eyed.xml: Depth by stereo needs 2 camera(s)"),
                    HasSubstr("With position.depth: mono one is enough.")));
  const Outcome mono =
      run(" --set pilot=falanga2020 --set dodger.position.depth=mono "
          "--set sensors.camera.width=160 --set sensors.camera.height=120");
  EXPECT_EQ(mono.exit_code, 0) << mono.output;
  EXPECT_EQ(column("out/throws.csv", "flown_status"), std::vector<std::string>{"ok"});
  const Outcome turned =
      dodgesim("validate " + path("s.yaml") + " --models " + path("models") +
               " --set vehicle=one_eyed --set "
               "'sweep.vehicle_overrides.lower_camera_turn_deg=[[0, 0, 0], [0.1, 0, 0]]'");
  EXPECT_EQ(turned.exit_code, 2) << "as run would end";
  EXPECT_THAT(turned.output, HasSubstr("'bottom'"));
}

TEST_F(OwnModelsCommandTest, RoomsThatNoCameraCanSeeAndRotorsThatAreTooWeakAreUsageErrors) {
  copy_models(root_);
  write("models/rooms/hilly.xml",
        "<mujoco><asset><hfield name='h' nrow='2' ncol='2' size='5 5 1 1'/></asset><worldbody>"
        "<geom type='hfield' hfield='h'/></worldbody></mujoco>\n");
  const auto validate = [&](const std::string& settings) {
    return dodgesim("validate " + path("s.yaml") + " --models " + path("models") + settings);
  };
  EXPECT_EQ(validate(" --set room=hilly").exit_code, 0) << "nobody looks at it";
  const Outcome unseen = validate(" --set room=hilly --set pilot=dodgesim");
  EXPECT_EQ(unseen.exit_code, 2);
  EXPECT_THAT(unseen.output,
              AllOf(HasSubstr("rooms/hilly.xml: The geom number 0, a height field, "),
                    HasSubstr("cannot be seen by an event camera")));

  const std::string strong = contents("models/vehicles/qav_rxl.xml");
  write("models/vehicles/qav_rxl.xml",
        std::regex_replace(strong, std::regex("ctrlrange=\"0 [0-9.]+\""), "ctrlrange=\"0 4\""));
  EXPECT_EQ(validate("").exit_code, 0);
  const Outcome weak = validate(" --set motors.min_thrust_n=4.5");
  EXPECT_EQ(weak.exit_code, 2);
  EXPECT_THAT(weak.output, AllOf(HasSubstr("motors.min_thrust_n is 4.5, but must be less than"),
                                 HasSubstr("vehicles/qav_rxl.xml")));
  const Outcome lifted = validate(" --set motors.min_thrust_n=2.6");
  EXPECT_EQ(lifted.exit_code, 2);
  EXPECT_THAT(lifted.output,
              HasSubstr("must be less than 2.453 N, a quarter of the vehicle's weight"));
}

TEST_F(OwnModelsCommandTest, ObjectsThatNobodySeesAndRotorsThatCannotHoldAreUsageErrors) {
  copy_models(root_);
  const auto validate = [&](const std::string& settings) {
    return dodgesim("validate " + path("s.yaml") + " --models " + path("models") + settings);
  };
  const std::string ball = contents("models/objects/ball.xml");
  const std::string hidden = std::regex_replace(ball, std::regex("group=\"1\""), "group=\"3\"");
  ASSERT_NE(hidden, ball);
  write("models/objects/ghost.xml", hidden);
  EXPECT_EQ(validate(" --set throw.object=ghost").exit_code, 0) << "nobody looks";
  const Outcome ghost = validate(" --set throw.object=ghost --set pilot=dodgesim");
  EXPECT_EQ(ghost.exit_code, 2);
  EXPECT_THAT(ghost.output, HasSubstr("objects/ghost.xml: No geom of the object can be seen"));

  const std::string quad = contents("models/vehicles/qav_rxl.xml");
  const std::string lame = std::regex_replace(quad, std::regex("(\"rotor_0\" pos=\") "), "$1-");
  ASSERT_NE(lame, quad);
  write("models/vehicles/qav_rxl.xml", lame);
  const Outcome rotors = validate("");
  EXPECT_EQ(rotors.exit_code, 2);
  EXPECT_THAT(rotors.output, HasSubstr("vehicles/qav_rxl.xml: The "));
}

TEST_F(OwnModelsCommandTest, CamerasThatStereoCannotUseAreUsageErrors) {
  copy_models(root_);
  const std::string upright = contents("models/vehicles/qav_rxl.xml");
  const std::string oblique =
      std::regex_replace(upright, std::regex("\"top\" pos=\"0.12 0 "), "\"top\" pos=\"0.12 0.05 ");
  ASSERT_NE(oblique, upright);
  write("models/vehicles/qav_rxl.xml", oblique);
  const auto command = [&](const std::string& name, const std::string& settings) {
    return dodgesim(name + " " + path("s.yaml") + " --models " + path("models") + settings);
  };
  EXPECT_EQ(command("validate", "").exit_code, 0) << "nobody looks through them";
  const std::string mono = " --set pilot=dodgesim --set dodger.position.depth=mono";
  EXPECT_EQ(command("validate", mono).exit_code, 0);
  for (const std::string name : {"validate", "run --out x"}) {
    const Outcome refused = command(name, " --set pilot=dodgesim");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output,
                ::testing::StartsWith(path("models/vehicles/qav_rxl.xml: Stereo needs the second "
                                           "camera straight below the first")));
  }
  EXPECT_FALSE(fs::exists("x"));
}

TEST_F(OwnModelsCommandTest, AVehicleThatCannotFlyIsRefusedBeforeTheCampaign) {
  const Outcome refused =
      dodgesim("validate " + path("s.yaml") + " --set vehicle_overrides.mass_scale=9");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("times the vehicle's weight"));

  const std::string held = "validate " + path("s.yaml") +
                           " --set vehicle_overrides.mass_scale=2.5"
                           " --set controller.max_thrust_fraction=";
  EXPECT_EQ(dodgesim(held + "0.9").exit_code, 0);
  const Outcome weak = dodgesim(held + "0.7");
  EXPECT_EQ(weak.exit_code, 2);
  EXPECT_THAT(weak.output, HasSubstr("=0.7: controller.max_thrust_fraction is 0.7, with which a "
                                     "rotor of vehicles/qav_rxl.xml lifts only 1.085 times its "
                                     "share of 2.5 kg"));

  // The front rotors carry nearly all of it.
  copy_models(root_);
  const std::string even = contents("models/vehicles/qav_rxl.xml");
  const std::string uneven = std::regex_replace(even, std::regex("pos=\"-0.085"), "pos=\"-0.485");
  ASSERT_NE(uneven, even);
  write("models/vehicles/qav_rxl.xml", uneven);
  const std::string own = "validate " + path("s.yaml") + " --models " + path("models") +
                          " --set vehicle_overrides.mass_scale=";
  EXPECT_EQ(dodgesim(own + "1").exit_code, 0);
  EXPECT_THAT(dodgesim(own + "2").output, HasSubstr("times its share of 2 kg, which is 8.3"));
}

TEST_F(OwnModelsCommandTest, AVehicleThatCrashesBeforeItIsThrownAtIsNamed) {
  const std::string late = "validate " + path("s.yaml") +
                           " --set throw.launch_s=4 --set sensors.state_estimate.height_drift_mps=";
  EXPECT_THAT(dodgesim(late + "0").output, testing::Not(HasSubstr("crashes")));
  const Outcome sinking = dodgesim(late + "1");
  EXPECT_EQ(sinking.exit_code, 0);
  EXPECT_THAT(sinking.output,
              testing::ContainsRegex("In throw [01] the vehicle crashes by itself, at [0-9.]+ s, "
                                     "before it is thrown at\\."));
}

TEST_F(OwnModelsCommandTest, AVehicleThatItsGainsDoNotLetHoverIsNamed) {
  const std::string gain = "validate " + path("s.yaml") +
                           " --set throw.launch_s=1 --set flight_controller.rate_gain_xy_1ps=";
  EXPECT_THAT(dodgesim(gain + "160").output, testing::Not(HasSubstr("turns")));
  EXPECT_THAT(dodgesim(gain + "1000").output,
              testing::ContainsRegex("In throw [01] the vehicle, which is to hover, turns by up "
                                     "to [0-9.]+ rad/s before it is thrown at\\."));
}

TEST_F(OwnModelsCommandTest, ThrowsThroughWhatStopsThemAreFoundWhetherOrNotItIsSeen) {
  copy_models(root_);
  const std::string field = contents("models/rooms/field.xml");
  const auto validate = [&](const std::string& net) {
    const std::string geom =
        "<geom name='net' type='box' pos='2 0 5' size='0.05 4 4' " + net + "/>";
    write("models/rooms/field.xml",
          std::regex_replace(field, std::regex("<worldbody>"), "<worldbody>" + geom));
    return dodgesim("validate " + path("s.yaml") + " --models " + path("models") +
                    " --set room=field --set throw.distance_m=4 --set mission.start_m='[0, 0, 2]'");
  };
  for (const char* group : {"group='0'", "group='4'"}) {
    const std::string stops = std::string(group) + " contype='1' conaffinity='6'";
    EXPECT_THAT(validate(stops).output, HasSubstr("behind the room's \"net\"")) << stops;
  }
  EXPECT_EQ(validate("group='0' contype='0' conaffinity='0'").exit_code, 0);
}

}  // namespace
