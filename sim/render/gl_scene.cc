#include "sim/render/gl_scene.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "sim/base/error.h"
#include "sim/render/gl.h"

namespace dodgesim {

namespace {

void set_floats(GLuint program, const std::string& name, std::initializer_list<double> values) {
  const GLint location = gl::GetUniformLocation(program, name.c_str());
  if (location < 0) return;  // the compiler has removed what has no effect
  float v[4];
  std::size_t n = 0;
  for (const double value : values) v[n++] = static_cast<float>(value);
  switch (n) {
    case 1:
      return gl::Uniform1fv(location, 1, v);
    case 2:
      return gl::Uniform2fv(location, 1, v);
    case 3:
      return gl::Uniform3fv(location, 1, v);
    default:
      return gl::Uniform4fv(location, 1, v);
  }
}

LightCount count_lights(const SceneGeometry& scene) {
  LightCount count;
  for (const Light& light : scene.lights) ++(light.directional ? count.directional : count.lamps);
  return count;
}

void set_lights(GLuint program, const SceneGeometry& scene) {
  set_floats(program, "u_ambient", {scene.ambient});
  int directional = 0, lamps = 0;
  for (const Light& light : scene.lights) {
    std::string index = "[";
    index.append(std::to_string(light.directional ? directional++ : lamps++)).append("]");
    const Eigen::Vector3d& beam = light.direction;
    if (light.directional) {
      set_floats(program, "u_beam" + index, {beam.x(), beam.y(), beam.z()});
      set_floats(program, "u_intensity" + index, {light.ambient, light.diffuse});
      continue;
    }
    const Eigen::Vector3d& p = light.position;
    const Eigen::Vector3d& attenuation = light.attenuation;
    set_floats(program, "u_lamp_position" + index, {p.x(), p.y(), p.z()});
    set_floats(program, "u_lamp_axis" + index, {beam.x(), beam.y(), beam.z(), light.cos_cutoff});
    set_floats(program, "u_lamp_falloff" + index,
               {attenuation.x(), attenuation.y(), attenuation.z(), light.exponent});
    set_floats(program, "u_lamp_intensity" + index, {light.ambient, light.diffuse});
  }
}

GlProgram locate(GLuint name) {
  const auto at = [name](const char* uniform) { return gl::GetUniformLocation(name, uniform); };
  GlProgram p;
  p.name = name;
  p.lod_bias = at("u_lod_bias");
  p.camera = at("u_camera");
  p.clip_from_G = at("u_clip_from_G");
  p.X_WG = at("u_X_WG");
  p.texture_shift = at("u_texture_shift");
  p.id = at("u_id");
  p.R_WC = at("u_R_WC");
  p.X_CW = at("u_X_CW");
  p.image = at("u_image");
  return p;
}

void allocate(const GlTexture& image, GLint format, GLenum layout, GLenum type, int width,
              int height) {
  gl::BindTexture(GL_TEXTURE_2D, image.name());
  gl::TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, type, nullptr);
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

// Without depth or ids when null.
void attach(const GlFramebuffer& framebuffer, const GlTexture& luminance, const GlTexture* depth,
            const GlTexture* ids) {
  const auto attach_one = [](GLenum where, const GlTexture& image) {
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, where, GL_TEXTURE_2D, image.name(), 0);
  };
  gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  attach_one(GL_COLOR_ATTACHMENT0, luminance);
  if (depth) attach_one(GL_DEPTH_ATTACHMENT, *depth);
  if (ids) attach_one(GL_COLOR_ATTACHMENT1, *ids);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl::DrawBuffers(ids ? 2 : 1, buffers);
}

void expect_drawable(int width, int height) {
  if (gl::CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  throw SimulationError("OpenGL cannot draw into a floating-point image of " +
                        std::to_string(width) + " x " + std::to_string(height) +
                        " px; sensors.camera and sensors.keys (supersampling, margin_px) say how "
                        "large it is.");
}

// OpenGL takes an offset into the bound buffer in the guise of a pointer.
const void* buffer_offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

GlTexture upload_texture(const LuminanceTexture& texture) {
  GlTexture uploaded;
  const GLenum target = texture.cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
  gl::BindTexture(target, uploaded.name());
  gl::PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl::PixelStorei(GL_UNPACK_ROW_LENGTH, 0);  // the texture's own width
  const GLint wrap = texture.cube ? GL_CLAMP_TO_EDGE : GL_REPEAT;
  gl::TexParameteri(target, GL_TEXTURE_WRAP_S, wrap);
  gl::TexParameteri(target, GL_TEXTURE_WRAP_T, wrap);
  gl::TexParameteri(target, GL_TEXTURE_WRAP_R, wrap);
  gl::TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // 16 bits hold grey texels of 8 bits exactly (photographs to 1/65535), and llvmpipe filters them
  // in float, unlike 8 bits. A bright tint may take texels beyond 1.
  const float brightest = *std::max_element(texture.texels.begin(), texture.texels.end());
  const GLint format = brightest > 1.0f ? GL_R32F : GL_R16;
  const int faces = texture.cube ? 6 : 1;
  const auto face_texels =
      static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
  for (int face = 0; face < faces; ++face) {
    const GLenum image =
        texture.cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face) : GL_TEXTURE_2D;
    gl::TexImage2D(image, 0, format, texture.width, texture.height, 0, GL_RED, GL_FLOAT,
                   texture.texels.data() + static_cast<std::size_t>(face) * face_texels);
  }
  gl::GenerateMipmap(target);
  return uploaded;
}

}  // namespace

SceneTextures::SceneTextures(const SceneGeometry& scene, bool trilinear)
    : textures_(scene.textures.size()), trilinear_(trilinear) {
  const auto need = [&](int index) {
    if (index < 0) return;
    const LuminanceTexture& texture = scene.textures[static_cast<std::size_t>(index)];
    Texture& uploaded = textures_[static_cast<std::size_t>(index)];
    if (uploaded.kind != TextureKind::kNone) return;
    uploaded = {upload_texture(texture), texture.cube ? TextureKind::kCube : TextureKind::k2d};
  };
  for (const TriangleBatch& batch : scene.static_triangles) need(batch.texture);
  for (const MovingTriangles& moving : scene.moving_triangles) need(moving.batch.texture);
  for (const InfinitePlane& plane : scene.infinite_planes) need(plane.surface.texture);
  need(scene.sky_texture);
}

TextureKind SceneTextures::kind_of(int texture) const {
  return texture < 0 ? TextureKind::kNone : textures_[static_cast<std::size_t>(texture)].kind;
}

void SceneTextures::bind(int texture, bool finest_only) const {
  if (texture < 0) return;
  const Texture& bound = textures_[static_cast<std::size_t>(texture)];
  const GLenum target = bound.kind == TextureKind::kCube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
  gl::BindTexture(target, bound.texture.name());
  const GLint mipmapped = trilinear_ ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_NEAREST;
  gl::TexParameteri(target, GL_TEXTURE_MIN_FILTER, finest_only ? GL_LINEAR : mipmapped);
}

void set_camera(const GlProgram& program, const Intrinsics& intrinsics) {
  gl::Uniform3f(program.camera, static_cast<float>(intrinsics.f),
                static_cast<float>(intrinsics.cx()), static_cast<float>(intrinsics.cy()));
}

VertexBuffer upload_vertices(const std::vector<Vertex>& vertices) {
  VertexBuffer vertex_buffer;
  vertex_buffer.count = static_cast<int>(vertices.size());
  gl::BindVertexArray(vertex_buffer.array.name());
  gl::BindBuffer(GL_ARRAY_BUFFER, vertex_buffer.buffer.name());
  gl::BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                 vertices.data(), GL_STATIC_DRAW);
  const struct {
    GLint components;
    std::size_t offset;
  } attributes[] = {{3, offsetof(Vertex, position)},
                    {3, offsetof(Vertex, normal)},
                    {3, offsetof(Vertex, texture)},
                    {2, offsetof(Vertex, albedo)}};
  for (GLuint i = 0; i < 4; ++i) {
    gl::EnableVertexAttribArray(i);
    gl::VertexAttribPointer(i, attributes[i].components, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                            buffer_offset(attributes[i].offset));
  }
  return vertex_buffer;
}

GlProgram make_triangle_program(ProgramCache& programs, TextureKind texture,
                                const SceneGeometry& scene) {
  const GLuint name = programs.program(triangle_vertex_shader(count_lights(scene)),
                                       triangle_fragment_shader(texture, count_lights(scene)));
  gl::UseProgram(name);
  set_lights(name, scene);
  return locate(name);
}

GlProgram make_sky_program(ProgramCache& programs, TextureKind texture, double luminance) {
  const GLuint name = programs.program(sky_vertex_shader(), sky_fragment_shader(texture));
  gl::UseProgram(name);
  set_floats(name, "u_sky_luminance", {luminance});
  return locate(name);
}

VertexBuffer make_edge_buffer(std::size_t capacity) {
  VertexBuffer buffer;
  gl::BindVertexArray(buffer.array.name());
  gl::BindBuffer(GL_ARRAY_BUFFER, buffer.buffer.name());
  gl::BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity * sizeof(EdgeInstance)), nullptr,
                 GL_STREAM_DRAW);
  const struct {
    GLint components;
    std::size_t offset;
  } attributes[] = {{3, offsetof(EdgeInstance, a)},
                    {3, offsetof(EdgeInstance, b)},
                    {2, offsetof(EdgeInstance, inside)}};
  for (GLuint i = 0; i < 3; ++i) {
    gl::EnableVertexAttribArray(i);
    gl::VertexAttribPointer(i, attributes[i].components, GL_FLOAT, GL_FALSE, sizeof(EdgeInstance),
                            buffer_offset(attributes[i].offset));
    gl::VertexAttribDivisor(i, 1);
  }
  return buffer;
}

GlProgram make_edge_program(ProgramCache& programs, const DepthRange& depth) {
  const GLuint name = programs.program(edge_vertex_shader(), edge_fragment_shader());
  gl::UseProgram(name);
  set_floats(name, "u_near", {depth.near_m});
  set_floats(name, "u_depth", {depth.offset(), depth.slope()});
  gl::Uniform1i(gl::GetUniformLocation(name, "u_luminance"), 0);
  gl::Uniform1i(gl::GetUniformLocation(name, "u_depth_image"), 1);
  return locate(name);
}

GlTarget make_target(int width, int height) {
  GlTarget target;
  allocate(target.luminance, GL_R32F, GL_RED, GL_FLOAT, width, height);
  allocate(target.ids, GL_R32I, GL_RED_INTEGER, GL_INT, width, height);
  allocate(target.luminance_copy, GL_R32F, GL_RED, GL_FLOAT, width, height);
  allocate(target.depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, width, height);
  attach(target.without_ids, target.luminance, &target.depth, nullptr);
  expect_drawable(width, height);
  attach(target.with_ids, target.luminance, &target.depth, &target.ids);
  expect_drawable(width, height);
  attach(target.without_depth, target.luminance, nullptr, nullptr);
  expect_drawable(width, height);
  return target;
}

}  // namespace dodgesim
