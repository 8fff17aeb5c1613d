#include "sim/world/model_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/models.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A copy of the models with an object of the test's own.
class ModelTrial : public ::testing::Test {
 protected:
  ModelTrial() {
    directory_ = testing::copy_models(own_.path());
    fs::create_directories(directory_ / "meshes");
    spec_ = test_spec({{"ball", 0.2}, {"own", 0.2}});
    spec_.models_dir = directory_.string();
  }
  void write(const std::string& file, const std::string& text) const {
    testing::put(directory_ / file, text);
  }
  void write_object(const std::string& geom, const std::string& asset = "",
                    const std::string& inertia = "1e-3 1e-3 1e-3") const {
    write("objects/own.xml",
          "<mujoco><custom><numeric name='reference_size_m' data='0.1'/>"
          "<numeric name='mass_exponent' data='3'/><numeric name='drag_coefficient' data='1'/>"
          "<numeric name='frontal_area_m2' data='0.01'/></custom><asset>" +
              asset +
              "</asset><worldbody><body name='body'><freejoint/><inertial pos='0 0 0' mass='1' "
              "diaginertia='" +
              inertia + "'/>" + geom + "</body></worldbody></mujoco>");
  }
  // An object that is a mesh, with a ball that can collide.
  void write_mesh(const std::string& obj) const {
    write("meshes/own.obj", obj);
    write_object(std::string(kBall) + "<geom type='mesh' mesh='m' group='1'/>",
                 "<mesh name='m' file='meshes/own.obj'/>");
  }
  std::string complaint(const TrialLimits& limits = {}) const {
    return testing::complaint<ScenarioError>([&] { try_world(spec_, {}, {}, limits); });
  }

  static constexpr const char* kBall = "<geom size='0.05' group='1' contype='4' conaffinity='7'/>";
  testing::TemporaryDirectory own_;
  fs::path directory_;
  WorldSpec spec_;
};

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(ModelTrial, GoodModelsPass) {
  write_object(kBall);
  EXPECT_EQ(complaint(), "");
  write_mesh(kTetrahedron);
  EXPECT_EQ(complaint(), "");
}

// The solid half of a ceiling that is a plane reaches up for ever.
TEST_F(ModelTrial, AllObjectsOfTheProjectFlyTogetherInEachOfItsRooms) {
  spec_.objects.clear();
  for (const auto& entry : fs::directory_iterator(fs::path(testing::kModels) / "objects")) {
    spec_.objects.push_back({entry.path().stem().string(), 0.2});
  }
  ASSERT_GE(spec_.objects.size(), 6u);
  for (const auto& entry : fs::directory_iterator(fs::path(testing::kModels) / "rooms")) {
    spec_.room = entry.path().stem().string();
    EXPECT_EQ(complaint(), "") << spec_.room;
  }
}

TEST_F(ModelTrial, AnObjectThatIsVeryLightFliesUnderACeiling) {
  write_object(kBall, "", "1e-6 1e-6 1e-6");
  std::string object = testing::contents(directory_ / "objects/own.xml");
  const std::string mass = "mass='1'";
  write("objects/own.xml", object.replace(object.find(mass), mass.size(), "mass='0.003'"));
  spec_.room = "room";
  EXPECT_EQ(complaint(), "");
}

TEST_F(ModelTrial, APlaceInsideOrOutsideOfWhatStandsThereCostsASentence) {
  write_object(kBall);
  spec_.room = "room";
  const auto complaint_at = [&](double x_m, double z_m) -> std::string {
    return testing::complaint<ScenarioError>([&] {
      try_world(spec_, {{"mission.start_m", {0, 0, 2}, 0}, {"mission.goal_m", {x_m, 0, z_m}, 1}});
    });
  };
  EXPECT_EQ(complaint_at(1, 2), "");
  for (const auto& [x_m, z_m] : {std::pair{0.0, 0.01}, {0.0, -3.0}, {50.0, 2.0}}) {
    EXPECT_THAT(complaint_at(x_m, z_m), HasSubstr("move mission.goal_m")) << x_m << " " << z_m;
  }
}

TEST_F(ModelTrial, AMeshThatCrashesMujocoCostsASentence) {
  write_object(std::string(kBall) + "<geom type='mesh' mesh='m' group='1'/>",
               "<mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='0 1 400000000'/>");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("objects/own.xml"), ::testing::EndsWith(".")));
}

TEST_F(ModelTrial, AMeshThatMujocoWouldMisreadIsNamedWithItsLine) {
  write_mesh(std::string(kTetrahedron) + "f 1 2 5\n");
  EXPECT_THAT(complaint(), ::testing::MatchesRegex(
                               ".*objects/own.xml:1: The mesh .*/meshes/own.obj, line 9: the "
                               "face's corner '5' names a vertex that does not exist: .*\\."));
  // As MuJoCo needs no point to take it for one.
  write("meshes/own_obj", std::string(kTetrahedron) + "f 1 2 5\n");
  write_object(kBall, "<mesh name='m' file='meshes/own_obj'/>");
  EXPECT_THAT(complaint(), HasSubstr("own_obj, line 9: the face's corner '5'"));
}

TEST_F(ModelTrial, AFlatMeshThatCollidesIsExplained) {
  write("meshes/own.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0.1 0.1 0\nf 1 2 3\nf 2 4 3\n");
  write_object("<geom type='mesh' mesh='m' group='1' contype='4' conaffinity='7'/>",
               "<mesh name='m' file='meshes/own.obj'/>");
  EXPECT_THAT(complaint(), HasSubstr("are the mesh's points in one plane?"));
}

TEST_F(ModelTrial, BrokenMeshesCostASentence) {
  for (const std::string& obj :
       {std::string(), std::string("not a mesh"), std::string("v 0 0 0\nv nan 0 0\nv 0 1 0\n"),
        std::string("f -5 -6 -7\n"), std::string(100000, '\xff')}) {
    write_mesh(obj);
    const std::string found = complaint();
    EXPECT_THAT(found, AllOf(HasSubstr("own"), ::testing::EndsWith("."))) << obj.substr(0, 80);
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

TEST_F(ModelTrial, NumbersThatAreNoneCostASentence) {
  write_object("<geom size='0.05' pos='nan 0 0' group='1' contype='4' conaffinity='7'/>");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("own.xml"), ::testing::EndsWith(".")));
  write_object(kBall, "", "1 1 nan");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("own.xml"), ::testing::EndsWith(".")));
  write_object(kBall, "", "1 1 1e300");
  EXPECT_THAT(complaint(), ::testing::EndsWith("."));
}

// As a decoder would have to unpack them: a PNG says its size in its first bytes.
std::string png_head(unsigned char size_high_byte) {
  std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  for (int k = 0; k < 2; ++k) head += std::string{'\0', static_cast<char>(size_high_byte), '\0', 1};
  return head + std::string("\x08\x02\0\0\0", 5) + "rest";
}

TEST_F(ModelTrial, HugeAndBrokenTexturesCostASentence) {
  const auto with_texture = [&](const std::string& attributes) {
    write_object("<geom size='0.05' material='m' group='1' contype='4' conaffinity='7'/>",
                 "<texture name='t' " + attributes + "/><material name='m' texture='t'/>");
    return complaint();
  };
  write("textures/own.png", png_head(1));  // 65537 pixels
  EXPECT_THAT(with_texture("type='2d' file='textures/own.png'"),
              HasSubstr("own.png has 65537 x 65537 pixels; at most 4096 x 4096 are allowed."));
  write("textures/own.png", png_head(0));
  EXPECT_THAT(with_texture("type='2d' file='textures/own.png'"),
              AllOf(HasSubstr("own"), ::testing::EndsWith(".")));
  // MuJoCo would take what is not named so for a format of its own, and not check its size.
  const std::string raw("\xfe\xff\xff\xff\xfe\xff\xff\xff\0\0\0\0\0\0\0\0\0\0\0\0", 20);
  write("textures/own.bin", raw);
  EXPECT_THAT(with_texture("type='2d' file='textures/own.bin'"),
              ::testing::EndsWith("textures/own.bin must be a PNG file named *.png."));
  write("textures/own.bin", testing::contents(directory_ / "textures/floor.png"));
  EXPECT_THAT(with_texture("type='2d' file='textures/own.bin'"), HasSubstr("named *.png."));
  write("textures/own.PNG", testing::contents(directory_ / "textures/floor.png"));
  EXPECT_EQ(with_texture("type='2d' file='textures/own.PNG'"), "");
  write("textures/own.png", std::string(1000, 'x'));
  EXPECT_THAT(with_texture("type='cube' fileright='textures/own.png'"),
              ::testing::EndsWith("textures/own.png must be a PNG file named *.png."));
  EXPECT_THAT(with_texture("type='cube' builtin='flat' width='100000' height='100000'"),
              HasSubstr("own.xml:1: A texture has at most 4096 x 4096 pixels."));
  write("textures/own.png", std::string((32 << 20) + 1, 'x'));
  EXPECT_THAT(with_texture("type='2d' file='textures/own.png'"), HasSubstr("larger than 32 MB"));
}

TEST_F(ModelTrial, NoLinkLeadsOutOfTheFolder) {
  fs::path outside = directory_;
  outside += "_outside.png";
  std::ofstream(outside) << "anything";
  fs::create_symlink(outside, directory_ / "textures/link.png");
  write_object(kBall, "<texture name='t' type='2d' file='textures/link.png'/>");
  EXPECT_THAT(complaint(), HasSubstr("The path 'textures/link.png' leaves the models folder."));
  fs::remove(outside);
}

TEST_F(ModelTrial, TakesNoMoreTimeThanAllowed) {
  write_object(kBall);
  TrialLimits limits;
  limits.wall_ms = 0;
  EXPECT_THAT(complaint(limits), HasSubstr("take longer than 0 s to load."));
}

TEST_F(ModelTrial, TakesNoMoreMemoryThanAllowed) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "Sanitizers reserve more address space than any limit allows.";
#endif
  write_object(kBall,  // 302 MB
               "<texture name='t' type='cube' builtin='flat' width='4096' height='4096'/>");
  EXPECT_EQ(complaint(), "");
  TrialLimits limits;
  limits.memory_mb = 256;
  EXPECT_THAT(complaint(limits), AllOf(HasSubstr("own"), ::testing::EndsWith(".")));
}

TEST_F(ModelTrial, ABodyThatNothingCanTouchIsReportedWithItsFile) {
  write_object("<geom size='0.05' group='1' contype='0' conaffinity='0'/>");
  EXPECT_THAT(complaint(), HasSubstr("objects/own.xml: The body has no geom that can collide"));
}

}  // namespace
}  // namespace dodgesim
