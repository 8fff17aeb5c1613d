// A room with everything in it that can be drawn, and three thrown objects.
#pragma once

#include <string>

#include "tests/sim/render/render_fixture.h"

namespace dodgesim {

inline const std::string kFullScene =
    R"(
  <asset>
    <texture name='sky' type='skybox' builtin='gradient' rgb1='.9 .9 .9' rgb2='.2 .2 .2'
             width='64' height='64'/>
    <texture name='checker' type='2d' builtin='checker' rgb1='.2 .3 .4' rgb2='.8 .7 .6'
             width='256' height='256'/>
    <texture name='cube' type='cube' builtin='checker' rgb1='.2 .3 .4' rgb2='.8 .7 .6'
             width='64' height='64' mark='cross' markrgb='1 1 1'/>
    <material name='checker' texture='checker' texrepeat='1 1' texuniform='true'/>
    <material name='cube' texture='cube'/>
    <mesh name='wedge' vertex='0 0 0  .6 0 0  0 .8 0  0 0 1'/>
  </asset>
  <worldbody>
    <light directional='true' dir='.3 .2 -1' diffuse='.5 .5 .5'/>
    <light pos='1 1 3' dir='0 0 -1' cutoff='80' diffuse='.5 .5 .5'/>
    <geom type='plane' size='0 0 1' material='checker'/>
    <geom type='plane' size='2 1 1' pos='4 1 1' zaxis='-1 0 0' material='checker'/>
    <geom type='box' size='.3 .3 .4' pos='3 -1 .4' euler='0 0 20' material='cube'/>
    <geom type='cylinder' size='.2 .6' pos='3.2 1.4 .6' material='checker'/>
    <geom type='capsule' size='.1 .4' pos='2.5 .9 .3' euler='70 20 0' rgba='.7 .7 .7 1'/>
    <geom type='ellipsoid' size='.4 .2 .3' pos='3.5 0 .4' material='cube'/>
    <geom type='mesh' mesh='wedge' pos='3 -2 .3' rgba='.6 .2 .2 1'/>)" +
    thrown(0, "<geom type='sphere' size='.1' material='cube'/>") +
    thrown(1, "<geom type='box' size='.1 .2 .1' material='cube'/>") +
    thrown(2, "<geom type='mesh' mesh='wedge' rgba='.9 .9 .9 1'/>") + "</worldbody>";

inline Scene full_scene() {
  Scene scene(kFullScene);
  scene.snapshot().objects[0].p_W = {1.8, 0.3, 1.2};
  scene.snapshot().objects[1].p_W = {1.5, -0.4, 0.9};
  scene.snapshot().objects[1].q_W = Eigen::Quaterniond(0.7, 0.2, -0.5, 0.3).normalized();
  scene.snapshot().objects[2].p_W = {2.4, -0.7, 1.3};
  return scene;
}

inline Eigen::Isometry3d tilted_camera() {
  Eigen::Isometry3d X_WC = forward_camera({-0.2, 0.1, 1.1});
  X_WC.linear() = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()).toRotationMatrix() *
                  Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitX()).toRotationMatrix() *
                  X_WC.linear();
  return X_WC;
}

}  // namespace dodgesim
