#include <algorithm>
#include <memory>

#include "sim/bench/bench_case.h"
#include "sim/flight/plan.h"
#include "sim/loop.h"

namespace dodgesim {

namespace {

constexpr double kHoverS = 1.5;  // about as long as a throw

struct LoopCase {
  const char* name;
  const char* file;  // of the scenario
  const char* description;
  int throws;  // of a run, unless BenchOptions say otherwise; 0: nobody throws
};

struct Flights {
  Scenario scenario;
  std::vector<FlightPlan> plans;

  std::vector<double> run() const {
    double simulated_s = 0;
    FlightTiming sum;
    for (const FlightPlan& plan : plans) {
      const FlightRecord record = fly(scenario, plan);
      const FlightTiming& timing = record.timing;
      simulated_s += seconds(record.last.t_us);
      sum.total_s += timing.total_s;
      sum.render_s += timing.render_s;
      sum.emulate_s += timing.emulate_s;
      sum.pilot_s += timing.pilot_s;
      sum.keys += timing.keys;
      sum.pictures += timing.pictures;
      sum.regions += timing.regions;
    }
    const auto per_second = [simulated_s](std::int64_t count) {
      return static_cast<double>(count) / simulated_s;
    };
    const double rest_s = sum.total_s - sum.render_s - sum.emulate_s - sum.pilot_s;
    return {simulated_s / sum.total_s, sum.render_s / sum.total_s, sum.emulate_s / sum.total_s,
            sum.pilot_s / sum.total_s, rest_s / sum.total_s,       per_second(sum.keys),
            per_second(sum.pictures),  per_second(sum.regions)};
  }
};

BenchCase loop_case(const LoopCase& loop) {
  const std::string name = std::string("loop.") + loop.name;
  BenchCase bench;
  bench.quantities = {
      {name + ".real_time_factor", "ratio",
       std::string("simulated over computing time, ") + loop.description},
      {name + ".render", "share", "of its time that goes into pictures"},
      {name + ".emulate", "share", "into events"},
      {name + ".pilot", "share", "into the pilot"},
      {name + ".rest", "share", "into everything else"},
      {name + ".keys", "pictures/s",
       "pictures of the room drawn per simulated second, both cameras"},
      {name + ".pictures", "pictures/s", "whole pictures shown from them"},
      {name + ".regions", "pictures/s", "pictures of a moving object's region only"}};
  bench.runs = 3;  // seconds each
  bench.prepare = [loop](const BenchOptions& options) -> BenchRun {
    auto flights = std::make_shared<Flights>();
    flights->scenario =
        load_scenario(options.scenarios_dir + "/" + loop.file + ".yaml", options.models_dir);
    Scenario& scenario = flights->scenario;
    int count = 1;
    if (loop.throws > 0) {
      count = std::min(options.throws > 0 ? options.throws : loop.throws, scenario.repeats);
    } else {
      scenario.throw_spec.reset();
      scenario.throws.clear();
      scenario.duration_s = kHoverS;
    }
    for (int i = 0; i < count; ++i) flights->plans.push_back(plan_throw(scenario, i));
    return [flights] { return flights->run(); };
  };
  return bench;
}

}  // namespace

std::vector<BenchCase> loop_cases() {
  return {loop_case({"demo", "demo", "first throws of scenarios/demo.yaml", 2}),
          loop_case({"goal_flight", "goal_flight", "of scenarios/goal_flight.yaml", 1}),
          loop_case({"ci", "ci", "of scenarios/ci.yaml", 1}),
          loop_case({"hover", "demo", "the demo when nobody throws", 0})};
}

}  // namespace dodgesim
