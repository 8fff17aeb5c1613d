#include "sim/bench/bench.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/campaign/build_info.h"
#include "sim/campaign/manifest.h"
#include "sim/config/closest_name.h"
#include "sim/files/json.h"
#include "sim/files/text_table.h"

namespace dodgesim {

namespace {

// Whether `asked` is the name or its first parts.
bool names(const std::string& asked, const std::string& name) {
  return name == asked || name.starts_with(asked + ".");
}

// All that may be asked for: every name and its first parts.
std::vector<std::string> known_names(const std::vector<BenchCase>& cases) {
  std::set<std::string> known;
  for (const BenchCase& bench : cases) {
    for (const Quantity& quantity : bench.quantities) {
      const std::string& name = quantity.name;
      known.insert(name);
      for (std::size_t dot = name.find('.'); dot != std::string::npos;
           dot = name.find('.', dot + 1)) {
        known.insert(name.substr(0, dot));
      }
    }
  }
  return {known.begin(), known.end()};
}

}  // namespace

double Measurement::median() const {
  std::vector<double> sorted = runs;
  std::ranges::sort(sorted);
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

std::vector<BenchCase> all_bench_cases() {
  std::vector<BenchCase> all;
  for (const auto& cases : {emulator_cases(), renderer_cases(), pilot_cases(), loop_cases()}) {
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

std::vector<BenchCase> select(std::vector<BenchCase> cases,
                              const std::vector<std::string>& asked_names) {
  if (asked_names.empty()) return cases;
  const std::vector<std::string> known = known_names(cases);
  for (const std::string& asked : asked_names) {
    if (contains(known, asked)) continue;
    std::string near = closest_name(asked, known);
    for (const std::string& name : known) {
      if (name.ends_with("." + asked)) near = name;  // the first part was left out
    }
    throw ScenarioError("There is no benchmark case \"" + asked + "\"" +
                        (near.empty() ? "; --list names them all." : did_you_mean(near)));
  }
  for (BenchCase& bench : cases) {
    for (Quantity& quantity : bench.quantities) {
      quantity.wanted = std::ranges::any_of(
          asked_names, [&](const auto& asked) { return names(asked, quantity.name); });
    }
  }
  std::erase_if(cases, [](const BenchCase& bench) {
    return std::ranges::none_of(bench.quantities, &Quantity::wanted);
  });
  return cases;
}

std::vector<Measurement> measure(const std::vector<BenchCase>& cases, const BenchOptions& options,
                                 const std::function<void(const Measurement&)>& report) {
  std::vector<Measurement> measurements;
  for (const BenchCase& bench : cases) {
    const BenchRun run = bench.prepare(options);
    std::vector<Measurement> measured;
    for (const Quantity& quantity : bench.quantities) measured.push_back({quantity, {}});
    const int runs = options.runs > 0 ? options.runs : bench.runs;
    for (int i = 0; i < runs; ++i) {
      const std::vector<double> values = run();
      if (values.size() != measured.size()) {
        throw std::logic_error("A benchmark measures what it does not name, or not all.");
      }
      for (std::size_t q = 0; q < measured.size(); ++q) measured[q].runs.push_back(values[q]);
    }
    for (const Measurement& measurement : measured) {
      if (!measurement.quantity.wanted) continue;
      report(measurement);
      measurements.push_back(measurement);
    }
  }
  return measurements;
}

std::string line(const Measurement& measurement) {
  const double value = measurement.median();
  int decimals = 4;
  for (double limit = 1; decimals > 0 && value >= limit; limit *= 10) --decimals;
  return measurement.quantity.name + " " + fixed_text(value, decimals) + " " +
         measurement.quantity.unit;
}

std::string bench_json(const std::vector<Measurement>& measurements,
                       const std::string& command_line, const std::string& gl_renderer) {
  const BuildInfo build = build_info();
  Json json;
  json["program"] = program_group();
  json["libraries"] = {
      {"mujoco", build.mujoco}, {"opencv", build.opencv}, {"gl_renderer", gl_renderer}};
  json["machine"] = machine_group();
  json["bench"] = {{"command_line", command_line}, {"finished", utc_now()}};
  json["cases"] = Json::array();
  for (const Measurement& measurement : measurements) {
    json["cases"].push_back({{"case", measurement.quantity.name},
                             {"unit", measurement.quantity.unit},
                             {"meaning", measurement.quantity.meaning},
                             {"median", measurement.median()},
                             {"runs", measurement.runs}});
  }
  return to_text(json, 2) + "\n";
}

}  // namespace dodgesim
