// Flights in which nobody throws: what the pilots evade there is not there.
#include "sim/base/numbers.h"
#include "sim/config/pilot.h"
#include "sim/paper/experiment.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

constexpr const char* kQuietProtocol = R"(How to read it:

- *Evaded*: of all flights, those with any command to evade (95 %, Wilson); *crashed*: those that
  touched the room. *False detections*: of an obstacle where there is none, whether the pilot evades
  it or not.
- A flight of hover takes a minute, one to a goal at 1.5 m/s 6 s. All noise is as by default; each
  flight sees through another pair of cameras, with hot pixels and thresholds of its own.
- *One camera*: with the parameters of the paper's indoor experiments (indoor.yaml).
- No pilot was tuned on these throws.
)";

std::vector<std::string> row_of(const LoadedCampaign& campaign) {
  const Scenario& scenario = campaign.scenario;
  Rate evaded, crashed;
  int false_detections = 0;
  double flown_s = 0;
  for (const ThrowResult& result : campaign.results) {
    if (!result.flown.ok()) continue;
    evaded.add(result.evaded);
    crashed.add(result.flown.crashed);
    false_detections += result.detections;
    flown_s += seconds(result.duration_us);
  }
  return {scenario.pilot,
          scenario.dodger.position.stereo_depth() ? "two" : "one",
          scenario.room,
          scenario.mission.type,
          std::to_string(evaded.of),
          fixed_text(flown_s / 60, 1),
          std::to_string(false_detections),
          short_rate_text(evaded),
          short_rate_text(crashed)};
}

PaperTables analyse_quiet(const std::vector<LoadedCampaign>& campaigns) {
  TextTable table;
  table.head = {"pilot",   "cameras",          "room",   "mission", "flights",
                "minutes", "false detections", "evaded", "crashed"};
  for (const LoadedCampaign& campaign : campaigns) table.rows.push_back(row_of(campaign));
  return {table.to_markdown() + "\n" + kQuietProtocol, table.to_csv()};
}

std::vector<PaperFlight> flights_of_quiet() {
  const auto set = paper_setting;
  // As in indoor.yaml.
  const std::vector<Setting> one_camera = {
      set("dodger.position.depth", "mono"), set("dodger.time_image.threshold_b", "0.12"),
      set("dodger.cluster.min_events", "60"), set("dodger.cluster.max_aspect", "2")};
  std::vector<PaperFlight> flights;
  for (const char* pilot : {kPaperPilot, kOwnPilot}) {
    for (const char* mission : {"quiet_hover", "quiet_goal"}) {
      const std::string name = std::string(mission) + "_" + pilot, file = mission;
      for (const char* room : {"room", "field"}) {
        flights.push_back(
            {name + "_" + room, file + ".yaml", {set("pilot", pilot), set("room", room)}});
      }
      flights.push_back({name + "_one_camera", file + ".yaml", {set("pilot", pilot)}});
      auto& settings = flights.back().settings;
      settings.insert(settings.end(), one_camera.begin(), one_camera.end());
    }
  }
  return flights;
}

}  // namespace

PaperExperiment quiet_experiment() {
  PaperExperiment experiment = {"quiet", "Nobody throwing", flights_of_quiet(), analyse_quiet};
  experiment.only_named = true;
  return experiment;
}

}  // namespace dodgesim
