// The detector's threshold a |w| + b (5), and what it costs that only rotation is compensated.
#include <algorithm>

#include "dodge/presets.h"
#include "sim/config/pilot.h"
#include "sim/flight/setup.h"
#include "sim/paper/experiment.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

constexpr const char* kThresholdProtocol = R"(How to read it:

- falanga2020 with detections up to 3 m; bold: this pilot's values of a and b (the paper gives none).
- *Recall*: of the events that a ball made, those in a cluster; *false*: of the events in clusters,
  those that no ball made. *Before*: until the first evasive command; *evading*: after it, when the
  camera turns fast. In brackets the least and the greatest of the single throws: there are too few
  for an interval of another kind.
- *False alarms*: evasions before any detection of a ball. Intervals: 95 %, Wilson.
)";

constexpr const char* kTranslationProtocol = R"(How to read it:

- falanga2020 with detections up to 3 m flies towards its goal and is thrown at from ahead. Its
  ego-motion compensation (1) knows of rotation alone. The balls have the same speed over the ground,
  so that they come the faster the faster it flies: the oracle, which is told of them from 3 m on and
  avoids them likewise, shows what that costs.
- *Image motion*: how far translation alone moves the image of a resting point, 30 degrees off the
  direction of flight and 3 m ahead, within a window of events: f v tan(30 deg) dt / 3 m.
- *Recall*, *false*, *false alarms*: as for the threshold (threshold.md). *Before*: until the first
  evasive command. Intervals: 95 %, Wilson.
)";

// What the cameras saw and the pilot made of it, at one setting.
struct Perception {
  Tally tally;
  Rate false_alarms;
  Measured distance_m;  // of the first detection
  EventTruthSums events;
  std::vector<EventTruthSums> throws;  // of each alone
};

Perception perception_of(const Results& results) {
  Perception sum;
  for (const ThrowResult* result : results) {
    sum.tally.add(*result);
    if (result->flown.ok()) sum.false_alarms.add(result->false_alarm);
    sum.distance_m.add(result->first_detection_distance_m);
    sum.events.add(result->truth_rows);
    sum.throws.emplace_back().add(result->truth_rows);
  }
  return sum;
}

using Share = std::optional<double>;

Share recall(const EventTruthCounts& counts) { return counts.recall(); }

Share false_share(const EventTruthCounts& counts) {
  const Share precision = counts.precision();
  return precision ? Share(1 - *precision) : std::nullopt;
}

// "11.7 % (8.2 to 15.0)": of all events, and of the throws with the least and the most.
std::string percent(const Perception& sum, EventTruthCounts EventTruthSums::*when,
                    Share (*share_of)(const EventTruthCounts&)) {
  const Share whole = share_of(sum.events.*when);
  if (!whole) return "-";
  double least = *whole, most = *whole;
  for (const EventTruthSums& one : sum.throws) {
    const double share = share_of(one.*when).value_or(*whole);
    least = std::min(least, share);
    most = std::max(most, share);
  }
  return fixed_text(100 * *whole, 1) + " % (" + fixed_text(100 * least, 1) + " to " +
         fixed_text(100 * most, 1) + ")";
}

const std::vector<std::string>& perception_head() {
  static const std::vector<std::string> head = {
      "dodged",          "first detection [m]", "false alarms",  "recall, before",
      "recall, evading", "false, before",       "false, evading"};
  return head;
}

std::vector<std::string> perception_cells(const Perception& sum) {
  using Sums = EventTruthSums;
  return {short_rate_text(sum.tally.success()),   median_text(sum.distance_m, 2),
          short_rate_text(sum.false_alarms),      percent(sum, &Sums::before, recall),
          percent(sum, &Sums::after, recall),     percent(sum, &Sums::before, false_share),
          percent(sum, &Sums::after, false_share)};
}

// The same as numbers.
const std::vector<std::string>& number_head() {
  static const std::vector<std::string> head = {
      "dodged",        "would_have_hit", "first_detection_m", "false_alarms", "flights",
      "recall_before", "recall_evading", "false_before",      "false_evading"};
  return head;
}

std::vector<std::string> number_cells(const Perception& sum) {
  const auto share = [](Share value) { return value ? fixed_text(*value, 4) : ""; };
  const auto distance = sum.distance_m.quantile(0.5);
  const EventTruthCounts &before = sum.events.before, &after = sum.events.after;
  return {std::to_string(sum.tally.dodged),
          std::to_string(sum.tally.would_have_hit),
          distance ? fixed_text(distance->value, 3) : "",
          std::to_string(sum.false_alarms.count),
          std::to_string(sum.false_alarms.of),
          share(recall(before)),
          share(recall(after)),
          share(false_share(before)),
          share(false_share(after))};
}

using Texts = std::vector<std::string>;

Texts chained(Texts a, const Texts& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// For people, and as numbers.
struct PerceptionTables {
  TextTable shown, numbers;

  PerceptionTables(const Texts& first, const Texts& first_numbers)
      : shown{chained(first, perception_head()), {}},
        numbers{chained(first_numbers, number_head()), {}} {}
  void add_row(const Texts& first, const Texts& first_numbers, const Results& results) {
    const Perception sum = perception_of(results);
    shown.rows.push_back(chained(first, perception_cells(sum)));
    numbers.rows.push_back(chained(first_numbers, number_cells(sum)));
  }
};

// Returns the table for people, and adds to the numbers.
TextTable threshold_table(const std::string& name, const std::string& key, double paper,
                          const LoadedCampaign& campaign, TextTable& numbers) {
  PerceptionTables tables({name}, {"key", "value"});
  for (const Part& part : parts_of(campaign)) {
    const std::string value = sweep_value(part, key);
    const bool bold = sweep_number(part, key) == paper;
    tables.add_row({bold ? "**" + value + "**" : value}, {key, value}, part.results);
  }
  numbers.head = tables.numbers.head;
  numbers.rows.insert(numbers.rows.end(), tables.numbers.rows.begin(), tables.numbers.rows.end());
  return tables.shown;
}

PaperTables analyse_threshold(const std::vector<LoadedCampaign>& campaigns) {
  const dodge::TimeImageConfig paper = dodge::preset(kPaperPilot).time_image;
  TextTable numbers;
  const TextTable a = threshold_table("a [s]", "dodger.time_image.threshold_a_s",
                                      paper.threshold_a_s, campaigns[0], numbers);
  const TextTable b = threshold_table("b", "dodger.time_image.threshold_b", paper.threshold_b,
                                      campaigns[1], numbers);
  return {a.to_markdown() + "\n" + b.to_markdown() + "\n" + kThresholdProtocol, numbers.to_csv()};
}

double image_motion_px(double speed_mps, const Scenario& scenario) {
  constexpr double kDistanceM = 3, kTangent = 0.57735026918962573;  // of 30 degrees
  const double window_s = 1e-6 * static_cast<double>(scenario.dodger.window.window_us);
  return intrinsics(scenario.sensors.camera).f * speed_mps * kTangent * window_s / kDistanceM;
}

PaperTables analyse_translation(const std::vector<LoadedCampaign>& campaigns) {
  const LoadedCampaign& campaign = campaigns.front();
  PerceptionTables tables({"flight [m/s]", "image motion [px]", "oracle: dodged"},
                          {"flight_mps", "image_motion_px", "oracle_dodged"});
  for (const Part& part : parts_of(campaign)) {
    const double speed_mps = sweep_number(part, "mission.speed_mps");
    Tally oracle;
    for (const ThrowResult* result : part.results) oracle.add(*result, &ThrowResult::oracle);
    const std::string flight = sweep_value(part, "mission.speed_mps");
    const std::string motion_px = fixed_text(image_motion_px(speed_mps, campaign.scenario), 2);
    tables.add_row({flight, motion_px, short_rate_text(oracle.success())},
                   {flight, motion_px, std::to_string(oracle.dodged)}, part.results);
  }
  return {tables.shown.to_markdown() + "\n" + kTranslationProtocol, tables.numbers.to_csv()};
}

}  // namespace

PaperExperiment threshold_experiment() {
  return {"threshold",
          "The threshold's a and b",
          {{"threshold_a", "claims_threshold_a.yaml", {}, true},
           {"threshold_b", "claims_threshold_b.yaml", {}, true}},
          analyse_threshold};
}

PaperExperiment translation_experiment() {
  return {"translation",
          "Neglecting translation in ego-motion compensation",
          {{"translation", "claims_translation.yaml", {}, true}},
          analyse_translation};
}

}  // namespace dodgesim
