#include "sim/check/sampling_study.h"

#include <algorithm>
#include <cmath>

#include "sim/base/formatted.h"
#include "sim/check/compare_events.h"
#include "sim/check/film.h"
#include "sim/check/prescribed_throw.h"
#include "sim/check/quantile.h"
#include "sim/files/text_table.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

constexpr double kReferenceFiner = 8;
constexpr double kLeastEvents = 300;  // of a throw, to be judged by itself

constexpr const char* kRoom = "room";
constexpr const char* kVehicle = "qav_rxl";

// The events of one throw, and what they took.
struct StudyFilm {
  std::vector<Event> object, scene;
  double pictures = 0, regions = 0, keys = 0, wall_s = 0;
};

StudyFilm film(const World& world, const PrescribedThrow& toss, const SamplingVariant& variant,
               const SamplingOptions& options) {
  EventRigSetup setup;
  setup.intrinsics = options.intrinsics;
  setup.render = options.render;
  setup.keys = variant.keys;
  setup.sampling = variant.sampling;
  setup.events = without_noise(options.camera);
  setup.cameras = 1;
  setup.seed = options.seed;
  setup.keep_causes = true;
  setup.whole_pictures = variant.whole_pictures;
  EventRig rig(world, setup);
  rig.start();
  rig.require(options.film_us);
  StudyFilm film;
  for (TimeUs t_us = 0; t_us < options.film_us; t_us += kTickUs) {
    rig.advance(toss.at(t_us), toss.at(t_us + kTickUs), [&](int, const Packet& packet) {
      for (std::size_t i = 0; i < packet.events.size(); ++i) {
        (packet.causes[i] == kCauseScene ? film.scene : film.object).push_back(packet.events[i]);
      }
    });
  }
  film.pictures = static_cast<double>(rig.pictures());
  film.regions = static_cast<double>(rig.regions());
  film.keys = static_cast<double>(rig.keys());
  film.wall_s = rig.render_s() + rig.emulate_s();
  return film;
}

// Adds up the throws of one variant.
class Accuracy {
 public:
  void add(const std::vector<Event>& events, const std::vector<Event>& reference) {
    const EventDifference difference = compare(events, reference);
    sum_.events += difference.events;
    sum_.reference_events += difference.reference_events;
    if (difference.reference_events < kLeastEvents) return;
    ++sum_.judged_throws;
    sum_.worst_count = std::max(sum_.worst_count, std::abs(difference.count_ratio - 1));
    medians_us_.push_back(difference.median_us);
  }

  SamplingAccuracy result() const {
    SamplingAccuracy accuracy = sum_;
    accuracy.median_us = quantile(medians_us_, 0.5);
    for (const double median_us : medians_us_) {
      accuracy.worst_median_us = std::max(accuracy.worst_median_us, median_us);
    }
    return accuracy;
  }

 private:
  SamplingAccuracy sum_;
  std::vector<double> medians_us_;
};

}  // namespace

std::vector<SamplingVariant> sampling_variants(const SamplingSpec& sampling, const KeySpec& keys) {
  const auto changed = [&](const std::string& name, const auto& change) {
    SamplingVariant variant{name, sampling, keys};
    change(variant);
    return variant;
  };
  const auto displacement = [&](double px) {
    return changed("max_displacement_px " + formatted("%g", px),
                   [px](SamplingVariant& v) { v.sampling.max_displacement_px = px; });
  };
  const auto supersampling = [&](std::int64_t n) {
    return changed("supersampling " + std::to_string(n),
                   [n](SamplingVariant& v) { v.keys.supersampling = n; });
  };
  const auto misplacement = [&](double px) {
    return changed("max_misplacement_px " + formatted("%g", px),
                   [px](SamplingVariant& v) { v.keys.max_misplacement_px = px; });
  };
  return {changed("as set", [](SamplingVariant&) {}),
          changed("whole pictures", [](SamplingVariant& v) { v.whole_pictures = true; }),
          changed("coarse: max_displacement_px 1, supersampling 2",
                  [](SamplingVariant& v) {
                    v.sampling.max_displacement_px = 1;
                    v.keys.supersampling = 2;
                  }),
          changed("fine: 0.25 px, min_interval_us 60, supersampling 4",
                  [](SamplingVariant& v) {
                    v.sampling.max_displacement_px = 0.25;
                    v.sampling.min_interval_us = 60;
                    v.keys.supersampling = 4;
                  }),
          displacement(0.25),
          displacement(1),
          supersampling(2),
          supersampling(4),
          misplacement(0),
          misplacement(1)};
}

SamplingVariant sampling_reference() {
  SamplingVariant reference{"reference"};
  SamplingSpec& sampling = reference.sampling;
  sampling.max_displacement_px /= kReferenceFiner;
  sampling.min_interval_us =
      static_cast<std::int64_t>(static_cast<double>(sampling.min_interval_us) / kReferenceFiner);
  sampling.min_rate_hz *= kReferenceFiner;
  reference.keys.max_misplacement_px = 0;
  reference.keys.supersampling = 4;
  reference.keys.margin_px = 16;  // the least: no picture is used twice
  return reference;
}

std::vector<SamplingResult> study_sampling(const SamplingOptions& options,
                                           const std::vector<SamplingVariant>& variants,
                                           const std::function<void(int)>& report) {
  std::vector<SamplingResult> results(variants.size());
  std::vector<Accuracy> object(variants.size()), scene(variants.size());
  std::vector<double> wall_s(variants.size());
  for (int k = 0; k < options.throws; ++k) {
    // The camera's place is the vehicle's, whatever is thrown.
    const World bare({options.models_dir, kRoom, kVehicle, {}});
    const auto toss = PrescribedThrow::random(options.seed, k, bare.vehicle().X_BC.front());
    World world({options.models_dir, kRoom, kVehicle, {{options.object, toss.size_m}}});
    world.reset(toss.vehicle.p_W, toss.yaw_rad, toss.vehicle.v_W);
    world.launch(0, toss.object);
    const StudyFilm reference = film(world, toss, sampling_reference(), options);
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const StudyFilm found = film(world, toss, variants[i], options);
      object[i].add(found.object, reference.object);
      scene[i].add(found.scene, reference.scene);
      SamplingResult& result = results[i];
      result.pictures += found.pictures / options.throws;
      result.regions += found.regions / options.throws;
      result.keys += found.keys / options.throws;
      wall_s[i] += found.wall_s;
    }
    report(k + 1);
  }
  for (std::size_t i = 0; i < variants.size(); ++i) {
    results[i].variant = variants[i].name;
    results[i].object = object[i].result();
    results[i].scene = scene[i].result();
    results[i].simulated_per_s = options.throws * seconds(options.film_us) / wall_s[i];
  }
  return results;
}

std::string sampling_table(const std::vector<SamplingResult>& results) {
  TextTable table;
  table.head = {"sampling",      "object: events", "worst throw", "stamps, us", "worst",
                "scene: events", "worst throw",    "stamps, us",  "worst",      "pictures",
                "regions",       "keys",           "real time"};
  for (const SamplingResult& result : results) {
    auto& cells = table.rows.emplace_back();
    cells.push_back(result.variant);
    for (const SamplingAccuracy* a : {&result.object, &result.scene}) {
      if (a->judged_throws == 0) {  // too few events to say anything
        cells.insert(cells.end(), 4, "-");
        continue;
      }
      cells.insert(cells.end(), {formatted("%+.2f %%", 100 * (a->count_ratio() - 1)),
                                 formatted("%.1f %%", 100 * a->worst_count),
                                 fixed_text(a->median_us, 0), fixed_text(a->worst_median_us, 0)});
    }
    cells.insert(cells.end(), {fixed_text(result.pictures, 0), fixed_text(result.regions, 0),
                               fixed_text(result.keys, 1), fixed_text(result.simulated_per_s, 2)});
  }
  return table.to_markdown();
}

Check judge(const std::vector<SamplingResult>& results) {
  Check check{
      "Sampling of the rendered scene",
      "Random throws in the room with a vehicle that moves and turns as it is told, half of "
      "them at 5 rad/s, half of the objects entering the view from the side. Events against "
      "those of a camera that is sampled eight times finer and for which every picture is "
      "drawn anew. Noise and jitter are off."};
  const auto judge_part = [&check](const std::string& part, const SamplingAccuracy& accuracy) {
    if (accuracy.judged_throws == 0) {
      check.off(part, "no throw makes " + formatted("%g", kLeastEvents) + " events of it");
      return;
    }
    check.within(part + ".count", accuracy.count_ratio(), 1, kSamplingCountLimit, "of reference",
                 4);
    check.between(part + ".stamps", accuracy.median_us, 0, kSamplingStampLimitUs, "us", 1);
  };
  judge_part("sampling.object", results.front().object);
  judge_part("sampling.scene", results.front().scene);
  return check;
}

}  // namespace dodgesim
