// dodgesim bench: how fast is it on this machine?
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "sim/base/error.h"
#include "sim/bench/bench.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"
#include "sim/render/osmesa_context.h"
#include "tools/commands/command.h"
#include "tools/commands/stop_signal.h"

namespace dodgesim {

namespace {

struct BenchArguments {
  std::vector<std::string> cases;
  std::string json;  // empty: none
  bool list = false;
  BenchOptions options;
};

void list_cases(const std::vector<BenchCase>& cases) {
  for (const BenchCase& bench : cases) {
    for (const Quantity& quantity : bench.quantities) {
      if (!quantity.wanted) continue;
      std::cout << quantity.name << " " << quantity.unit << ": " << quantity.meaning << "\n";
    }
  }
}

void run(const BenchArguments& arguments, const std::string& command_line) {
  const std::vector<BenchCase> cases = select(all_bench_cases(), arguments.cases);
  if (arguments.list) return list_cases(cases);

  if (!arguments.options.plots_dir.empty() && std::ranges::none_of(cases, &BenchCase::plots)) {
    throw ScenarioError("--plots draws the times of the pilot: name a case of it, or none.");
  }
  if (!arguments.options.plots_dir.empty()) make_directory(arguments.options.plots_dir);
  std::optional<OutputFile> json;  // opened first, so that a failure shows at once
  if (!arguments.json.empty()) json.emplace(arguments.json);
  if (json) watch_stop_signals();
  const auto measurements = measure(cases, arguments.options, [](const Measurement& measurement) {
    std::cout << line(measurement) << std::endl;
    end_if_asked_to_stop();
  });
  if (!json) return;
  const std::string gl_renderer = OsmesaContext(GlProfile::kCore33, 1, 1).renderer();
  json->write(bench_json(measurements, command_line, gl_renderer));
  json->commit();
}

}  // namespace

void add_bench_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<BenchArguments>();
  arguments->options.scenarios_dir = DODGESIM_SCENARIOS_DIR;
  CLI::App* command = program.add_subcommand(
      "bench", "Measure how fast emulator, renderer and closed loop are on this machine");
  command
      ->add_option("cases", arguments->cases,
                   "Which: names or their first parts (emulator, loop.demo); all when left out")
      ->type_name("CASE");
  command
      ->add_option("--json", arguments->json,
                   "Also write all runs, with machine, compiler and commit, to this file")
      ->check(file_ending(".json"))
      ->type_name("FILE.json");
  command
      ->add_option(
          "--plots", arguments->options.plots_dir,
          "Also draw, and write as CSV, the pilot's times by events and by pixels (figures\n"
          "S4 and S5 of the paper), into this folder")
      ->type_name("DIR");
  command
      ->add_option("--runs", arguments->options.runs,
                   "Runs of each case, in place of 5 (closed loop: 3)")
      ->check(whole_number_between(1, 1000));
  command
      ->add_option("--throws", arguments->options.throws,
                   "Throws of each scenario in a run of the closed loop, in place of 2 (demo) or 1")
      ->check(whole_number_between(1, 1000));
  command->add_flag("--list", arguments->list, "Print names, units and meanings; measure nothing");
  add_models_option(*command, arguments->options.models_dir);
  command->footer(
      "Prints a line \"case value unit\" each, the value being the median of the runs. One "
      "thread;\n"
      "nothing else should run on the machine. Wall-clock times of the parts named, without\n"
      "preparation; cv::log runs over each picture right after the emulator.\n\n"
      "Examples:\n"
      "  dodgesim bench --json bench.json\n"
      "  dodgesim bench emulator.textured renderer --runs 11");
  command->callback([arguments, command_line, &exit_code] {
    run(*arguments, command_line);
    exit_code = kOk;
  });
}

}  // namespace dodgesim
