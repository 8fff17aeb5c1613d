#include "sim/render/primitive_painter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dodgesim {

namespace {

SolidType solid_type(mjtGeom type) {
  switch (type) {
    case mjGEOM_ELLIPSOID:
      return SolidType::kEllipsoid;
    case mjGEOM_CAPSULE:
      return SolidType::kCapsule;
    case mjGEOM_CYLINDER:
      return SolidType::kCylinder;
    case mjGEOM_BOX:
      return SolidType::kBox;
    default:
      throw std::logic_error("A geom of this type is not ray-cast.");
  }
}

Vec3 single(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

SolidView single(const PrimitiveView& view, const Primitive& primitive, const Intrinsics& camera) {
  SolidView s{};
  s.inverse_f = static_cast<float>(1 / camera.f);
  s.cx = static_cast<float>(camera.cx());
  s.cy = static_cast<float>(camera.cy());
  s.right = single(view.R_GC.col(0));
  s.down = single(view.R_GC.col(1));
  s.forward = single(view.R_GC.col(2));
  s.eye = single(view.eye_G);
  s.size = single(primitive.size);
  s.margin = static_cast<float>(view.margin);
  for (int i = 0; i < 9; ++i) s.conic[i] = static_cast<float>(view.conic(i / 3, i % 3));
  s.conic_x = static_cast<float>(view.conic_origin.x());
  s.conic_y = static_cast<float>(view.conic_origin.y());
  s.pieces = view.outline_pieces;
  return s;
}

TextureRead texture_read(bool cube, bool trilinear) {
  if (cube) return trilinear ? TextureRead::kCubeTwoLevels : TextureRead::kCubeNearestLevel;
  return trilinear ? TextureRead::k2dTwoLevels : TextureRead::k2dNearestLevel;
}

}  // namespace

void PrimitivePainter::FaceRows::start(int width) {
  row_below_ = -1;
  // The kernels read one more point than they have pixels.
  const auto size = static_cast<std::size_t>(whole_vectors(width + 1)) + 1;
  if (rows_[0][0].size() >= size) return;
  for (auto& row : rows_) {
    for (auto& component : row) component.resize(size);
  }
}

PointRow PrimitivePainter::FaceRows::at(int row, int pixel) {
  auto& r = rows_[static_cast<std::size_t>(row)];
  const auto from = [&](std::size_t component) { return r[component].data() + pixel; };
  return {from(0), from(1), from(2), from(3), from(4), from(5)};
}

void PrimitivePainter::FaceRows::compute(const SolidKernels& kernels, const SolidView& view,
                                         int face, int column, int row, int size, bool below) {
  const auto points = [&](int y, const PointRow& row_of_points) {
    kernels.points(view, face, static_cast<float>(column), static_cast<float>(y),
                   whole_vectors(size + 1), row_of_points);
  };
  here_ = 1 - here_;
  if (row_below_ != row) points(row, this->here());
  if (!below) return;
  points(row + 1, this->below());
  row_below_ = row + 1;
}

PrimitivePainter::PrimitivePainter(const SceneGeometry& scene, bool trilinear,
                                   const DepthRange& depth)
    : scene_(scene),
      trilinear_(trilinear),
      depth_(depth),
      pyramids_(scene.textures.size()),
      views_(scene.primitives.size()),
      poses_(scene.primitives.size()) {
  order_.reserve(scene.primitives.size());
  for (const Primitive& primitive : scene.primitives) {
    if (primitive.surface.texture < 0) continue;
    const auto texture = static_cast<std::size_t>(primitive.surface.texture);
    if (pyramids_[texture].levels == 0) pyramids_[texture] = make_pyramid(scene.textures[texture]);
  }
}

// Fills order_ with what is in sight.
void PrimitivePainter::arrange(const Shot& shot, const Snapshot* snapshot, Wanted wanted) {
  order_.clear();
  for (std::size_t i = 0; i < scene_.primitives.size(); ++i) {
    const Primitive& primitive = scene_.primitives[i];
    if (!(primitive.object < 0 ? wanted.statics : wanted.objects)) continue;
    poses_[i] = primitive.pose;
    if (primitive.object >= 0) {
      const auto object = static_cast<std::size_t>(primitive.object);
      if (!snapshot->launched[object]) continue;
      poses_[i] = snapshot->objects[object].pose() * primitive.pose;
    }
    views_[i] = view_primitive(primitive, poses_[i], shot.X_WC, shot.intrinsics, depth_.near_m);
    const bool shown = !intersection(views_[i].bounds, shot.region).empty();
    if (views_[i].visible && shown) order_.push_back(i);
  }
  std::sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return views_[a].distance != views_[b].distance ? views_[a].distance > views_[b].distance
                                                    : a < b;
  });
}

void PrimitivePainter::paint_static(const Shot& shot, const PaintedPicture& picture) {
  arrange(shot, nullptr, {.statics = true, .objects = false});
  paint_arranged(shot, picture);
}

void PrimitivePainter::paint_objects(const Shot& shot, const Snapshot& snapshot,
                                     const PaintedPicture& picture) {
  arrange(shot, &snapshot, {.statics = false, .objects = true});
  paint_arranged(shot, picture);
}

void PrimitivePainter::paint_all(const Shot& shot, const Snapshot& snapshot,
                                 const PaintedPicture& picture) {
  arrange(shot, &snapshot, {.statics = true, .objects = true});
  paint_arranged(shot, picture);
}

void PrimitivePainter::paint_arranged(const Shot& shot, const PaintedPicture& picture) {
  for (const std::size_t index : order_) {
    start(shot, index, picture.depth || picture.id);
    const Rect& pixels = subject_.pixels;
    const int size = pixels.x1 - pixels.x0;
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      const std::ptrdiff_t first = std::ptrdiff_t{y} * shot.intrinsics.width + pixels.x0;
      float* const depth = picture.depth ? picture.depth + first : nullptr;
      if (picture.luminance) {
        coverage_.compute(pixels.x0, y, size);
        paint_row(y, size, depth, picture.luminance + first);
      } else {
        coverage_.cast_centers(pixels.x0, y, size);
      }
      mark(size, depth, picture.id ? picture.id + first : nullptr);
    }
  }
}

void PrimitivePainter::start(const Shot& shot, std::size_t index, bool depths) {
  const Primitive& primitive = scene_.primitives[index];
  const Surface& surface = primitive.surface;
  subject_.kernels = &solid_kernels(solid_type(primitive.type));
  subject_.view = single(views_[index], primitive, shot.intrinsics);
  subject_.albedo = static_cast<float>(surface.albedo);
  subject_.emission = static_cast<float>(surface.albedo * surface.emission);
  subject_.id = primitive.object + 1;
  subject_.pixels = intersection(views_[index].bounds, shot.region);
  subject_.textured = surface.texture >= 0;
  if (subject_.textured) {
    const TexturePyramid& pyramid = pyramids_[static_cast<std::size_t>(surface.texture)];
    subject_.read = texture_read(pyramid.cube, trilinear_);
    subject_.texture = {pyramid.pairs.data(),
                        pyramid.unit,
                        pyramid.first.data(),
                        pyramid.width,
                        pyramid.height,
                        pyramid.levels - 1,
                        single(surface.texture_scale),
                        single(surface.texture_offset),
                        static_cast<float>(std::exp2(shot.lod_bias))};
  }
  turn_lights(poses_[index]);
  const int width = shot.intrinsics.width;
  coverage_.start(*subject_.kernels, subject_.view, width, depths || !views_[index].in_front);
  for (FaceRows& face : faces_) face.start(width);
  const auto lanes = static_cast<std::size_t>(whole_vectors(width));
  if (value_.size() >= lanes) return;
  for (auto* row : {&value_, &sum_, &shown_}) row->resize(lanes);
}

// Into the frame of the geom.
void PrimitivePainter::turn_lights(const Eigen::Isometry3d& X_WG) {
  const Eigen::Matrix3d R_GW = X_WG.linear().transpose();
  lights_.ambient = static_cast<float>(scene_.ambient);
  lights_.directional.clear();
  lights_.lamps.clear();
  for (const Light& light : scene_.lights) {
    const Vec3 beam = single(Eigen::Vector3d(R_GW * light.direction));
    const auto ambient = static_cast<float>(light.ambient);
    const auto diffuse = static_cast<float>(light.diffuse);
    if (light.directional) {
      lights_.directional.push_back({beam, ambient, diffuse});
    } else {
      lights_.lamps.push_back(
          {single(Eigen::Vector3d(R_GW * (light.position - X_WG.translation()))), beam,
           static_cast<float>(light.cos_cutoff), static_cast<float>(light.exponent),
           single(light.attenuation), ambient, diffuse});
    }
  }
}

// The pixels of a row that are covered at all, in whole vectors.
PrimitivePainter::Span PrimitivePainter::covered(int size) const {
  const float* const whole = coverage_.whole();
  int begin = 0, end = size;
  while (begin < end && !(whole[begin] > 0)) ++begin;
  while (end > begin && !(whole[end - 1] > 0)) --end;
  begin -= begin % kRowLanes;
  return {begin, whole_vectors(end - begin)};
}

// Blends the luminance of the row whose coverage was computed last.
void PrimitivePainter::paint_row(int y, int size, const float* depth, float* luminance) {
  const SurfaceKernels& kernels = surface_kernels();
  const auto [begin, lanes] = covered(size);
  if (lanes == 0) return;
  float* const value = value_.data() + begin;
  float* const sum = sum_.data() + begin;
  std::fill_n(sum, lanes, 0.0f);
  for (int k = 0; k < subject_.kernels->faces; ++k) {
    if (!coverage_.any(k)) continue;
    FaceRows& face = faces_[static_cast<std::size_t>(k)];
    face.compute(*subject_.kernels, subject_.view, k, subject_.pixels.x0, y, size,
                 subject_.textured);
    kernels.light(lights_, subject_.albedo, subject_.emission, face.here(begin), lanes, value);
    if (subject_.textured) {
      kernels.texture[static_cast<std::size_t>(subject_.read)](subject_.texture, face.here(begin),
                                                               face.below(begin), lanes, value);
    }
    kernels.accumulate(value, coverage_.share(k) + begin, lanes, sum);
  }
  const float* const coverage = depth ? unhidden(depth, size) : coverage_.whole();
  kernels.blend(sum, coverage + begin, coverage_.depth() + begin, std::min(lanes, size - begin),
                luminance + begin);
}

// The coverage of those pixels in which nothing is in front.
const float* PrimitivePainter::unhidden(const float* depth, int size) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    shown_[i] = buffered(coverage_.depth()[i]) <= depth[i] ? coverage_.whole()[i] : 0.0f;
  }
  return shown_.data();
}

// As OpenGL's depth buffer has it.
float PrimitivePainter::buffered(float z_C) const {
  const float value =
      static_cast<float>(depth_.offset()) + static_cast<float>(depth_.slope()) / z_C;
  return std::clamp(value, 0.0f, 1.0f);
}

// Writes depth and id where a pixel's centre is hit and nothing is in front.
void PrimitivePainter::mark(int size, float* depth, std::int32_t* id) const {
  if (!depth && !id) return;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    const float z_C = coverage_.depth_at_center()[i];
    if (!(z_C > 0)) continue;
    if (depth) {
      const float value = buffered(z_C);
      if (value > depth[i]) continue;
      depth[i] = value;
    }
    if (id) id[i] = subject_.id;
  }
}

}  // namespace dodgesim
