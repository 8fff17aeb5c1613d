#include "sim/render/texture_pyramid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dodgesim {

namespace {

// One level without borders.
struct Level {
  int width, height, faces;
  std::vector<float> texels;

  std::size_t index(int face, int x, int y) const {
    return (static_cast<std::size_t>(face) * static_cast<std::size_t>(height) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  float at(int face, int x, int y) const { return texels[index(face, x, y)]; }
};

// Mean over the part of a row of `size` texels, `stride` apart, that texel i of `fewer` covers.
double mean(const float* texels, int size, std::ptrdiff_t stride, int fewer, int i) {
  const double scale = static_cast<double>(size) / fewer;
  const double begin = i * scale, end = begin + scale;
  double sum = 0;
  for (int k = static_cast<int>(begin); k < size && k < end; ++k) {
    sum += (std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k))) * texels[k * stride];
  }
  return sum / scale;
}

Level halved(const Level& level) {
  Level narrow = {std::max(1, level.width / 2), level.height, level.faces, {}};
  narrow.texels.resize(level.texels.size() / static_cast<std::size_t>(level.width) *
                       static_cast<std::size_t>(narrow.width));
  Level half = {narrow.width, std::max(1, level.height / 2), level.faces, {}};
  half.texels.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) *
                     static_cast<std::size_t>(half.faces));
  for (int face = 0; face < level.faces; ++face) {
    for (int y = 0; y < level.height; ++y) {
      const float* const row = level.texels.data() + level.index(face, 0, y);
      for (int x = 0; x < narrow.width; ++x) {
        narrow.texels[narrow.index(face, x, y)] =
            static_cast<float>(mean(row, level.width, 1, narrow.width, x));
      }
    }
    for (int x = 0; x < half.width; ++x) {
      const float* const column = narrow.texels.data() + narrow.index(face, x, 0);
      for (int y = 0; y < half.height; ++y) {
        half.texels[half.index(face, x, y)] =
            static_cast<float>(mean(column, narrow.height, narrow.width, half.height, y));
      }
    }
  }
  return half;
}

// Direction of a place (s, t), each from -1 to 1, on a face of a cube (OpenGL 3.3, table 3.19).
Eigen::Vector3d cube_direction(int face, double s, double t) {
  switch (face) {
    case 0:
      return {1, -t, -s};
    case 1:
      return {-1, -t, s};
    case 2:
      return {s, 1, t};
    case 3:
      return {s, -1, -t};
    case 4:
      return {s, -t, 1};
    default:
      return {-s, -t, -1};
  }
}

// The texel of a cube that a direction meets.
float cube_texel(const Level& level, const Eigen::Vector3d& d) {
  Eigen::Index axis = 0;
  d.cwiseAbs().maxCoeff(&axis);
  const int face = 2 * static_cast<int>(axis) + (d[axis] < 0 ? 1 : 0);
  // The inverse of cube_direction(), whose components are s and t but for their signs.
  const Eigen::Vector3d along_s = cube_direction(face, 1, 0) - cube_direction(face, 0, 0);
  const Eigen::Vector3d along_t = cube_direction(face, 0, 1) - cube_direction(face, 0, 0);
  const auto texel = [&](double coordinate) {
    const double place = 0.5 * (coordinate / std::abs(d[axis]) + 1) * level.width;
    return std::clamp(static_cast<int>(place), 0, level.width - 1);
  };
  return level.at(face, texel(along_s.dot(d)), texel(along_t.dot(d)));
}

// The texel (x, y), one of whose coordinates is -1 or the size of the face.
float beyond_face(const Level& level, int face, int x, int y) {
  constexpr double kJustOutside = 1 + 1e-6;
  const auto coordinate = [&](int i) {
    if (i < 0) return -kJustOutside;
    if (i >= level.width) return kJustOutside;
    return (2 * i + 1.0) / level.width - 1;
  };
  return cube_texel(level, cube_direction(face, coordinate(x), coordinate(y)));
}

float border_texel(const Level& level, bool cube, int face, int x, int y) {
  if (!cube) {
    return level.at(face, (x + level.width) % level.width, (y + level.height) % level.height);
  }
  const int inner_x = std::clamp(x, 0, level.width - 1);
  const int inner_y = std::clamp(y, 0, level.height - 1);
  if (x == inner_x || y == inner_y) return beyond_face(level, face, x, y);
  // At a corner of the cube three faces meet.
  return (level.at(face, inner_x, inner_y) + beyond_face(level, face, x, inner_y) +
          beyond_face(level, face, inner_x, y)) /
         3;
}

// Rows of pairs, from the last to the first texel of each.
void append_with_border(const Level& level, TexturePyramid& pyramid) {
  pyramid.first[static_cast<std::size_t>(pyramid.levels++)] =
      static_cast<int>(pyramid.pairs.size());
  for (int face = 0; face < level.faces; ++face) {
    for (int y = -1; y <= level.height; ++y) {
      const std::size_t row = pyramid.pairs.size();
      pyramid.pairs.resize(row + static_cast<std::size_t>(level.width) + 2);
      std::uint32_t right = 0;
      for (int x = level.width; x >= -1; --x) {
        const bool inside = x >= 0 && x < level.width && y >= 0 && y < level.height;
        const float texel =
            inside ? level.at(face, x, y) : border_texel(level, pyramid.cube, face, x, y);
        const auto code =
            static_cast<std::uint32_t>(std::lround(std::max(0.0f, texel) / pyramid.unit));
        pyramid.pairs[row + static_cast<std::size_t>(x + 1)] = code | right << 16;
        right = code;
      }
    }
  }
}

}  // namespace

TexturePyramid make_pyramid(const LuminanceTexture& texture) {
  TexturePyramid pyramid;
  pyramid.cube = texture.cube;
  pyramid.width = texture.width;
  pyramid.height = texture.height;
  constexpr float kCodes = 65535;
  pyramid.unit =
      std::max(1.0f, *std::max_element(texture.texels.begin(), texture.texels.end())) / kCodes;
  Level level = {texture.width, texture.height, texture.cube ? 6 : 1, texture.texels};
  append_with_border(level, pyramid);
  while (level.width > 1 || level.height > 1) {
    if (pyramid.levels == static_cast<int>(TexturePyramid::kMostLevels)) {
      throw std::logic_error("A texture is larger than its pyramid can hold.");
    }
    level = halved(level);
    append_with_border(level, pyramid);
  }
  return pyramid;
}

}  // namespace dodgesim
