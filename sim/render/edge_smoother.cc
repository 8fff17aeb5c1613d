#include "sim/render/edge_smoother.h"

#include "sim/render/gl.h"

#include <algorithm>

namespace dodgesim {

EdgeSmoother::EdgeSmoother(const std::vector<Edge>& edges, ProgramCache& programs,
                           const Intrinsics& intrinsics, const DepthRange& depth)
    : all_edges_(edges),
      intrinsics_(intrinsics),
      near_m_(depth.near_m),
      program_(make_edge_program(programs, depth)),
      buffer_(make_edge_buffer(edges.size())) {
  seen_.reserve(edges.size());
}

// Whether the image of a segment (ends in C) can come near the region.
bool EdgeSmoother::touches(Eigen::Vector3d a, Eigen::Vector3d b, const Rect& region) const {
  if (a.z() < near_m_ && b.z() < near_m_) return false;
  if (a.z() < near_m_) a += (near_m_ - a.z()) / (b.z() - a.z()) * (b - a);
  if (b.z() < near_m_) b += (near_m_ - b.z()) / (a.z() - b.z()) * (a - b);
  const Eigen::Vector2d p = intrinsics_.project(a), q = intrinsics_.project(b);
  constexpr double kReachPx = 2.0;
  return std::max(p.x(), q.x()) > region.x0 - kReachPx &&
         std::min(p.x(), q.x()) < region.x1 + kReachPx &&
         std::max(p.y(), q.y()) > region.y0 - kReachPx &&
         std::min(p.y(), q.y()) < region.y1 + kReachPx;
}

void EdgeSmoother::draw(const Eigen::Isometry3d& X_WC, const Rect& region, const GlTarget& target) {
  const Eigen::Isometry3d X_CW = X_WC.inverse();
  seen_.clear();
  for (const Edge& edge : all_edges_) {
    if (!edge.shows_from(X_WC.translation()) || !touches(X_CW * edge.a, X_CW * edge.b, region)) {
      continue;
    }
    seen_.push_back({edge.a.cast<float>(), edge.b.cast<float>(),
                     edge.inside_outline(X_WC.translation()) ? 1.0f : 0.0f,
                     static_cast<float>(edge.bulge_m)});
  }
  if (seen_.empty()) return;
  gl::BindBuffer(GL_ARRAY_BUFFER, buffer_.buffer.name());
  gl::BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(seen_.size() * sizeof(seen_[0])),
                    seen_.data());
  gl::ActiveTexture(GL_TEXTURE1);
  gl::BindTexture(GL_TEXTURE_2D, target.depth.name());
  gl::ActiveTexture(GL_TEXTURE0);
  gl::BindTexture(GL_TEXTURE_2D, target.luminance_copy.name());
  gl::ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl::CopyTexSubImage2D(GL_TEXTURE_2D, 0, region.x0, region.y0, region.x0, region.y0,
                        region.x1 - region.x0, region.y1 - region.y0);
  gl::BindFramebuffer(GL_FRAMEBUFFER, target.without_depth.name());
  gl::Disable(GL_DEPTH_TEST);
  gl::Enable(GL_BLEND);
  gl::UseProgram(program_.name);
  set_camera(program_, intrinsics_);
  gl::Uniform2f(program_.image, static_cast<float>(intrinsics_.width),
                static_cast<float>(intrinsics_.height));
  const Eigen::Matrix4f X_CW_float = X_CW.matrix().cast<float>();
  gl::UniformMatrix4fv(program_.X_CW, 1, GL_FALSE, X_CW_float.data());
  gl::BindVertexArray(buffer_.array.name());
  gl::DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<int>(seen_.size()));
  gl::Disable(GL_BLEND);
  gl::Enable(GL_DEPTH_TEST);
}

}  // namespace dodgesim
