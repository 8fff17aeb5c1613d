#include "sim/world/models_digest.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/models.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

// Of a copy of the models that a test may change.
class ModelsDigest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = testing::copy_models(own_.path());
    spec_ = test_spec({{"ball", 0.2}});
    spec_.room = "room";
    spec_.models_dir = directory_.string();
    before_ = models_digest(spec_);
  }

  std::string read(const std::string& file) const { return testing::contents(directory_ / file); }
  void write(const std::string& file, const std::string& text) const {
    testing::put(directory_ / file, text);
  }
  std::uint64_t digest() const { return models_digest(spec_); }

  testing::TemporaryDirectory own_;
  fs::path directory_;
  WorldSpec spec_;
  std::uint64_t before_ = 0;
};

TEST_F(ModelsDigest, IsThatOfACopyElsewhere) {
  spec_.models_dir = test_spec().models_dir;
  EXPECT_EQ(digest(), before_);
}

TEST_F(ModelsDigest, ChangesWithAnyAttributeOfAnyModel) {
  for (const char* file : {"vehicles/qav_rxl.xml", "objects/ball.xml"}) {
    const std::string text = read(file);
    std::string changed = text;
    const std::size_t digit = changed.find_first_of("123456789", changed.find("inertia=\""));
    ASSERT_NE(digit, std::string::npos);
    changed[digit] = changed[digit] == '9' ? '8' : static_cast<char>(changed[digit] + 1);
    write(file, changed);
    EXPECT_NE(digest(), before_) << file;
    write(file, text);
  }
  EXPECT_EQ(digest(), before_);
  std::string room = read("rooms/room.xml");
  room.replace(room.find("lamp_left"), 9, "lamp_lost");
  write("rooms/room.xml", room);
  EXPECT_NE(digest(), before_);
}

TEST_F(ModelsDigest, ChangesWithATexture) {
  std::string texture = read("textures/wall.png");
  texture.back() = static_cast<char>(texture.back() ^ 1);
  write("textures/wall.png", texture);
  EXPECT_NE(digest(), before_);
}

TEST_F(ModelsDigest, DoesNotChangeWithACommentOrAModelThatNobodyNames) {
  write("rooms/room.xml", "<!-- newly painted -->\n" + read("rooms/room.xml"));
  write("objects/box.xml", "");
  EXPECT_EQ(digest(), before_);
}

TEST_F(ModelsDigest, ChangesWithTheKindOfAnObjectButNotWithItsSize) {
  spec_.objects[0].size_m = 0.3;
  EXPECT_EQ(digest(), before_);
  spec_.objects[0].kind = "box";
  EXPECT_NE(digest(), before_);
}

}  // namespace
}  // namespace dodgesim
