// Parameters of the pictures that event cameras see.
#pragma once

#include <cstdint>
#include <string>

namespace dodgesim {

// Of lamps on the mains (flicker.h).
struct FlickerSpec {
  double flicker_hz = 0;
  double flicker_depth = 0.2;

  template <class Visitor>
  void visit(Visitor& v) {
    v("flicker_hz", flicker_hz, 0, 200,
      "Frequency at which the room's light swings: 100 on mains of 50 Hz, 120 on 60 Hz. The whole "
      "image is then drawn 20 times in each period, more often with a depth above 0.2. 0: the "
      "light is steady.");
    v("flicker_depth", flicker_depth, 0, 1,
      "By how much of its mean the light swings up and down, as a sine (assumed: 0.2; an "
      "incandescent lamp about 0.1, a cheap LED up to 1, with which flights take many times as "
      "long).");
  }
};

// Of the renderer (luminance_renderer.h).
struct RenderSpec {
  double near_m = 0.02;
  double far_m = 2000.0;
  double sky_luminance = 0.5;
  std::string texel_encoding = "linear";
  std::string texture_filter = "bilinear";
  FlickerSpec flicker;  // of what event cameras see; the renderer itself draws the mean light

  template <class Visitor>
  void visit(Visitor& v) {
    v("near_m", near_m, 0.001, 0.5,
      "Nothing of the room and of meshes nearer to the camera than this depth is drawn.");
    v("far_m", far_m, 10.0, 100000.0,
      "Unbounded planes end at this distance, the horizon; what else stands farther than twice as "
      "far is not drawn either, but for spheres, ellipsoids and capsules.");
    v("sky_luminance", sky_luminance, 0.0, 1000.0,
      "Luminance of the background where the room has no sky texture; 1 is a white surface under "
      "full light.");
    v("texture_filter", texture_filter, {"bilinear", "trilinear"},
      "Reading of textures that are seen smaller than they are: bilinear within the nearest level "
      "of the mip-map, or trilinear between two, which takes about half as long again per "
      "picture.");
    v("texel_encoding", texel_encoding, {"linear", "srgb"},
      "What a texel's value v of 0 to 255 means: the reflectance v/255 (the rooms of this "
      "project), or a code value of a photograph.");
    flicker.visit(v);
  }
};

// Of the pictures of the static scene that views are read from (key_picture.h).
struct KeySpec {
  std::int64_t supersampling = 3;
  std::int64_t margin_px = 32;
  double max_misplacement_px = 2;
  double max_zoom = 0.1;

  template <class Visitor>
  void visit(Visitor& v) {
    v("supersampling", supersampling, 1, 4,
      "Pixels drawn for each of the camera's, across and down; their mean is what the camera's "
      "pixel collects.");
    v("margin_px", margin_px, 16, 256,
      "How far a drawn picture reaches beyond the view on every side: so far the camera turns "
      "before the next is drawn.");
    v("max_misplacement_px", max_misplacement_px, 0, 10,
      "How far the outline of something near may be from its place, because the camera has moved "
      "since the picture was drawn, before another is drawn. 0 draws every picture.");
    v("max_zoom", max_zoom, 0, 1,
      "Share of the distance to the nearest thing in view that the camera may move before another "
      "picture is drawn.");
  }
};

}  // namespace dodgesim
