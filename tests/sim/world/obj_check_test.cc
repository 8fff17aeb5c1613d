#include "sim/world/obj_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kFourVertices = "v 0 0 0\nv 1 0 0\nv 0 1e-1 0\nv 0 0 +1.5\n";
const std::string kFourFaces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string complaint_about(const std::string& more) {
  return complaint_about_obj(kFourVertices + more);
}

TEST(ObjCheckTest, WhatProgramsWriteIsGood) {
  EXPECT_EQ(complaint_about(kFourFaces), "");
  EXPECT_EQ(complaint_about(""), "") << "MuJoCo makes the hull of points without faces";
  EXPECT_EQ(complaint_about("f -4 -2 -3 -1 # a quad"), "");
  EXPECT_EQ(
      complaint_about_obj("# ours\r\nmtllib ours.mtl\r\no body\r\n" + kFourFaces + kFourVertices),
      "")
      << "faces may come before their points";
  EXPECT_EQ(complaint_about("g body\ns off\nusemtl red\nf 1 3 2\nusemtl blue\nf 1 2 4\n"), "");
  EXPECT_EQ(complaint_about("vt 0 1\nvt 1 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/-1\n"), "");
  EXPECT_EQ(complaint_about("vn 0 0 1\n\tf  1//1\t2//1  3//1 \n"), "");
  EXPECT_EQ(complaint_about("v 00.50 -1.e3 .5\n"), "");
  EXPECT_EQ(complaint_about("v 0 0 0 1 0.5 0.5 0.5\nv 1 0 0 red\n"), "") << "colours";
}

TEST(ObjCheckTest, AFaceNamesWhatThereIs) {
  EXPECT_EQ(complaint_about("f 1 3 5\n"),
            "line 5: the face's corner '5' names a vertex that does not exist: "
            "the file has 4");
  EXPECT_THAT(complaint_about("f 1 -5 2\nv 0 0 0\n"),
              StartsWith("line 5: the face's corner '-5' names a"));
  EXPECT_THAT(complaint_about("f 1 -5 2\nv 0 0 0\n"), HasSubstr("has 4 so far"));
  EXPECT_THAT(complaint_about("f 1 2 -9223372036854775808\n"), HasSubstr("does not exist"));
  EXPECT_EQ(complaint_about("v 0 0 0\nf 1 -5 2\n"), "");
  EXPECT_THAT(complaint_about("# hidden\rf 1 3 5\n"), StartsWith("line 6: "));
  EXPECT_THAT(complaint_about("vt 0 0\nf 1/1 2/2 3/1\n"),
              HasSubstr("'2/2' names a texture coordinate"));
  EXPECT_THAT(complaint_about("vn 0 0 1\nf 1//1 2//2 3//1\n"),
              HasSubstr("'2//2' names a normal that"));
  EXPECT_THAT(complaint_about("f 1/1 2/1 3/1\n"), HasSubstr("that does not exist: the file has 0"));
}

TEST(ObjCheckTest, NumbersOfPointsAreWhole) {
  for (const char* corner : {"0", "a", "1.5", "99999999999999999999", "\\", "1\v"}) {
    EXPECT_THAT(complaint_about(std::string("f 1 2 ") + corner), HasSubstr("counted from 1"))
        << corner;
  }
  EXPECT_THAT(complaint_about("vt 0 0\nvn 0 0 1\nf 1/1/1/1 2/1/1 3/1/1"),
              HasSubstr("more than three parts"));
}

// MuJoCo would read what lies before the first.
TEST(ObjCheckTest, WhereThereAreNormalsOrTextureCoordinatesAllFacesNameThem) {
  EXPECT_THAT(complaint_about("vt 0 0\nf 1 2 3\n"),
              HasSubstr("names no texture coordinate, though"));
  EXPECT_THAT(complaint_about("vn 0 0 1\nf 1//1 2//1 3\n"),
              HasSubstr("'3' names no normal, though"));
  EXPECT_THAT(complaint_about("f 1 2 3\nvn 0 0 1\n"), StartsWith("line 5: "));
}

// MuJoCo would leave the second out.
TEST(ObjCheckTest, FacesAreOfOneObjectOrGroup) {
  EXPECT_EQ(complaint_about("o first\ng first\nf 1 2 3\n"), "");
  EXPECT_THAT(complaint_about("o first\nf 1 2 3\no second\nf 1 4 3\n"),
              StartsWith("line 8: a second object or group has faces"));
  EXPECT_THAT(complaint_about("f 1 2 3\ng second\nf 1 4 3\n"), StartsWith("line 7: "));
  EXPECT_EQ(complaint_about("f 1 2 3\ng empty\n"), "");
  EXPECT_EQ(complaint_about("f 1 2 3\ng\nf 1 4 3\n"), "") << "no name, no group";
  EXPECT_THAT(complaint_about("f 1 2 3\ng \nf 1 4 3\n"), StartsWith("line 7: "));
}

TEST(ObjCheckTest, CoordinatesAreFiniteNumbers) {
  EXPECT_EQ(complaint_about_obj("v 0 0 0\nv nan 0 0\n"), "line 2: 'nan' is not a finite number");
  EXPECT_THAT(complaint_about_obj("v 0,5 0 0\n"), HasSubstr("'0,5' is not a finite number"));
  EXPECT_THAT(complaint_about_obj("v 0 1e999 0\n"), HasSubstr("'1e999' is not a finite number"));
  EXPECT_EQ(complaint_about_obj("v 0 0\n"), "line 1: a vertex has 3 numbers");
  EXPECT_EQ(complaint_about_obj("vt 0\n"), "line 1: a texture coordinate has 2 numbers");
}

TEST(ObjCheckTest, ASolidHasFourVertices) {
  EXPECT_EQ(complaint_about_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            "line 4: the file ends after 3 vertices, but a solid has at least 4");
  EXPECT_THAT(complaint_about_obj(""), StartsWith("line 0: the file ends after 0 vertices"));
}

}  // namespace
}  // namespace dodgesim
