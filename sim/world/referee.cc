#include "sim/world/referee.h"

#include <cmath>
#include <numbers>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

// Bodies without a joint to the world are the room's.
bool of_room(const mjModel& model, int body) { return model.body_weldid[body] == 0; }

// How the vehicle touches the room.
enum class Touch { kNone, kFromAbove, kOtherwise };

Touch touch_of(const World& world) {
  constexpr double kUpward = 0.9;  // of the surface's normal: up to 26 deg of slope
  const mjModel& model = world.model();
  const mjData& data = world.data();
  Touch touch = Touch::kNone;
  for (int k = 0; k < data.ncon; ++k) {
    const mjContact& contact = data.contact[k];
    if (contact.dist > 0) continue;  // within a geom's margin, but not touching
    const int body1 = model.geom_bodyid[contact.geom1];
    const int body2 = model.geom_bodyid[contact.geom2];
    if (body1 != world.vehicle_body() && body2 != world.vehicle_body()) continue;
    const bool second = body2 == world.vehicle_body();
    if (!of_room(model, second ? body1 : body2)) continue;
    // The normal leads from the first geom to the second.
    const double up = second ? contact.frame[2] : -contact.frame[2];
    if (up < kUpward) return Touch::kOtherwise;
    touch = Touch::kFromAbove;
  }
  return touch;
}

}  // namespace

Referee::Referee(const World& world)
    : hull_(read_body(world, world.vehicle_body(), world.spec().vehicle_file())) {
  for (int i = 0; i < world.object_count(); ++i) {
    const ObjectSpec& object = world.spec().objects[static_cast<std::size_t>(i)];
    objects_.push_back(read_body(world, world.object_body(i), object.file()));
  }
  reset();
}

Referee::Body Referee::read_body(const World& world, int body, const std::string& file) {
  const std::string label = world.spec().path(file) + ": The body";
  Body out;
  out.id = body;
  out.parts = convex_parts(world.model(), body, label,
                           [&world](int geom) { return world.can_collide(geom); });
  out.radius_m = radius_m(out.parts);
  if (out.parts.empty()) throw ScenarioError(label + " has no geom that can collide.");
  return out;
}

void Referee::reset() {
  verdict_ = Verdict{};
  verdict_.objects.resize(objects_.size());
  touched_room_.assign(objects_.size(), false);
}

void Referee::observe(const World& world, bool landing) {
  const Snapshot& now = world.snapshot();
  observe_contacts(world);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (now.launched[i]) observe_object(i, now);
  }
  if (!verdict_.crashed && !verdict_.landed) observe_room(world, landing);
}

void Referee::observe_contacts(const World& world) {
  const mjModel& model = world.model();
  const mjData& data = world.data();
  for (int k = 0; k < data.ncon; ++k) {
    const mjContact& contact = data.contact[k];
    if (contact.dist > 0) continue;
    const int body1 = model.geom_bodyid[contact.geom1], body2 = model.geom_bodyid[contact.geom2];
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const int id = objects_[i].id;
      if ((body1 == id && of_room(model, body2)) || (body2 == id && of_room(model, body1))) {
        touched_room_[i] = true;
      }
    }
  }
}

void Referee::observe_object(std::size_t i, const Snapshot& now) {
  Approach& approach = verdict_.objects[i];
  if (approach.hit) return;
  const double at_least =
      (now.objects[i].p_W - now.vehicle.p_W).norm() - hull_.radius_m - objects_[i].radius_m;
  if (at_least >= approach.clearance_m) return;
  const Eigen::Isometry3d X_BO = now.vehicle.pose().inverse() * now.objects[i].pose();
  const double gap_m = convex_gap_m(hull_.parts, objects_[i].parts, X_BO);
  if (gap_m >= approach.clearance_m) return;
  approach.clearance_m = gap_m;
  approach.closest_us = now.t_us;
  approach.after_room = touched_room_[i];
  if (gap_m <= 0) {
    approach.hit = true;
    approach.hit_us = now.t_us;
  }
  if (!verdict_.nearest.hit && approach.clearance_m < verdict_.nearest.clearance_m) {
    verdict_.nearest = approach;
    verdict_.nearest_object = static_cast<int>(i);
  }
}

void Referee::observe_room(const World& world, bool landing) {
  const Touch touch = touch_of(world);
  if (touch == Touch::kNone) return;
  const Snapshot& now = world.snapshot();  // before the contact's force has slowed the vehicle
  const double up = (now.vehicle.q_W * Eigen::Vector3d::UnitZ()).z();
  const bool gentle = now.vehicle.v_W.norm() <= kTouchdownMps &&
                      up >= std::cos(kTouchdownTiltDeg * std::numbers::pi / 180);
  if (landing && gentle && touch == Touch::kFromAbove) {
    verdict_.landed = true;
    verdict_.landed_us = now.t_us;
  } else {
    verdict_.crashed = true;
  }
}

}  // namespace dodgesim
