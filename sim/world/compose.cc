#include "sim/world/compose.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/gravity.h"
#include "sim/base/names.h"
#include "sim/base/numbers.h"
#include "sim/base/time.h"
#include "sim/world/asset.h"
#include "sim/world/mjcf.h"

namespace dodgesim {

namespace {

// A model is named by a plain word, so that it cannot point outside its folder.
void check_model_name(const std::string& name, const std::string& folder) {
  if (!is_plain_name(name)) {
    throw ScenarioError("The model name '" + name + "' for " + folder +
                        " must consist of letters, digits, '_' and '-'.");
  }
}

void refuse(const std::vector<MjcfTag>& tags, std::initializer_list<const char*> elements,
            const std::string& what, const std::string& label) {
  for (const MjcfTag& tag : tags) {
    if (contains(elements, tag.name)) {
      throw ScenarioError(label + ":" + std::to_string(tag.line) + ": The model of " + what +
                          " must not use <" + tag.name + ">.");
    }
  }
}

// Calls visit(tag, open) for every element, where `open` holds the names of those that it is in.
template <class Visit>
void for_each_element(const std::vector<MjcfTag>& tags, Visit visit) {
  std::vector<std::string> open;
  for (const MjcfTag& tag : tags) {
    if (tag.kind == MjcfTag::Kind::kClose) {
      if (!open.empty()) open.pop_back();
      continue;
    }
    visit(tag, open);
    if (tag.kind == MjcfTag::Kind::kOpen) open.push_back(tag.name);
  }
}

// Of what flies: the room's lights, which do not move, are the scene's.
constexpr std::initializer_list<const char*> kOfRooms = {"light", "visual"};

// Makes bodies and skins of its own, which the event cameras would not see.
constexpr std::initializer_list<const char*> kUnseen = {"composite", "skin"};

// The scenario says where a body begins.
void refuse_place(const MjcfTag& body, const std::string& of, const std::string& because,
                  const std::string& label) {
  constexpr std::array kPlaces = {"pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"};
  for (const auto& [name, value] : body.attributes) {
    if (!contains(kPlaces, name)) continue;
    throw ScenarioError(label + ":" + std::to_string(body.line) + ": The body of " + of +
                        " must have no " + name + ", as " + because +
                        ": move or turn its geoms instead.");
  }
}

// What stands beside an object's body would stand in the room.
void expect_one_body(const std::vector<MjcfTag>& tags, const std::string& label) {
  bool has_body = false;
  for_each_element(tags, [&](const MjcfTag& tag, const std::vector<std::string>& open) {
    if (open != std::vector<std::string>{"worldbody"}) return;
    if (tag.name != "body" || has_body) {
      throw ScenarioError(label + ":" + std::to_string(tag.line) +
                          ": The <worldbody> of an object must hold one <body> and nothing "
                          "else, not <" +
                          tag.name + "> too.");
    }
    has_body = true;
    refuse_place(tag, "an object",
                 "a throw begins where the scenario says and along the axes of the world", label);
  });
}

// A default of no class would be one of the other models, too.
void refuse_root_default(const std::vector<MjcfTag>& tags, const std::string& what,
                         const std::string& label) {
  for_each_element(tags, [&](const MjcfTag& tag, const std::vector<std::string>& open) {
    if (open != std::vector<std::string>{"default"} || tag.name == "default") return;
    throw ScenarioError(label + ":" + std::to_string(tag.line) + ": The model of " + what +
                        " must not set a <default> without a class, which the other models " +
                        "would take over: put <" + tag.name + "> into <default class=\"...\">.");
  });
}

void expect_no_place(const std::vector<MjcfTag>& tags, const std::string& label) {
  for_each_element(tags, [&](const MjcfTag& tag, const std::vector<std::string>& open) {
    if (tag.name != "body" || open != std::vector<std::string>{"worldbody"}) return;
    refuse_place(tag, "a vehicle", "it begins where the mission does", label);
  });
}

// What a second joint moves would fly, or turn, by itself.
void expect_one_joint(const std::vector<MjcfTag>& tags, const std::string& label) {
  const auto is_joint = [](const MjcfTag& tag) {
    return tag.kind != MjcfTag::Kind::kClose && (tag.name == "joint" || tag.name == "freejoint");
  };
  const auto first = std::ranges::find_if(tags, is_joint);
  if (first == tags.end()) return;
  const auto second = std::find_if(first + 1, tags.end(), is_joint);
  if (second == tags.end()) return;
  throw ScenarioError(label + ":" + std::to_string(second->line) +
                      ": The model of a vehicle must have one joint, the free one of its body.");
}

std::vector<MjcfTag> scaled_object(const WorldSpec& world, std::size_t i) {
  const ObjectSpec& spec = world.objects[i];
  check_model_name(spec.kind, "models/objects");
  const std::string label = world.path(spec.file());
  if (!(spec.size_m >= 0.01 && spec.size_m <= 1.0)) {
    throw ScenarioError(label + ": the size_m of an object must be between 0.01 and 1 m, not " +
                        std::to_string(spec.size_m) + ".");
  }
  std::vector<MjcfTag> tags = read_model_file(world.models_dir, spec.file());
  // Files that bring global settings would change the other models in the world.
  refuse(tags, {"option", "size", "default", "contact"}, "an object", label);
  refuse(tags, kUnseen, "an object", label);
  refuse(tags, kOfRooms, "an object", label);
  expect_one_body(tags, label);
  if (!contains(tags, "inertial", &MjcfTag::name)) {
    throw ScenarioError(label + ": The body of an object must have an <inertial>, which is what " +
                        "mass_exponent scales.");
  }
  const double reference_size_m = find_numeric(tags, "reference_size_m", label);
  if (!(reference_size_m > 0)) {
    throw ScenarioError(label + ": reference_size_m must be positive.");
  }
  const double mass_exponent = find_numeric(tags, "mass_exponent", label);
  if (!(mass_exponent >= 0 && mass_exponent <= 3)) {
    throw ScenarioError(label +
                        ": mass_exponent must be between 0 and 3 (2 if hollow, 3 if solid), not " +
                        to_text(mass_exponent) + ".");
  }
  const double scale = spec.size_m / reference_size_m;
  scale_body(tags, scale, mass_exponent, label);
  prefix_names(tags, object_prefix(static_cast<int>(i)));
  return tags;
}

// One of the files that make up the world.
struct Part {
  std::string label;
  std::vector<MjcfTag> tags;
};

// The models that were asked for last. To compile one takes ten times as long as to copy it, and
// each throw needs its own several times.
class CompiledModels {
 public:
  MjModelPtr get(const std::string& xml, std::span<const Part> parts, const std::string& directory,
                 const std::string& label) {
    const std::string key = directory + '\n' + xml;
    const auto same = [&](const Entry& entry) { return entry.first == key; };
    const auto found = std::ranges::find_if(entries_, same);
    if (found != entries_.end()) {
      std::rotate(entries_.begin(), found, found + 1);
    } else {
      for (const Part& part : parts) check_assets(part.tags, directory, part.label);
      if (entries_.size() == kMost) entries_.pop_back();
      entries_.emplace(entries_.begin(), key, compile_model(xml, directory, label));
    }
    MjModelPtr copy(mj_copyModel(nullptr, entries_.front().second.get()));
    if (!copy) throw ScenarioError(label + ": the composed model does not fit in memory.");
    return copy;
  }

 private:
  static constexpr std::size_t kMost = 4;
  using Entry = std::pair<std::string, MjModelPtr>;
  std::vector<Entry> entries_;
};

constexpr std::size_t kFewContacts = 20;

// At how many points an object may touch others at once, lying on the floor.
std::size_t most_contacts(const std::vector<MjcfTag>& object) {
  constexpr std::size_t kPerGeom = 5, kMost = 200;
  const auto geoms = std::ranges::count_if(object, [](const MjcfTag& tag) {
    return tag.name == "geom" && tag.kind != MjcfTag::Kind::kClose;
  });
  return std::clamp(kPerGeom * static_cast<std::size_t>(geoms), kFewContacts, kMost);
}

// Air drag is computed by World: MuJoCo's own fluid model stays off (density 0). The buffers hold
// the vehicle's contacts and those of the objects, and no more: the defaults cost 14 MB each world.
// Of several <size>s the last one holds, which is this one, whatever the models say.
MjModelPtr compile(std::span<const Part> parts, const std::string& models_dir,
                   const std::string& label, std::size_t object_contacts) {
  thread_local CompiledModels models;
  std::string inner_xml;
  for (const Part& part : parts) inner_xml += print_mjcf(part.tags);
  const std::size_t contacts = 30 + std::max(object_contacts, kFewContacts);
  return models.get(
      "<mujoco model=\"dodgesim\"><compiler angle=\"degree\"/>"
      "<option gravity=\"0 0 " +
          std::to_string(-kGravityMps2) + "\" density=\"0\" viscosity=\"0\" timestep=\"" +
          std::to_string(seconds(kTickUs)) + "\"/>" + inner_xml + "<size nconmax=\"" +
          std::to_string(contacts) + "\" njmax=\"" + std::to_string(5 * contacts) + "\"/></mujoco>",
      parts, models_dir, label);
}

}  // namespace

std::string object_prefix(int i) { return "object" + std::to_string(i) + "/"; }

MjModelPtr compose_model(const WorldSpec& spec) {
  check_model_name(spec.room, "models/rooms");
  check_model_name(spec.vehicle, "models/vehicles");
  std::vector<Part> parts;
  const std::pair<std::string, std::string> files[] = {{spec.room_file(), "a room"},
                                                       {spec.vehicle_file(), "a vehicle"}};
  for (const auto& [file, what] : files) {
    const std::string label = spec.path(file);
    std::vector<MjcfTag> tags = read_model_file(spec.models_dir, file);
    // Gravity, air and the time step are known to the throws, the controller and the IMU, too.
    refuse(tags, {"option"}, what, label);
    refuse(tags, kUnseen, what, label);
    // The pictures of a room are drawn once and shown from many places.
    if (what == "a room") refuse(tags, {"joint", "freejoint"}, what, label);
    if (what == "a vehicle") {
      refuse(tags, kOfRooms, what, label);
      expect_one_joint(tags, label);
      expect_no_place(tags, label);
    }
    refuse_root_default(tags, what, label);
    parts.push_back({label, std::move(tags)});
  }
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < spec.objects.size(); ++i) {
    std::vector<MjcfTag> tags = scaled_object(spec, i);
    contacts += most_contacts(tags);
    parts.push_back({spec.path(spec.objects[i].file()), std::move(tags)});
  }
  try {
    return compile(parts, spec.models_dir, parts[0].label + " with " + parts[1].label, contacts);
  } catch (const ScenarioError&) {
    // Which file is it? Each compiles on its own unless it is the culprit.
    for (const Part& part : parts) compile({&part, 1}, spec.models_dir, part.label, contacts);
    throw;
  }
}

}  // namespace dodgesim
