#include "sim/files/npy_header.h"
#include "tests/complaint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace dodgesim {
namespace {

using testing::complaint;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(NpyHeader, ReadsWhatNumpyWrites) {
  const NpyHeader header = parse_npy_header(
      "{'descr': '<f4', 'fortran_order': False, 'shape': (10, 240, 320), }          \n");
  EXPECT_EQ(header.dtype, "<f4");
  EXPECT_FALSE(header.fortran_order);
  EXPECT_THAT(header.shape, ElementsAre(10, 240, 320));
}

TEST(NpyHeader, ReadsOtherSpellingsOfTheSame) {
  const NpyHeader header =
      parse_npy_header("{\"shape\":(7L,),\"fortran_order\":True,\"descr\":\"|u1\"}");
  EXPECT_EQ(header.dtype, "|u1");
  EXPECT_TRUE(header.fortran_order);
  EXPECT_THAT(header.shape, ElementsAre(7));
  EXPECT_THAT(parse_npy_header("{'descr':'<i8','fortran_order':False,'shape':()}").shape,
              IsEmpty());
  EXPECT_EQ(parse_npy_header("{'descr': [('t', '<i8'), ('x', [('a', '<u2')])], "
                             "'fortran_order': False, 'shape': (1,)}")
                .dtype,
            "[('t', '<i8'), ('x', [('a', '<u2')])]");
}

TEST(NpyHeader, SpellsTypesAsNumpyDoes) {
  const auto dtype = [](const std::string& descr) {
    return parse_npy_header("{'descr':'" + descr + "','fortran_order':False,'shape':()}").dtype;
  };
  for (const char* byte : {"|u1", "<u1", ">u1", "=u1", "u1"}) EXPECT_EQ(dtype(byte), "|u1");
  for (const char* number : {"<f4", "=f4", "f4"}) EXPECT_EQ(dtype(number), "<f4");
  for (const char* other : {">f4", "<f8", ">i8", "<U1", "<u12"}) {
    EXPECT_EQ(dtype(other), other);
  }
}

TEST(NpyHeader, SaysWhatIsWrong) {
  const std::string rest = ", 'fortran_order': False, 'shape': (1,)}";
  for (const auto& [text, message] : {
           std::pair<std::string, const char*>{"", "it ends too early"},
           {"[]", "\"{\" is missing"},
           {"{'descr': '<f4', 'fortran_order': False}", "the key shape is missing"},
           {"{'fortran_order': False, 'shape': ()}", "the key descr is missing"},
           {"{'descr': '<f4', 'shape': ()}", "the key fortran_order is missing"},
           {"{'descr': '<f4', 'descr': '<f4'" + rest, "the key descr is given twice"},
           {"{'colour': 'red'" + rest, "the key \"colour\" is unknown"},
           {"{'descr': '<f4" + rest.substr(0, 2), "a text does not end"},
           {"{'descr': [('t', '<i8'" + rest, "a list does not end"},
           {"{'descr': '<f4\x1b[2J'" + rest, "descr is no data type"},
           {"{'descr': 4" + rest, "a text in quotes is missing"},
           {"{'descr' '<f4'" + rest, "\":\" is missing"},
           {"{'descr': '<f4'" + rest + " import os", "something follows the dictionary"},
           {"{'descr': '<f4', 'fortran_order': 0, 'shape': ()}", "neither True nor False"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (-1,)}", "not a tuple of sizes"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': 3}", "\"(\" is missing"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999,)}",
            "not a tuple of sizes"},
       }) {
    EXPECT_THAT(complaint<std::invalid_argument>([&text = text] { parse_npy_header(text); }),
                HasSubstr(message))
        << text;
  }
}

TEST(NpyHeader, WritesAnAlignedFrontThatReadsBack) {
  const std::vector<std::vector<std::uint64_t>> shapes = {
      {}, {0}, {18446744073709551615u}, {1, 2, 3}};
  for (const auto& shape : shapes) {
    for (const std::size_t min_bytes : {0, 64, 65, 1000}) {
      const std::string front = npy_front("'<f4'", shape, min_bytes);
      EXPECT_EQ(front.size() % 64, 0u);
      EXPECT_GE(front.size(), min_bytes);
      EXPECT_EQ(front.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
      const std::size_t length =
          static_cast<unsigned char>(front[8]) + 256u * static_cast<unsigned char>(front[9]);
      EXPECT_EQ(length, front.size() - 10);
      EXPECT_EQ(front.back(), '\n');
      const NpyHeader header = parse_npy_header(front.substr(10));
      EXPECT_EQ(header.dtype, "<f4");
      EXPECT_FALSE(header.fortran_order);
      EXPECT_EQ(header.shape, shape);
    }
  }
}

}  // namespace
}  // namespace dodgesim
