// What physics allows a vehicle that is told of the object, by range, latency and gains.
#include <array>

#include "sim/base/contains.h"
#include "sim/paper/experiment.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

// Percent dodged in a study with a rigid body, motors of first order and the paper's field, made
// before this simulator: a row for each speed, a column for each ball.
constexpr std::array kStudySpeedsMps = {4.0, 5.0, 6.0, 8.0, 10.0};
constexpr std::array kStudySizesM = {0.1, 0.2, 0.3};
using Study = std::array<std::array<int, kStudySizesM.size()>, kStudySpeedsMps.size()>;

// Its row of faster gains does not say whether its escapes are straight up, as in the row before.
constexpr Study kStudyAgile = {
    {{91, 85, 73}, {93, 87, 79}, {90, 81, 69}, {71, 49, 19}, {46, 15, 0}}};

struct PhysicsVariant {
  PaperVariant variant;
  Study study;
};

const std::vector<PhysicsVariant>& physics_variants() {
  const auto range = [](const char* metres) { return paper_setting("oracle.range_cap_m", metres); };
  const auto set = paper_setting;
  const Setting up = set("dodger.repulsive.head_on_sine", "1");
  const std::vector<Setting> agile = {set("controller.evading_velocity_gain_1ps", "15"),
                                      set("controller.attitude_gain_xy_1ps", "20"),
                                      set("controller.evading_speed_limit_mps", "10"),
                                      set("dodger.velocity_limit.max_speed_mps", "10"),
                                      set("motors.time_constant_up_s", "0.025"),
                                      set("motors.time_constant_down_s", "0.025"),
                                      set("flight_controller.motor_time_constant_s", "0.025")};
  std::vector<Setting> agile_up = agile;
  agile_up.push_back(up);
  static const std::vector<PhysicsVariant> all = {
      {{"1_5m", "range 1.5 m (the paper's)", {}},
       {{{77, 65, 50}, {83, 67, 33}, {79, 56, 24}, {51, 27, 3}, {31, 4, 0}}}},
      {{"middle", "range 1.5 m, aimed at the vehicle's middle", {set("throw.aim_offset_m", "0")}},
       {{{77, 65, 50}, {83, 67, 33}, {79, 56, 24}, {51, 27, 3}, {31, 4, 0}}}},
      {{"up", "range 1.5 m, every escape straight up", {up}},
       {{{88, 67, 43}, {98, 77, 57}, {90, 69, 42}, {57, 27, 7}, {33, 7, 0}}}},
      {{"agile", "range 1.5 m, gains 15 and 20 1/s, limit 10 m/s, motors 25 ms", agile},
       kStudyAgile},
      {{"agile_up", "range 1.5 m, these gains, and every escape straight up", agile_up},
       kStudyAgile},
      {{"2m", "range 2 m", {range("2")}},
       {{{100, 100, 99}, {100, 98, 95}, {96, 89, 79}, {89, 82, 49}, {67, 51, 29}}}},
      {{"2_5m", "range 2.5 m", {range("2.5")}},
       {{{100, 100, 100}, {100, 100, 100}, {100, 100, 100}, {100, 91, 82}, {97, 83, 59}}}},
      {{"3m", "range 3 m", {range("3")}},
       {{{100, 100, 100}, {100, 100, 100}, {100, 100, 100}, {100, 100, 100}, {100, 95, 84}}}},
      {{"3m_40ms",
        "range 3 m, 40 ms from light to command",
        {range("3"), set("delays.perception_us", "30150")}},
       {{{100, 100, 100}, {100, 100, 100}, {100, 100, 100}, {100, 100, 99}, {99, 93, 83}}}},
      {{"3m_70ms",
        "range 3 m, 70 ms from light to command",
        {range("3"), set("delays.perception_us", "60150")}},
       {{{100, 100, 100}, {100, 100, 100}, {100, 100, 100}, {100, 98, 89}, {89, 82, 64}}}},
      {{"slow",
        "range 1.5 m, command limit 2 m/s",
        {set("controller.evading_speed_limit_mps", "2"),
         set("dodger.velocity_limit.max_speed_mps", "2")}},
       {{{51, 27, 7}, {27, 11, 1}, {16, 2, 0}, {14, 0, 0}, {7, 0, 0}}}}};
  return all;
}

constexpr const char* kPhysicsProtocol = R"(How to read it:

- Dodged / would have hit (95 % Wilson), and after it what a study of a rigid body with
  motors of first order, the paper's field and perfect perception found, in percent. **Bold**: the
  interval does not hold the study's figure.
- The study does not say where its throws were aimed at nor from which height they came. Ours come
  from the vehicle's height and would hit anywhere at the hull; one table shows what becomes of them
  when they are aimed at its middle: where a ball would hit decides how far the vehicle must go.
- *Every escape straight up*: as for a head-on throw, `dodger.repulsive.head_on_sine` 1. What the
  study says of faster gains may be with or without it: its figures stand beside both.
- Our vehicle is the whole chain but perception: rotors, mixer, body-rate loop, velocity controller
  and state estimate, with noise.
)";

// The rate, with the study's figure if it has one.
std::string beside_study(const Rate& rate, const Study& study, double speed_mps, double size_m) {
  const auto speed = index_of(kStudySpeedsMps, speed_mps), size = index_of(kStudySizesM, size_m);
  if (!speed || !size) return short_rate_text(rate);
  const int percent = study[*speed][*size];
  const std::string text = short_rate_text(rate) + ", " + std::to_string(percent);
  return rate.interval().contains(0.01 * percent) ? text : "**" + text + "**";
}

// A row for each size, a column for each speed.
RateGrid grid_of(const PhysicsVariant& variant, const LoadedCampaign& campaign, const Axis& sizes,
                 const Axis& speeds) {
  RateGrid grid{variant.variant.name, speed_columns(speeds)};
  for (std::size_t size = 0; size < sizes.values().size(); ++size) {
    Results of_size;
    for (const ThrowResult& result : campaign.results) {
      if (sizes.of(result) == size) of_size.push_back(&result);
    }
    grid.add_row(sizes.values()[size] + " m", success_by(speeds, of_size));
  }
  return grid;
}

PaperTables analyse_physics(const std::vector<LoadedCampaign>& campaigns) {
  PaperTables tables;
  std::vector<RateGrid> grids;
  for (std::size_t v = 0; v < campaigns.size(); ++v) {
    const PhysicsVariant& variant = physics_variants().at(v);
    const Axis speeds("speed_mps", campaigns[v].results), sizes("size_m", campaigns[v].results);
    grids.push_back(grid_of(variant, campaigns[v], sizes, speeds));
    TextTable table = grids.back().table();
    for (std::size_t size = 0; size < sizes.middles().size(); ++size) {
      for (std::size_t speed = 0; speed < speeds.middles().size(); ++speed) {
        table.rows[size][speed + 1] = beside_study(grids.back().rates[size][speed], variant.study,
                                                   speeds.middles()[speed], sizes.middles()[size]);
      }
    }
    tables.markdown += table.to_markdown() + "\n";
  }
  tables.markdown += kPhysicsProtocol;
  tables.csv = rates_csv(grids);
  return tables;
}

}  // namespace

PaperExperiment physics_experiment() {
  std::vector<PaperVariant> variants;
  for (const PhysicsVariant& variant : physics_variants()) variants.push_back(variant.variant);
  return {"physics", "What physics allows, by range, latency and gains",
          flights_of("physics_", "claims_physics.yaml", variants), analyse_physics};
}

}  // namespace dodgesim
