// dodgesim check-sensor: self-tests of the event camera.
#include <iostream>
#include <memory>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/progress.h"
#include "sim/campaign/campaign_files.h"
#include "sim/check/report.h"
#include "sim/check/sampling_study.h"
#include "sim/check/self_tests.h"
#include "sim/check/time_statistics.h"
#include "sim/config/event_camera_file.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"
#include "sim/flight/setup.h"
#include "tools/commands/command.h"
#include "tools/commands/stop_signal.h"

namespace dodgesim {

namespace {

constexpr const char* kFooter =
    R"(One line a check: name, measured, expected, and ok, FAIL or off (that part of the camera is
switched off). Exit code 1 if one fails. Limits on random numbers are three standard deviations:
of a hundred other seeds, some fail by chance.

Examples:
  dodgesim check-sensor
  dodgesim check-sensor --camera ideal --out out/check     with out/check/report.html)";

// Of scenarios/demo.yaml, for the time statistics: a ball of 30 cm at 6 m/s.
constexpr int kThrow = 1;

struct CheckSensorArguments {
  std::string camera = "sees1";
  std::string out;  // empty: no report
  std::uint64_t seed = 1;
  int sampling = 0;  // throws of the study; 0: none
  std::string object = "ball";
  std::string models_dir;
};

// The study of the sampling instead of the checks.
int study(const CheckSensorArguments& arguments) {
  const SensorsSpec sensors = named_sensors(arguments.camera);
  SamplingOptions options;
  options.models_dir = arguments.models_dir;
  options.throws = arguments.sampling;
  options.seed = arguments.seed;
  options.camera = sensors.events;
  options.intrinsics = intrinsics(sensors.camera);
  options.render = sensors.render;
  options.object = arguments.object;
  Progress progress(arguments.sampling, "throws");
  const auto results = study_sampling(options, sampling_variants(sensors.sampling, sensors.keys),
                                      [&](int finished) { progress.show(finished); });
  progress.finish();
  std::cout << sampling_table(results) << "\n";
  const Check check = judge(results);
  for (const CheckLine& line : check.lines) std::cout << line_text(line) << std::endl;
  return check.failed() ? kBelowBar : kOk;
}

int check_sensor(const CheckSensorArguments& arguments, const std::string& command_line) {
  const EventCameraSpec camera = named_event_camera(arguments.camera);
  if (!arguments.out.empty()) expect_no_campaign(arguments.out);
  auto make_checks = sensor_checks(camera, arguments.seed);
  std::optional<OutputFile> report;
  if (!arguments.out.empty()) {
    Scenario scenario = load_scenario(DODGESIM_SCENARIOS_DIR "/demo.yaml", arguments.models_dir);
    scenario.sensors.events = camera;
    make_checks.push_back([scenario] { return judge(measure_time_statistics(scenario, kThrow)); });
    report.emplace(make_directory(arguments.out) / "report.html");
  }
  if (report) watch_stop_signals();
  std::vector<Check> checks;
  bool failed = false;
  for (const auto& make_check : make_checks) {
    end_if_asked_to_stop();
    checks.push_back(make_check());
    failed = failed || checks.back().failed();
    for (const CheckLine& line : checks.back().lines) std::cout << line_text(line) << std::endl;
  }
  if (report) {
    report->write(html_report(command_line + " (dodgesim " DODGESIM_VERSION ")", checks));
    report->commit();
    std::cout << "Report: " << arguments.out << "/report.html\n";
  }
  return failed ? kBelowBar : kOk;
}

}  // namespace

void add_check_sensor_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<CheckSensorArguments>();
  CLI::App* command = program.add_subcommand(
      "check-sensor", "Test whether the event camera does what its parameters say");
  command
      ->add_option("--camera", arguments->camera,
                   "sees1, ideal, noisy, low_light, a YAML file with the keys of sensors.events, "
                   "or a scenario")
      ->capture_default_str()
      ->type_name("CAMERA");
  CLI::Option* out =
      command
          ->add_option(
              "--out", arguments->out,
              "Write a report with plots there, made when missing. Then also flies a throw of\n"
              "scenarios/demo.yaml, for the time statistics of static and dynamic regions")
          ->type_name("DIR");
  command->add_option("--seed", arguments->seed, "Of the camera and of the scenes")
      ->check(whole_number_between(0, UINT64_MAX))
      ->capture_default_str();
  CLI::Option* sampling =
      command
          ->add_option(
              "--sampling", arguments->sampling,
              "Instead: what the sampling of the rendered scene costs in accuracy, over this\n"
              "many random throws, for several settings; some 30 s a throw. If CAMERA is a\n"
              "scenario: with its camera, render, sampling and keys")
          ->check(whole_number_between(1, 10000))
          ->excludes(out)
          ->type_name("THROWS");
  command
      ->add_option("--object", arguments->object,
                   "What is thrown for that: an object of the models")
      ->needs(sampling)
      ->capture_default_str()
      ->type_name("NAME");
  add_models_option(*command, arguments->models_dir);
  command->footer(kFooter);
  command->callback([arguments, command_line, &exit_code] {
    exit_code =
        arguments->sampling > 0 ? study(*arguments) : check_sensor(*arguments, command_line);
  });
}

}  // namespace dodgesim
