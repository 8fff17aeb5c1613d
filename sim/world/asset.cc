#include "sim/world/asset.h"

#include <strings.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/world/obj_check.h"

namespace dodgesim {

namespace {

constexpr std::uint32_t kMaxTexturePx = 4096;  // a side

// Width and height of a PNG file; nothing for any other file.
std::optional<std::array<std::uint32_t, 2>> png_size(const std::string& path) {
  constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::array<unsigned char, 24> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  if (!file || !std::equal(kSignature.begin(), kSignature.end(), head.begin())) {
    return std::nullopt;
  }
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | head[i];
    return value;
  };
  return std::array<std::uint32_t, 2>{number(16), number(20)};
}

// MuJoCo tells by the last characters, with a point before them or not.
bool ends_with(const std::string& path, std::string_view ending) {
  return path.size() >= ending.size() &&
         strncasecmp(path.data() + path.size() - ending.size(), ending.data(), ending.size()) == 0;
}

void check_texture_file(const std::string& path, const std::string& where) {
  const auto size = png_size(path);
  if (!size || !ends_with(path, ".png")) {
    throw ScenarioError(where + "The texture " + path + " must be a PNG file named *.png.");
  }
  if (std::max((*size)[0], (*size)[1]) > kMaxTexturePx) {
    throw ScenarioError(where + "The texture " + path + " has " + std::to_string((*size)[0]) +
                        " x " + std::to_string((*size)[1]) + " pixels; at most " +
                        std::to_string(kMaxTexturePx) + " x " + std::to_string(kMaxTexturePx) +
                        " are allowed.");
  }
}

void check_texture_size(const std::vector<double>& pixels, const std::string& where) {
  if (std::ranges::all_of(pixels, [](double side) { return side <= kMaxTexturePx; })) return;
  throw ScenarioError(where + "A texture has at most " + std::to_string(kMaxTexturePx) + " x " +
                      std::to_string(kMaxTexturePx) + " pixels.");
}

void check_mesh_file(const std::string& path, const std::string& where) {
  if (!ends_with(path, "obj")) return;
  const std::string complaint = complaint_about_obj(read_file(path));
  if (complaint.empty()) return;
  throw ScenarioError(where + "The mesh " + path + ", " + complaint + ".");
}

}  // namespace

void check_assets(const std::vector<MjcfTag>& tags, const std::string& directory,
                  const std::string& label) {
  for (const MjcfTag& tag : tags) {
    const std::string where = label + ":" + std::to_string(tag.line) + ": ";
    for (const auto& [name, value] : tag.attributes) {
      const std::string path = directory + "/" + value;
      if (tag.name == "texture" && name.starts_with("file")) check_texture_file(path, where);
      if (tag.name == "texture" && (name == "width" || name == "height")) {
        check_texture_size(parse_numbers(value, label), where);
      }
      if (tag.name == "mesh" && name == "file") check_mesh_file(path, where);
    }
  }
}

}  // namespace dodgesim
