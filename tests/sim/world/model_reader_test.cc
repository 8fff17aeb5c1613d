// What World demands of a model, whose files are those of a test.
#include "sim/world/model_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/world/referee.h"
#include "tests/sim/world/own_models.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

class ModelReaderTest : public OwnModels {
 protected:
  // What is said of the nominal vehicle, alone, with `to` in place of the first `from`.
  std::string changed_vehicle_message(const std::string& from, const std::string& to) {
    spec_.objects.clear();
    const auto file = directory_ / "vehicles" / "qav_rxl.xml";
    const std::string good = testing::contents(file);
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    testing::put(file, text);
    const std::string message = world_message();
    testing::put(file, good);
    return message;
  }
};

TEST_F(ModelReaderTest, AVehicleThatTheMixerWouldTakeForAnotherIsRefused) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return changed_vehicle_message(from, to);
  };
  EXPECT_EQ(with("mujoco", "mujoco"), "");
  const auto a_rotor = HasSubstr("a rotor must be a motor at its site");
  EXPECT_THAT(with("gear=\"0 0 1", "gear=\"0 0 1.5"), a_rotor);
  EXPECT_THAT(with("gear=\"0 0 1", "gear=\"0.1 0 1"), a_rotor);
  EXPECT_THAT(with("0 0  0.012\"", "0 0  0.02\""), a_rotor);
  EXPECT_THAT(with("ctrlrange=\"0 9.5\"", "ctrlrange=\"0 3\""), a_rotor);
  EXPECT_THAT(with("ctrlrange=\"0 9.5\"", "ctrlrange=\"5 9.5\""), a_rotor);
  EXPECT_THAT(
      with("ctrlrange=\"0 9.5\"", "forcelimited=\"true\" forcerange=\"0 2\" ctrlrange=\"0 9.5\""),
      a_rotor);
  EXPECT_THAT(with("<motor name=\"rotor_0\"", "<general gainprm=\"0.5\" name=\"rotor_0\""),
              a_rotor);
  EXPECT_THAT(with("<motor name=\"rotor_3\"",
                   "<general dyntype=\"filter\" dynprm=\"0.04\" name=\"rotor_3\""),
              a_rotor);
  EXPECT_THAT(with("<freejoint name=\"vehicle\"/>", ""),
              HasSubstr("the body must have a free joint"));
  EXPECT_THAT(with("<motor name=\"rotor_0\"",
                   "<motor name=\"fifth\" site=\"rotor_0\"/><motor name=\"rotor_0\""),
              HasSubstr("four actuators, its rotors, not 5"));
  EXPECT_THAT(with("name=\"rotor_drag_1ps\" data=\"", "name=\"rotor_drag_1ps\" data=\"-"),
              HasSubstr("rotor_drag_kh_1pm must not be negative"));
  EXPECT_THAT(with("</worldbody>", "<body><freejoint/><geom size=\"0.1\"/></body></worldbody>"),
              HasSubstr("must have one joint"));
  EXPECT_THAT(with("site=\"rotor_0\"", "site=\"rotor_1\""), a_rotor);
  EXPECT_THAT(with("<site name=\"rotor_1\"", "<site euler=\"20 0 0\" name=\"rotor_1\""), a_rotor);
  EXPECT_THAT(with("diaginertia=\"0.0033 0.0040 0.0062\"",
                   "fullinertia=\"0.0033 0.0040 0.0062 0.0003 0 0\""),
              HasSubstr("principal axes"));
  EXPECT_THAT(with("xyaxes=\"1 0 0 0 -1 0\"", "euler=\"170 0 0\""), HasSubstr("must look down"));
}

TEST_F(ModelReaderTest, WhatStaysBehindWhenTheVehicleFliesIsNoPartOfIt) {
  spec_.objects.clear();
  const auto file = directory_ / "vehicles" / "qav_rxl.xml";
  const std::string good = testing::contents(file);
  for (const std::string part :
       {"<site name=\"range\"", "<site name=\"rotor_2\"", "<camera name=\"bottom\""}) {
    std::string text = good;
    const std::size_t begin = text.find(part), end = text.find("/>", begin) + 2;
    const std::string tag = text.substr(begin, end - begin);
    text.erase(begin, end - begin);
    text.insert(text.find("</worldbody>"), tag);
    testing::put(file, text);
    EXPECT_THAT(world_message(), HasSubstr("must be in the body 'vehicle'")) << part;
  }
}

// The reference size is 0.1 m.
// Where it begins, the scenario says.
TEST_F(ModelReaderTest, AVehicleWithAPlaceOfItsOwnIsRefused) {
  spec_.objects.clear();
  const auto file = directory_ / "vehicles" / "qav_rxl.xml";
  const std::string good = testing::contents(file), body = "<body name=\"vehicle\"";
  for (const std::string place : {"pos=\"0 0 1\"", "euler=\"0 0 90\""}) {
    std::string text = good;
    testing::put(file, text.insert(text.find(body) + body.size(), " " + place));
    EXPECT_THAT(world_message(), HasSubstr("The body of a vehicle must have no")) << place;
  }
}

TEST_F(ModelReaderTest, TheLowerCameraMayBeMissingButNotTheUpperOne) {
  spec_.objects.clear();
  const auto file = directory_ / "vehicles" / "qav_rxl.xml";
  const std::string good = testing::contents(file);
  const auto without = [&](const std::string& camera) {
    std::string text = good;
    const std::size_t begin = text.find("<camera name=\"" + camera + "\"");
    testing::put(file, text.erase(begin, text.find("/>", begin) + 2 - begin));
  };
  const std::size_t both = World(spec_).vehicle().X_BC.size();
  const Eigen::Isometry3d top = World(spec_).vehicle().X_BC.front();
  EXPECT_EQ(both, 2u);
  without("bottom");
  ASSERT_EQ(World(spec_).vehicle().X_BC.size(), 1u);
  EXPECT_TRUE(World(spec_).vehicle().X_BC.front().isApprox(top));
  spec_.vehicle_overrides.stereo_baseline_m = 0.2;
  EXPECT_THAT(world_message(), HasSubstr("the model has no camera named 'bottom'"));
  spec_.vehicle_overrides = {};
  without("top");
  EXPECT_THAT(world_message(), HasSubstr("the model has no camera named 'top'"));
}

TEST_F(ModelReaderTest, AnObjectIsAsLargeAsItsReferenceSizeSays) {
  const auto with = [&](const std::string& geom) {
    write_object(object(geom));
    return world_message();
  };
  EXPECT_EQ(with("<geom size='0.05'/>"), "");
  EXPECT_EQ(with("<geom type='box' size='0.05 0.05 0.05'/>"), "");
  EXPECT_EQ(with("<geom type='capsule' size='0.01' fromto='0 0 -0.03 0 0 0.06'/>"), "");
  EXPECT_EQ(with("<geom type='capsule' size='0.01' fromto='0 0 0 0 0 0.09'/>"), "");
  EXPECT_THAT(with("<geom size='0.15'/>"),
              HasSubstr("own.xml: with a size of 0.2 m its geoms that collide reach 0.3 m from its "
                        "centre of mass, but must reach 0.08 to 0.24 m"));
  EXPECT_THAT(with("<geom size='0.1'/>"),
              HasSubstr("own.xml: with a size of 0.2 m its geoms that collide are 0.4 m long from "
                        "end to end"));
  EXPECT_THAT(with("<geom size='0.035'/>"), HasSubstr("reach 0.07 m"));
  EXPECT_THAT(with("<geom size='0.05' pos='1 0 0'/>"), HasSubstr("reach 2.1 m"));
}

TEST_F(ModelReaderTest, WhatIsSeenOfAnObjectIsAsLargeAsWhatCollides) {
  const auto with = [&](const std::string& drawn) {
    write_object(
        object("<geom size='0.05' group='4'/><geom contype='0' conaffinity='0' " + drawn + "/>"));
    return world_message();
  };
  EXPECT_EQ(with("type='box' size='0.03 0.03 0.03'"), "");
  EXPECT_THAT(with("type='box' size='0.00003 0.00003 0.00003'"),
              HasSubstr("its geoms that are seen reach 0.000104 m"));
  EXPECT_THAT(with("type='box' size='0.3 0.3 0.3'"),
              HasSubstr("its geoms that are seen reach 1.04 m"));
  EXPECT_EQ(with("type='box' size='0.3 0.3 0.3' group='4'"), "");
  EXPECT_EQ(with("type='box' size='0.3 0.3 0.3' rgba='1 1 1 0'"), "");
}

// An object with such a cushion would turn round before the vehicle's hull: a miss of a throw that
// hits.
TEST_F(ModelReaderTest, NothingPushesBeforeItIsTouched) {
  const auto with = [&](const std::string& margin) {
    write_object(
        object("<geom size='0.05' group='1' contype='4' conaffinity='7' " + margin + "/>"));
    return world_message();
  };
  EXPECT_THAT(
      with("margin='0.05'"),
      HasSubstr("own.xml: a geom that can collide has a margin of 0.05 m and a gap of 0 m"));
  EXPECT_THAT(with("margin='0.05' gap='0.04'"), HasSubstr("a gap of 0.04 m"));
  EXPECT_EQ(with("margin='0.05' gap='0.05'"), "");
  EXPECT_THAT(with("gap='0.05'"), HasSubstr("lets things sink in"));
  EXPECT_EQ(with(""), "");

  const auto refused = [&](const std::string& file, const std::string& geom) {
    std::string text = testing::contents(directory_ / file);
    const std::string good = text;
    text.replace(text.find(geom), geom.size(), geom + " margin=\"0.01\"");
    testing::put(directory_ / file, text);
    EXPECT_THAT(world_message(), HasSubstr(file + ": a geom that can collide has a margin"));
    testing::put(directory_ / file, good);
  };
  refused("vehicles/qav_rxl.xml", "<geom name=\"hull\"");
  refused("rooms/field.xml", "<geom name=\"ground\"");
}

TEST_F(ModelReaderTest, WhatCollidesTouchesAllTheOthers) {
  const auto with = [&](const std::string& bits) {
    write_object(object("<geom size='0.05' group='1' " + bits + "/>"));
    return world_message();
  };
  EXPECT_EQ(with("contype='4' conaffinity='7'"), "");
  EXPECT_EQ(with("contype='1' conaffinity='1'"), "");
  EXPECT_THAT(with("contype='8' conaffinity='8'"),
              HasSubstr("own.xml: a geom with a contype of 8 and a conaffinity of 8 would go "
                        "through the room; those of an object have 4 and 7"));
  EXPECT_THAT(with("contype='4' conaffinity='3'"), HasSubstr("would go through an object"));
  EXPECT_EQ(with("contype='4' conaffinity='5'"), "");
  EXPECT_THAT(with("contype='0' conaffinity='1'"), HasSubstr("would go through the vehicle"));

  const auto swapped = [&](const std::string& file, const std::string& bits) {
    std::string text = testing::contents(directory_ / file);
    const std::string good = text;
    const std::string others = "contype=\"16\" conaffinity=\"16\"";
    for (std::size_t at = 0; (at = text.find(bits, at)) != std::string::npos;) {
      text.replace(at, bits.size(), others);
    }
    testing::put(directory_ / file, text);
    const std::string message = world_message();
    testing::put(directory_ / file, good);
    return message;
  };
  write_object(object("<geom size='0.05' group='1'/>"));
  EXPECT_THAT(
      swapped("rooms/field.xml", "contype=\"1\" conaffinity=\"6\""),
      HasSubstr("rooms/field.xml: a geom with a contype of 16 and a conaffinity of 16 would "
                "go through the vehicle; those of the room have 1 and 6"));
  EXPECT_THAT(swapped("vehicles/qav_rxl.xml", "contype=\"2\" conaffinity=\"5\""),
              HasSubstr("qav_rxl.xml: a geom with a contype of 16 and a conaffinity of 16 would go "
                        "through the room; those of the vehicle have 2 and 5"));
}

// MuJoCo lets two geoms touch if either's type is in the other's affinity.
TEST_F(ModelReaderTest, WhatCollidesByItsAffinityAloneBelongsToTheHull) {
  const auto file = directory_ / "vehicles" / "qav_rxl.xml";
  std::string text = testing::contents(file);
  const std::string hull = "<geom name=\"hull\"";
  text.insert(text.find(hull),
              "<geom type=\"sphere\" size=\"0.02\" pos=\"0.4 0 0\" group=\"4\" contype=\"0\" "
              "conaffinity=\"5\"/>");
  testing::put(file, text);
  spec_.objects.clear();
  const World world(spec_);
  EXPECT_NEAR(reach_m(Referee(world).hull(), Eigen::Vector3d::UnitX()), 0.42, 1e-9);
}

TEST_F(ModelReaderTest, ARoomHasSomethingToStandOn) {
  testing::put(
      directory_ / "rooms/field.xml",
      "<mujoco><worldbody><geom size='1' contype='0' conaffinity='0'/></worldbody></mujoco>");
  write_object(object("<geom size='0.05' group='1'/>"));
  EXPECT_THAT(world_message(), HasSubstr("rooms/field.xml: no geom of the room can collide"));
}

TEST_F(ModelReaderTest, NobodyHasMoreInertiaThanItsMassAndSizeAllow) {
  const auto with = [&](const std::string& inertia) {
    return changed_message(object("<geom size='0.05' group='1'/>"), "1e-3 1e-3 1e-3", inertia);
  };
  EXPECT_EQ(with("2e-3 2e-3 2e-3"), "");  // times 2^5; at most 8 kg at 0.1 m
  EXPECT_THAT(with("2e-3 2e-3 3e-3"),
              HasSubstr("own.xml: the body's inertia is 0.096 kg m^2, but must be at most 0.08"));
  EXPECT_EQ(with("1e-5 1e-5 1e-5"), "");
  EXPECT_THAT(
      with("1e-6 1e-6 1e-6"),
      HasSubstr("own.xml: the body's greatest moment of inertia is 3.2e-05 kg m^2, but must "
                "be at least 4e-05"));
}

TEST_F(ModelReaderTest, NothingIsDenserThanOsmium) {
  const auto with = [&](const std::string& inertial) {
    return changed_message(object("<geom size='0.05' group='1'/>"),
                           "mass='1' diaginertia='1e-3 1e-3 1e-3'", inertial);
  };
  EXPECT_EQ(with("mass='11' diaginertia='0.01 0.01 0.01'"), "");  // times 2^3, of 10 cm
  EXPECT_THAT(with("mass='12' diaginertia='0.01 0.01 0.01'"),
              HasSubstr("own.xml: the body's mass is 96 kg, but must be at most 94.6 kg"));
}

TEST_F(ModelReaderTest, AMeshThatIsInsideOutIsRefused) {
  std::filesystem::create_directories(directory_ / "meshes");
  const auto with = [&](const std::string& name, const std::string& faces) {
    testing::put(directory_ / "meshes" / (name + ".obj"),
                 "v .05 0 0\nv -.05 0 0\nv 0 .05 0\nv 0 0 .05\n" + faces);
    write_object(object("<geom type='mesh' mesh='" + name + "' group='1'/>",
                        "<asset><mesh file='meshes/" + name + ".obj'/></asset>"));
    return world_message();
  };
  EXPECT_EQ(with("good", "f 1 2 3\nf 1 3 4\nf 2 4 3\nf 1 4 2\n"), "");
  EXPECT_THAT(with("turned", "f 1 3 2\nf 1 4 3\nf 2 3 4\nf 1 2 4\n"),
              HasSubstr("own.xml: the mesh 'turned' is inside out"));
}

TEST_F(ModelReaderTest, AVehicleIsAsSmallAsItsRotorsAndCamerasAreNear) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return changed_vehicle_message(from, to);
  };
  EXPECT_EQ(with("pos=\"0.12 0 0.075\"", "pos=\"0.12 0 0.6\""), "");
  EXPECT_THAT(with("pos=\"0.12 0 0.075\"", "pos=\"0.12 0 75\""),
              HasSubstr("a camera is 75 m from the vehicle's centre of mass, but must be within"));
  EXPECT_THAT(with("pos=\" 0.085  0.10 0.020\"", "pos=\" 85  100 0.020\""),
              HasSubstr("a rotor is 131 m from the vehicle's centre of mass"));
  EXPECT_EQ(with("mass=\"1.0\"", "mass=\"0.6\""), "");
  EXPECT_THAT(
      with("mass=\"1.0\"", "mass=\"0.5\""),
      HasSubstr("the vehicle's mass is 0.5 kg, but must be at least 0.599 kg for an inertia "
                "of 0.004 kg m^2 about y and rotors 0.085 m from that axis"));
}

TEST_F(ModelReaderTest, PaintHidesWhatIsBehindItAndThrowsBackNoMoreThanThereIs) {
  const auto with = [&](const std::string& geom) {
    write_object(object("<geom size='0.05' " + geom + "/>"));
    return world_message();
  };
  EXPECT_THAT(with("group='1' rgba='0.7 0.3 0.2 0.05'"),
              HasSubstr("own.xml: a geom's alpha is 0.05"));
  EXPECT_THAT(with("group='1' rgba='7 3 2 1'"), HasSubstr("own.xml: a geom's colour is above 1"));
  EXPECT_EQ(with("group='1' rgba='1 1 1 1'"), "");
  EXPECT_EQ(with("group='4' rgba='7 3 2 0.05'"), "");  // no camera sees it
}

TEST_F(ModelReaderTest, AnObjectNeedsItsBodyAFreeJointAndItsOriginAtTheCentreOfMass) {
  const std::string good = object("<geom size='0.05' group='1'/>");
  const auto with = [&](const std::string& from, const std::string& to) {
    return changed_message(good, from, to);
  };
  EXPECT_THAT(with("name='body'", "name='other'"), HasSubstr("no body named 'body'"));
  EXPECT_THAT(with("<freejoint/>", "<joint type='hinge'/>"), HasSubstr("free joint"));
  EXPECT_THAT(with("<freejoint/>", ""), HasSubstr("own.xml: the body must have a free joint"));
  for (const char* of_joint : {"damping", "armature", "frictionloss"}) {
    EXPECT_THAT(with("<freejoint/>", std::string("<joint type='free' ") + of_joint + "='0.1'/>"),
                HasSubstr("must have no damping, armature"));
  }
  EXPECT_THAT(with("<freejoint/>", "<joint type='free' stiffness='5'/>"),
              HasSubstr("must have no stiffness"));
  EXPECT_THAT(with("inertial pos='0 0 0'", "inertial pos='0 0.1 0'"), HasSubstr("centre of mass"));
  EXPECT_THAT(with("<inertial pos='0 0 0' mass='1' diaginertia='1e-3 1e-3 1e-3'/>", ""),
              HasSubstr("must have an <inertial>"));
  EXPECT_THAT(with("</body>", "<body><geom size='0.1'/></body></body>"),
              HasSubstr("no body within it"));
  EXPECT_THAT(with("drag_coefficient", "drag"), HasSubstr("drag_coefficient"));
}

}  // namespace
}  // namespace dodgesim
