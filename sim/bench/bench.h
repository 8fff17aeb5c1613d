// Measures and reports what bench_case.h lists.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/bench/bench_case.h"

namespace dodgesim {

struct Measurement {
  Quantity quantity;
  std::vector<double> runs;  // in order

  double median() const;  // the mean of the middle two of an even number
};

// The quantities that `names` ask for: each is the name of one or the first parts of several names
// ("renderer", "emulator.quiet"). None: all. The others are not wanted any more; cases without any
// wanted one are dropped. Throws ScenarioError with the closest name for one that is not known.
std::vector<BenchCase> select(std::vector<BenchCase> cases, const std::vector<std::string>& names);

// Runs the cases one after the other, as often as options.runs or else each case says. `report`
// hears of each wanted quantity when its case is done.
std::vector<Measurement> measure(const std::vector<BenchCase>& cases, const BenchOptions& options,
                                 const std::function<void(const Measurement&)>& report);

// "renderer.whole 0.8123 ms": name, median and unit, without spaces in any of them.
std::string line(const Measurement& measurement);

// Everything with what it was measured on: program, machine, libraries, command line, all runs.
std::string bench_json(const std::vector<Measurement>& measurements,
                       const std::string& command_line, const std::string& gl_renderer);

}  // namespace dodgesim
