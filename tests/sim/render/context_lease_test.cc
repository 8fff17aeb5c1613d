// Contexts that serve one renderer after another: what is kept, and that it does not show.
#include "sim/render/context_lease.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <thread>

#include "sim/render/gl.h"
#include "sim/render/gl_objects.h"
#include "tests/sim/render/full_scene.h"

namespace dodgesim {
namespace {

// OpenGL counts names from 1; the scenes here have fewer objects of a kind.
constexpr GLuint kNames = 1000;

// A thread of its own begins without idle contexts.
void on_a_fresh_thread(const std::function<void()>& task) { std::thread(task).join(); }

// Of the current context.
int objects_alive() {
  int count = 0;
  for (GLuint name = 1; name < kNames; ++name) {
    count += gl::IsTexture(name) + gl::IsBuffer(name) + gl::IsVertexArray(name) +
             gl::IsFramebuffer(name);
  }
  return count;
}

unsigned some_program(ProgramCache& programs, int which = 0) {
  const std::string vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }";
  return programs.program(vertex, "#version 330 core\nout vec4 c; void main() { c = vec4(" +
                                      std::to_string(which) + "); }");
}

TEST(ContextLease, GivesTheSameContextAgainWithItsPrograms) {
  on_a_fresh_thread([] {
    unsigned program = 0;
    {
      ContextLease lease;
      EXPECT_EQ(lease.programs().size(), 0U);
      program = some_program(lease.programs());
      EXPECT_NE(some_program(lease.programs(), 1), program);
    }
    ContextLease lease;
    EXPECT_EQ(lease.programs().size(), 2U);
    EXPECT_EQ(some_program(lease.programs()), program);
    EXPECT_TRUE(gl::IsProgram(program));
    EXPECT_EQ(lease.programs().size(), 2U);
  });
}

TEST(ContextLease, IsForOneAloneAsLongAsItLasts) {
  on_a_fresh_thread([] {
    for (int i = 0; i < 3; ++i) {
      ContextLease one, other;
      EXPECT_NE(&one.context(), &other.context());
      EXPECT_NE(&one.programs(), &other.programs());
      EXPECT_EQ(one.programs().size(), i == 0 ? 0U : 1U);  // both are kept
      EXPECT_EQ(other.programs().size(), i == 0 ? 0U : 1U);
      some_program(other.programs());
      one.context().make_current();
      some_program(one.programs());
    }
  });
}

TEST(ContextLease, IsNotKeptAfterAnException) {
  on_a_fresh_thread([] {
    try {
      ContextLease lease;
      some_program(lease.programs());
      throw std::runtime_error("while a renderer is made");
    } catch (const std::runtime_error&) {
      ContextLease lease;  // the exception is under way no more
      EXPECT_EQ(lease.programs().size(), 0U);
      some_program(lease.programs());
    }
    EXPECT_EQ(ContextLease().programs().size(), 1U);
  });
}

TEST(ContextLease, KeepsNoMoreThanSoManyPrograms) {
  on_a_fresh_thread([] {
    const auto use = [](int programs) {
      ContextLease lease;
      for (int i = 0; i < programs; ++i) some_program(lease.programs(), i);
    };
    const int most = static_cast<int>(ContextLease::kMaxKeptPrograms);
    use(most);
    EXPECT_EQ(ContextLease().programs().size(), ContextLease::kMaxKeptPrograms);
    use(most + 1);
    EXPECT_EQ(ContextLease().programs().size(), 0U);
  });
}

TEST(ContextLease, AShaderThatDoesNotCompileIsNoProgram) {
  on_a_fresh_thread([] {
    ContextLease lease;
    for (int i = 0; i < 2; ++i) {
      EXPECT_THROW(lease.programs().program("nonsense", "nonsense"), std::exception);
    }
    EXPECT_EQ(lease.programs().size(), 0U);
  });
}

// Scenes that use the same programs with other values, and other programs.

struct Setting {
  std::string content;
  RenderSpec spec;
  Intrinsics camera;
};

// The full scene under other lights, as many as it has.
std::string full_scene_under(const std::string& lights) {
  std::string content = kFullScene;
  const std::size_t first = content.find("<light");
  return content.replace(first, content.find("<geom") - first, lights);
}

std::vector<Setting> settings() {
  RenderSpec other;
  other.near_m = 0.3;
  other.far_m = 50;
  other.texture_filter = "trilinear";
  RenderSpec dark_sky;
  dark_sky.sky_luminance = 0.1;
  dark_sky.texel_encoding = "srgb";
  const std::string plain =
      "<worldbody><geom type='plane' size='0 0 1' pos='0 0 -.5' rgba='.3 .3 .3 1'/>"
      "<geom type='box' size='.3 .3 .4' pos='3 -1 .4'/>" +
      thrown(0, "<geom type='sphere' size='.2' rgba='.9 .9 .9 1'/>") + "</worldbody>";
  const std::string textured =
      "<asset><texture name='t' type='2d' builtin='checker' rgb1='.1 .1 .1' rgb2='1 1 1' "
      "width='77' height='77'/><material name='m' texture='t' texrepeat='3 3'/></asset>"
      "<worldbody><light pos='1 -2 3' dir='0 0 -1' diffuse='.9 .9 .9' attenuation='1 .1 .2'/>"
      "<light pos='1 2 3' dir='.2 0 -1' diffuse='.4 .4 .4' exponent='3'/>"
      "<geom type='plane' size='4 4 1' pos='0 0 -.5' material='m'/>" +
      thrown(0, "<geom type='capsule' size='.2 .3' material='m'/>") +
      thrown(1, "<geom type='cylinder' size='.2 .3' rgba='.6 .6 .6 1'/>") + "</worldbody>";
  return {{kFullScene, {}, {}},
          {full_scene_under("<light directional='true' dir='-.6 .2 -1' diffuse='.8 .8 .8'/>"
                            "<light pos='2 -1 2' dir='.3 0 -1' cutoff='60' exponent='2' "
                            "attenuation='1 .2 .1' ambient='.1 .1 .1' diffuse='.3 .3 .3'/>"),
           other,
           {150, 110, 90.0}},
          {full_scene_under("<light directional='true' dir='0 0 -1' diffuse='0 0 0'/>"
                            "<light pos='0 0 3' dir='0 0 -1' diffuse='0 0 0' exponent='0'/>"),
           {},
           {}},
          {kNoHeadlight + textured, dark_sky, {100, 80, 70.0}},
          {kWhiteLight + plain, {}, {}}};
}

std::unique_ptr<Scene> make_scene(const Setting& setting) {
  auto scene = std::make_unique<Scene>(setting.content, setting.spec, setting.camera);
  const Eigen::Vector3d places[] = {{1.8, 0.3, 1.2}, {1.5, -0.4, 0.9}, {2.4, -0.7, 1.3}};
  for (std::size_t i = 0; i < scene->snapshot().objects.size(); ++i) {
    scene->snapshot().objects[i].p_W = places[i];
    scene->snapshot().objects[i].q_W = Eigen::Quaterniond(0.7, 0.2, -0.5, 0.3).normalized();
  }
  return scene;
}

// All that a renderer can draw, one after the other.
std::vector<float> draw_all(Scene& scene) {
  std::vector<float> all, inverse_depth;
  const auto add = [&all](const Image& image) {
    all.insert(all.end(), image.luminance.begin(), image.luminance.end());
    for (const std::int32_t id : image.id) all.push_back(static_cast<float>(id));
  };
  const Eigen::Isometry3d X_WC = tilted_camera();
  add(scene.render(X_WC));
  add(scene.render_static(X_WC, {211, 160, 120.0}, inverse_depth));
  all.insert(all.end(), inverse_depth.begin(), inverse_depth.end());
  for (const bool behind_static : {true, false}) {
    add(scene.draw_objects(X_WC, {20, 15, 90, 75}, behind_static));
  }
  add(scene.render(X_WC, {31, 17, 94, 71}));
  return all;
}

// What nobody has set since may be anything: uniforms of all programs, and the state of OpenGL.
void scramble_uniforms() {
  const std::vector<float> floats(64, 7.5F);
  for (GLuint program = 1; program < kNames; ++program) {
    if (!gl::IsProgram(program)) continue;
    gl::UseProgram(program);
    GLint count = 0;
    gl::GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
      char name[100];
      GLint size = 0;
      GLenum type = 0;
      gl::GetActiveUniform(program, static_cast<GLuint>(i), sizeof name, nullptr, &size, &type,
                           name);
      const GLint at = gl::GetUniformLocation(program, name);
      if (type == GL_FLOAT) gl::Uniform1fv(at, size, floats.data());
      if (type == GL_FLOAT_VEC2) gl::Uniform2fv(at, size, floats.data());
      if (type == GL_FLOAT_VEC3) gl::Uniform3fv(at, size, floats.data());
      if (type == GL_FLOAT_VEC4) gl::Uniform4fv(at, size, floats.data());
      if (type == GL_FLOAT_MAT3) gl::UniformMatrix3fv(at, size, GL_FALSE, floats.data());
      if (type == GL_FLOAT_MAT4) gl::UniformMatrix4fv(at, size, GL_FALSE, floats.data());
      if (type == GL_INT) gl::Uniform1i(at, 77);
    }
  }
}

void scramble_state() {
  gl::Disable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  gl::DepthMask(GL_FALSE);
  gl::Disable(GL_SCISSOR_TEST);
  gl::Scissor(3, 4, 5, 6);
  gl::Viewport(1, 2, 3, 4);
  gl::Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl::Enable(GL_BLEND);
  gl::BlendFunc(GL_ONE, GL_ONE);
  gl::ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl::ActiveTexture(GL_TEXTURE1);
  for (const GLenum alignment : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT}) {
    gl::PixelStorei(alignment, 8);
  }
  for (const GLenum length : {GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH})
    gl::PixelStorei(length, 400);
}

TEST(RendererInAUsedContext, DrawsTheBitsOfOneInAFreshContext) {
  const std::vector<Setting> all = settings();
  std::vector<std::vector<float>> fresh;
  on_a_fresh_thread([&] {
    std::vector<std::unique_ptr<Scene>> alive;  // no two can have the same context
    for (const Setting& setting : all) alive.push_back(make_scene(setting));
    for (const auto& scene : alive) fresh.push_back(draw_all(*scene));
  });
  on_a_fresh_thread([&] {
    for (const std::size_t i : {0, 1, 2, 0, 3, 4, 1, 3, 2, 4, 0}) {
      EXPECT_EQ(draw_all(*make_scene(all[i])), fresh[i]) << i;
      ContextLease used, unused;
      EXPECT_GT(used.programs().size(), 0U);  // the scenes share one
      EXPECT_EQ(unused.programs().size(), 0U);
    }
    for (const std::size_t i : {0, 1, 2, 3, 4}) {
      {
        ContextLease used;
        scramble_uniforms();
        scramble_state();
      }
      EXPECT_EQ(draw_all(*make_scene(all[i])), fresh[i]) << i;
    }
  });
}

TEST(RendererInAUsedContext, CompilesNothingThatWasCompiledBefore) {
  on_a_fresh_thread([] {
    const std::vector<Setting> all = settings();
    const auto programs_after = [](const Setting& setting) {
      draw_all(*make_scene(setting));
      return ContextLease().programs().size();
    };
    const std::size_t first = programs_after(all[0]);
    EXPECT_GT(first, 4U);
    EXPECT_EQ(programs_after(all[0]), first);
    EXPECT_EQ(programs_after(all[1]), first);  // as many lights
    EXPECT_GT(programs_after(all[3]), first);
  });
}

TEST(RendererInAUsedContext, LeavesNothingButPrograms) {
  on_a_fresh_thread([] {
    for (const Setting& setting : settings()) {
      auto scene = make_scene(setting);
      draw_all(*scene);
      EXPECT_GT(objects_alive(), 10);
      scene.reset();
      EXPECT_EQ(objects_alive(), 0);
    }
  });
}

TEST(RendererInAUsedContext, MayDieWhileAnotherContextIsCurrent) {
  on_a_fresh_thread([] {
    const std::vector<Setting> all = settings();
    auto scene = make_scene(all[0]), other = make_scene(all[1]);
    draw_all(*scene);
    const std::vector<float> before = draw_all(*other);
    const int objects = objects_alive();
    scene.reset();
    {
      ContextLease lease;
      EXPECT_GT(lease.programs().size(), 0U);
      EXPECT_EQ(objects_alive(), 0);
    }
    EXPECT_EQ(draw_all(*other), before);
    EXPECT_EQ(objects_alive(), objects);
  });
}

}  // namespace
}  // namespace dodgesim
