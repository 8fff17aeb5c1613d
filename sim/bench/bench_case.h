// What `dodgesim bench` can measure.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace dodgesim {

struct BenchOptions {
  int runs = 0;    // of each case; 0: as many as the case says
  int throws = 0;  // of a scenario, in one run of the closed loop; 0: as many as the case says
  std::string models_dir;
  std::string scenarios_dir;
  std::string plots_dir;  // for plots of what was measured; empty: none
};

// One number of a case.
struct Quantity {
  std::string name;  // "renderer.whole"; parts of the name are separated by dots
  std::string unit;
  std::string meaning;
  bool wanted = true;  // reported, not only measured with the others of its case
};

// One run of a case: a value for each of its quantities.
using BenchRun = std::function<std::vector<double>()>;

// Quantities that are measured together.
struct BenchCase {
  std::vector<Quantity> quantities;
  int runs = 5;        // unless BenchOptions say otherwise
  bool plots = false;  // draws, if BenchOptions say where
  // Makes everything that is not to be timed.
  std::function<BenchRun(const BenchOptions&)> prepare;
};

// All cases, in the order of the report. Each folder of the simulator that is measured has a list.
std::vector<BenchCase> all_bench_cases();
std::vector<BenchCase> emulator_cases();  // the event camera alone, beside cv::log
std::vector<BenchCase> renderer_cases();
std::vector<BenchCase> pilot_cases();  // the flight core alone
std::vector<BenchCase> loop_cases();   // whole flights

}  // namespace dodgesim
