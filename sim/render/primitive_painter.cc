#include "sim/render/primitive_painter.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <iterator>

#include "sim/render/gl_values.h"

namespace dodgesim {

namespace {

constexpr mjtGeom kTypesInOrder[] = {mjGEOM_ELLIPSOID, mjGEOM_CAPSULE, mjGEOM_CYLINDER, mjGEOM_BOX};

std::size_t type_index(mjtGeom type) {
  return static_cast<std::size_t>(
      std::find(std::begin(kTypesInOrder), std::end(kTypesInOrder), type) -
      std::begin(kTypesInOrder));
}

void write_luminance(bool on) { glColorMaski(0, on, on, on, on); }
void write_id(bool on) { glColorMaski(1, on, on, on, on); }

}  // namespace

PrimitivePainter::PrimitivePainter(const SceneGeometry& scene, const SceneTextures& textures,
                                   ProgramCache& programs, const DepthRange& depth)
    : scene_(scene),
      textures_(textures),
      depth_(depth),
      views_(scene.primitives.size()),
      poses_(scene.primitives.size()) {
  static_assert(std::size(kTypesInOrder) == kTypes);
  order_.reserve(scene.primitives.size());
  make_programs(programs);
}

void PrimitivePainter::make_programs(ProgramCache& programs) {
  for (const Primitive& primitive : scene_.primitives) {
    const TextureKind kind = textures_.kind_of(primitive.surface.texture);
    const std::size_t type = type_index(primitive.type);
    GlProgram& program = programs_[type][static_cast<std::size_t>(kind)];
    if (!program.name) {
      program = make_primitive_program(programs, primitive.type, kind, false, scene_, depth_);
    }
    GlProgram& hard = hard_programs_[type];
    if (!hard.name) {
      hard = make_primitive_program(programs, primitive.type, TextureKind::kNone, true, scene_,
                                    depth_);
    }
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

void PrimitivePainter::draw_arranged(const Shot& shot, bool last_depth_and_id) {
  glBindVertexArray(no_vertices_.name());
  for (const std::size_t index : order_) {
    draw_luminance(shot, index);
    if (last_depth_and_id || index != order_.back()) draw_depth_and_id(shot, index);
  }
}

void PrimitivePainter::draw_static(const Shot& shot) {
  arrange(shot, nullptr, {.statics = true, .objects = false});
  draw_arranged(shot, true);
}

void PrimitivePainter::draw_objects(const Shot& shot, const Snapshot& snapshot,
                                    bool last_depth_and_id) {
  arrange(shot, &snapshot, {.statics = false, .objects = true});
  draw_arranged(shot, last_depth_and_id);
}

void PrimitivePainter::draw_all(const Shot& shot, const Snapshot& snapshot) {
  arrange(shot, &snapshot, {.statics = true, .objects = true});
  draw_arranged(shot, true);
}

void PrimitivePainter::draw_static_depth(const Shot& shot) {
  arrange(shot, nullptr, {.statics = true, .objects = false});
  glBindVertexArray(no_vertices_.name());
  for (const std::size_t index : order_) draw_depth_and_id(shot, index);
}

// What a program shares with its hard twin.
void PrimitivePainter::set_outline(const GlProgram& program, const Shot& shot,
                                   std::size_t index) const {
  const Primitive& primitive = scene_.primitives[index];
  const PrimitiveView& view = views_[index];
  glUseProgram(program.name);
  set_camera(program, shot.intrinsics);
  const auto clip = [](int pixel, int size) {
    return 2.0f * static_cast<float>(pixel) / static_cast<float>(size) - 1.0f;
  };
  const int width = shot.intrinsics.width, height = shot.intrinsics.height;
  glUniform4f(program.rectangle, clip(view.bounds.x0, width), clip(view.bounds.y0, height),
              clip(view.bounds.x1, width), clip(view.bounds.y1, height));
  set_matrix(program.R_GC, view.R_GC);
  set_vector(program.eye_G, view.eye_G);
  set_vector(program.size, primitive.size);
  glUniform1i(program.id, primitive.object + 1);
}

void PrimitivePainter::draw_luminance(const Shot& shot, std::size_t index) {
  const Primitive& primitive = scene_.primitives[index];
  const PrimitiveView& view = views_[index];
  const Surface& surface = primitive.surface;
  const GlProgram& program =
      programs_[type_index(primitive.type)]
               [static_cast<std::size_t>(textures_.kind_of(surface.texture))];
  set_outline(program, shot, index);
  glUniform1f(program.margin, static_cast<float>(view.margin));
  set_matrix(program.X_WG, poses_[index].matrix());
  set_vector(program.texture_scale, surface.texture_scale);
  set_vector(program.texture_offset, surface.texture_offset);
  glUniform2f(program.albedo_emission, static_cast<float>(surface.albedo),
              static_cast<float>(surface.albedo * surface.emission));
  if (primitive.type != mjGEOM_BOX) {
    set_matrix(program.conic, view.conic);
    glUniform2f(program.conic_origin, static_cast<float>(view.conic_origin.x()),
                static_cast<float>(view.conic_origin.y()));
    glUniform1i(program.pieces, view.outline_pieces);
  }
  glUniform1f(program.lod_bias, static_cast<float>(shot.lod_bias));
  textures_.bind(surface.texture);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  write_id(false);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  write_id(true);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

void PrimitivePainter::draw_depth_and_id(const Shot& shot, std::size_t index) {
  set_outline(hard_programs_[type_index(scene_.primitives[index].type)], shot, index);
  write_luminance(false);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  write_luminance(true);
}

}  // namespace dodgesim
