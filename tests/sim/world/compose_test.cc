#include "sim/world/compose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/world/own_models.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string message_of(const WorldSpec& spec) {
  return testing::complaint<ScenarioError>([&] { compose_model(spec); });
}

TEST(ComposeTest, BothRoomsCompileWithEveryObject) {
  for (const char* room : {"room", "field"}) {
    WorldSpec spec = test_spec({{"ball", 0.1}, {"box", 0.2}, {"ball", 0.3}});
    spec.room = room;
    const MjModelPtr model = compose_model(spec);
    EXPECT_EQ(model->nv, 6 * 4);
    EXPECT_GE(mj_name2id(model.get(), mjOBJ_BODY, "object2/body"), 0);
    EXPECT_EQ(model->opt.timestep, 250e-6);
    EXPECT_EQ(model->opt.gravity[2], -9.81);
    EXPECT_EQ(model->opt.density, 0);
  }
}

TEST(ComposeTest, AMissingModelIsNamed) {
  EXPECT_THAT(message_of(test_spec({{"teapot", 0.2}})),
              AllOf(HasSubstr("objects/teapot.xml"), HasSubstr("does not exist")));
  WorldSpec spec = test_spec();
  spec.room = "palace";
  EXPECT_THAT(message_of(spec), HasSubstr("rooms/palace.xml does not exist"));
  spec = test_spec();
  spec.vehicle = "zeppelin";
  EXPECT_THAT(message_of(spec), HasSubstr("vehicles/zeppelin.xml does not exist"));
}

TEST(ComposeTest, NamesThatLeaveTheModelsFolderAreRefused) {
  for (const char* kind : {"../ball", "/etc/passwd", "a/b", "", ".", "ball.xml", "ba ll"}) {
    EXPECT_THAT(message_of(test_spec({{kind, 0.2}})), HasSubstr("must consist of letters"));
  }
  WorldSpec spec = test_spec();
  spec.room = "../rooms/room";
  EXPECT_THAT(message_of(spec), HasSubstr("must consist of letters"));
}

TEST(ComposeTest, SizesOutOfRangeAreRefused) {
  for (const double size_m : {-1.0, 0.0, 0.001, 5.0, std::nan("")}) {
    EXPECT_THAT(message_of(test_spec({{"ball", size_m}})), HasSubstr("size_m"));
  }
}

TEST_F(OwnModels, GeometryMassAndInertiaScaleWithTheSize) {
  write_object(
      object("<geom type='box' pos='0 0 0.02' size='0.05 0.02 0.01' group='1' "
             "contype='4' conaffinity='7'/>"
             "<geom type='capsule' fromto='0 0 0 0.03 0 0' size='0.005' group='1'/>"));
  World world(spec_);  // twice the reference size
  const mjModel& model = world.model();
  const int body = world.object_body(0), geom = model.body_geomadr[body];
  EXPECT_DOUBLE_EQ(model.geom_size[3 * geom], 0.1);
  EXPECT_DOUBLE_EQ(model.geom_pos[3 * geom + 2], 0.04);
  EXPECT_DOUBLE_EQ(model.geom_size[3 * geom + 3], 0.01);
  EXPECT_NEAR(model.geom_size[3 * geom + 4], 0.03, 1e-12);  // half the capsule's length
  EXPECT_DOUBLE_EQ(world.object(0).mass_kg, 8);
  EXPECT_DOUBLE_EQ(model.body_inertia[3 * body], 0.032);
  EXPECT_DOUBLE_EQ(world.object(0).drag_area_m2, 0.04);
}

TEST_F(OwnModels, AssetsOutsideTheFolderAreRefused) {
  for (const char* file : {"../../secret.png", "/etc/passwd", "textures/../../x.png"}) {
    write_object(object("<geom size='0.05'/>",
                        "<asset><texture type='2d' file='" + std::string(file) + "'/></asset>"));
    EXPECT_THAT(message_of(spec_), AllOf(HasSubstr("own.xml"), HasSubstr("leaves the models")));
  }
  write_object(object("<geom size='0.05'/>", "<include file='ball.xml'/>"));
  EXPECT_THAT(message_of(spec_), HasSubstr("must not use <include>"));
}

TEST_F(OwnModels, ObjectsMustNotChangeTheWorldAroundThem) {
  for (const char* element : {"<option gravity='0 0 0'/>", "<compiler angle='radian'/>",
                              "<size njmax='1'/>", "<default/>"}) {
    write_object(object("<geom size='0.05'/>", element));
    EXPECT_THAT(message_of(spec_), HasSubstr("must not use"));
  }
}

TEST_F(OwnModels, AnObjectIsOneBodyWithNothingBesideIt) {
  for (const char* beside :
       {"<geom size='0.5'/>", "<body name='other'><geom size='0.1'/></body>"}) {
    std::string text = object("<geom size='0.05'/>");
    text.insert(text.find("</worldbody>"), beside);
    write_object(text);
    EXPECT_THAT(message_of(spec_),
                AllOf(HasSubstr("own.xml:1: "), HasSubstr("must hold one <body>")));
  }
}

TEST_F(OwnModels, AnObjectStandsWhereAThrowBegins) {
  const std::string good = object("<geom size='0.05'/>");
  const auto with = [&](const std::string& from, const std::string& to) {
    return changed_message(good, from, to);
  };
  EXPECT_EQ(with("<body name='body'>", "<body name='body'>"), "");
  EXPECT_THAT(with("<body name='body'>", "<body name='body' euler='0 0 90'>"),
              HasSubstr("own.xml:1: The body of an object must have no euler"));
  EXPECT_THAT(with("<body name='body'>", "<body name='body' pos='0 0 5'>"),
              HasSubstr("must have no pos"));
  EXPECT_THAT(with("mass_exponent' data='3'", "mass_exponent' data='-3'"),
              HasSubstr("own.xml: mass_exponent must be between 0 and 3"));
  EXPECT_THAT(with("mass_exponent' data='3'", "mass_exponent' data='3.5'"), HasSubstr("not 3.5"));
}

TEST_F(OwnModels, RoomsMustStandStill) {
  std::ofstream(directory_ / "rooms" / "own.xml")
      << "<mujoco><worldbody>\n<body><freejoint/><geom size='1'/></body></worldbody></mujoco>";
  spec_.room = "own";
  write_object(object("<geom size='0.05'/>"));
  EXPECT_THAT(message_of(spec_),
              AllOf(HasSubstr("rooms/own.xml:2: "), HasSubstr("must not use <freejoint>")));
}

TEST_F(OwnModels, WhatOnlyMujocoWouldDrawIsRefused) {
  const std::string object_text = object("<geom size='0.05'/>");
  write_object(object_text);
  spec_.room = "own";
  const std::string room =
      "<mujoco><worldbody><body>\n<geom size='1'/></body></worldbody></mujoco>";
  testing::put(directory_ / "rooms" / "own.xml", room);
  EXPECT_EQ(message_of(spec_), "");
  const std::string vehicle = testing::contents(directory_ / "vehicles" / "qav_rxl.xml");
  for (const auto& [file, text] :
       {std::pair("rooms/own.xml", room), std::pair("vehicles/qav_rxl.xml", vehicle),
        std::pair("objects/own.xml", object_text)}) {
    std::string grid = text;
    grid.insert(grid.find("</body>"), "<composite type='grid' count='3 3 1' spacing='0.1'/>");
    testing::put(directory_ / file, grid);
    EXPECT_THAT(message_of(spec_), AllOf(HasSubstr(file), HasSubstr("must not use <composite>")));
    testing::put(directory_ / file, text);
  }
}

TEST_F(OwnModels, NamesThatRoomAndVehicleShareAreReportedWithBothFiles) {
  write_object(object("<geom size='0.05'/>"));
  spec_.room = "own";
  testing::put(directory_ / "rooms" / "own.xml",
               "<mujoco><worldbody><geom name='hull' size='1'/></worldbody></mujoco>");
  EXPECT_THAT(message_of(spec_), AllOf(HasSubstr("rooms/own.xml with "),
                                       HasSubstr("vehicles/qav_rxl.xml: "), HasSubstr("hull")));
}

// The cameras' scene has lights that stay where they are.
TEST_F(OwnModels, WhatFliesBringsNoLight) {
  const std::string lamp = "<light pos='0 0 0' dir='1 0 0'/>", good = object("<geom size='0.05'/>");
  write_object(object("<geom size='0.05'/>" + lamp));
  EXPECT_THAT(message_of(spec_), HasSubstr("The model of an object must not use <light>"));
  write_object(object("<geom size='0.05'/>", "<visual><headlight ambient='1 1 1'/></visual>"));
  EXPECT_THAT(message_of(spec_), HasSubstr("The model of an object must not use <visual>"));
  write_object(good);
  const std::filesystem::path path = directory_ / "vehicles" / "qav_rxl.xml";
  std::string lit = testing::contents(path);
  lit.insert(lit.find("</body>"), lamp);
  testing::put(path, lit);
  EXPECT_THAT(message_of(spec_), HasSubstr("The model of a vehicle must not use <light>"));
}

// Throws, controller and IMU know of gravity, too.
TEST_F(OwnModels, RoomsAndVehiclesMustNotChangeGravityAndAir) {
  write_object(object("<geom size='0.05'/>"));
  for (const std::string& file :
       {"rooms/" + spec_.room + ".xml", "vehicles/" + spec_.vehicle + ".xml"}) {
    const std::filesystem::path path = directory_ / file;
    const std::string text = testing::contents(path);
    std::string moon = text;
    moon.insert(moon.rfind("</mujoco>"), "<option gravity='0 0 -1.62'/>");
    std::filesystem::remove(path);
    testing::put(path, moon);
    EXPECT_THAT(message_of(spec_), AllOf(HasSubstr(file), HasSubstr("must not use <option>")));
    std::filesystem::remove(path);
    testing::put(path, text);
  }
  EXPECT_EQ(message_of(spec_), "");
}

TEST_F(OwnModels, DefaultsOfARoomAreOfItsOwnClasses) {
  spec_.room = "own";
  write_object(object("<geom size='0.05'/>"));
  const auto room = [&](const std::string& defaults, const std::string& attribute) {
    std::ofstream(directory_ / "rooms" / "own.xml")
        << "<mujoco><default>\n"
        << defaults << "</default><worldbody><geom " << attribute
        << " size='1'/></worldbody></mujoco>";
    return message_of(spec_);
  };
  EXPECT_THAT(room("<geom rgba='1 0 0 1'/>", ""),
              AllOf(HasSubstr("rooms/own.xml:2: "), HasSubstr("<default> without a class")));
  EXPECT_EQ(room("<default class='wall'><geom rgba='1 0 0 1'/></default>", "class='wall'"), "");
}

TEST_F(OwnModels, NothingOfARoomIsSeenByTheCamerasAloneOrByTheRangeSensorAlone) {
  spec_.room = "own";
  write_object(object("<geom size='0.05'/>"));
  const auto geom_in_group = [&](int group) {
    std::ofstream(directory_ / "rooms" / "own.xml")
        << "<mujoco><worldbody><geom name='wall' size='1' group='" << group
        << "'/></worldbody></mujoco>";
    return world_message();
  };
  EXPECT_EQ(geom_in_group(0), "");
  EXPECT_EQ(geom_in_group(4), "");
  for (const int group : {1, 2, 3}) {
    EXPECT_THAT(geom_in_group(group),
                AllOf(HasSubstr("rooms/own.xml: "), HasSubstr("wall is in group")));
  }
}

// A dodged object lies down on all of its geoms.
TEST_F(OwnModels, AnObjectOfManyGeomsMayLieOnTheFloor) {
  std::string slats;
  for (int i = 0; i < 14; ++i) {
    slats += "<geom type='box' size='0.05 0.003 0.0025' pos='0 " +
             std::to_string(0.0066 * i - 0.043) + " 0' contype='4' conaffinity='7'/>";
  }
  write_object(object(slats));
  World world(spec_);
  BodyState thrown;
  thrown.p_W = {3, 0, 0.05};
  world.reset({0, 0, 2}, 0, Eigen::Vector3d::Zero());
  world.launch(0, thrown);
  const double hover_n = 0.25 * world.vehicle().mass_kg * kGravityMps2;
  for (int tick = 0; tick < 1600; ++tick) {
    ASSERT_NO_THROW(world.step({hover_n, hover_n, hover_n, hover_n})) << tick;
  }
  EXPECT_LT(world.snapshot().objects[0].p_W.z(), 0.03);
}

TEST_F(OwnModels, BrokenFilesGiveOneSentenceWithTheFile) {
  const std::vector<std::string> broken = {
      "",
      "not xml",
      "<mujoco>",
      "<mujoco><worldbody></mujoco>",
      "<mujoco><!-- no end </mujoco>",
      "<mujoco a='1></mujoco>",
      "<!DOCTYPE x [<!ENTITY a 'b'>]><mujoco></mujoco>",
      object("<geom type='blob' size='0.1'/>"),
      object("<geom type='mesh' mesh='none'/>"),
      object("<geom size='nan'/>"),
      object("<geom size='1e999'/>"),
      object("<geom size='0.1' name='&quot;'/>"),
      object("</body>"),
      "<mujoco><custom><numeric name='reference_size_m' data='0'/></custom></mujoco>",
  };
  for (const std::string& text : broken) {
    write_object(text);
    EXPECT_THAT(message_of(spec_), AllOf(HasSubstr("own.xml"), ::testing::EndsWith("."))) << text;
  }
}

TEST_F(OwnModels, ErrorsOfMujocoNameFileAndLine) {
  write_object("<mujoco>\n<!-- a\ncomment -->\n" + object("<geom\n type='blob'/>").substr(8));
  EXPECT_THAT(message_of(spec_), AllOf(HasSubstr("objects/own.xml: "), HasSubstr("line 4")));
  write_object("<mujoco>\n\n<custom");
  EXPECT_THAT(message_of(spec_), HasSubstr("objects/own.xml:3: "));
}

TEST_F(OwnModels, AMissingTextureIsNamed) {
  write_object(object("<geom size='0.05'/>",
                      "<asset><texture name='t' type='2d' file='textures/none.png'/></asset>"));
  EXPECT_THAT(message_of(spec_), AllOf(HasSubstr("own.xml"), HasSubstr("none.png")));
}

TEST_F(OwnModels, AMeshWithoutAScaleIsScaledToo) {
  constexpr const char* kTetrahedron = "vertex='0.05 0 0 -0.05 0 0 0 0.05 0 0 0 0.05'";
  for (const char* scale : {"", " scale='1 1 1'"}) {
    write_object(object("<geom type='mesh' mesh='m'/>", std::string("<asset><mesh name='m' ") +
                                                            kTetrahedron + scale + "/></asset>"));
    const World world(spec_);
    const auto* vertex = world.model().mesh_vert;
    double longest_m = 0;
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 4; ++k) {
        const auto at = [vertex](int n) {
          return Eigen::Map<const Eigen::Vector3f>(vertex + 3 * n).cast<double>().eval();
        };
        longest_m = std::max(longest_m, (at(i) - at(k)).norm());
      }
    }
    EXPECT_NEAR(longest_m, 0.2, 1e-6) << scale;  // 0.1 at the reference size of 0.1
  }
}

TEST_F(OwnModels, AMeshAndATextureMayHaveTheNamesOfTheirFiles) {
  std::filesystem::create_directories(directory_ / "meshes");
  testing::put(directory_ / "meshes" / "rock.obj",
               "v 0.05 0 0\nv -0.05 0 0\nv 0 0.05 0\nv 0 0 0.05\n"
               "f 1 2 3\nf 1 3 4\nf 2 4 3\nf 1 4 2\n");
  write_object(object("<geom type='mesh' mesh='rock' material='grey'/>",
                      "<asset><mesh file='meshes/rock.obj'/>"
                      "<texture type='2d' file='textures/floor.png'/>"
                      "<material name='grey' texture='floor'/></asset>"));
  spec_.objects.push_back(spec_.objects[0]);  // the names of both are kept apart
  const World world(spec_);
  EXPECT_EQ(world.model().nmesh, 2);
  EXPECT_GE(mj_name2id(&world.model(), mjOBJ_MESH, "object1/rock"), 0);
}

}  // namespace
}  // namespace dodgesim
