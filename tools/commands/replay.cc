// dodgesim replay: flies one throw of a campaign again, bit-identically.
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <optional>
#include <vector>

#include "sim/base/error.h"
#include "sim/campaign/campaign_directory.h"
#include "sim/campaign/campaign_files.h"
#include "sim/campaign/journal.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "sim/config/scenario_changes.h"
#include "sim/config/yaml_tree.h"
#include "sim/files/csv.h"
#include "sim/files/csv_table.h"
#include "sim/flight/fly_throw.h"
#include "sim/flight/setup.h"
#include "sim/preflight/try_models.h"
#include "sim/preflight/try_plugin.h"
#include "tools/commands/command.h"
#include "tools/commands/replay_onlookers.h"
#include "tools/commands/stop_signal.h"

namespace dodgesim {

namespace {

// Somebody may have changed the file since: what it says now, nobody has flown.
void expect_scenario(const std::string& directory, const JournalIndex& index) {
  const std::string file = directory + "/" + kScenarioFile;
  const std::string text = read_scenario_text(file);
  if (scenario_changes(text, index.identity.scenario).empty()) return;
  throw ScenarioError(file + " is not the scenario that " + directory + " was flown with (" +
                      scenario_difference(text, index.identity.scenario) +
                      "); to fly another one, `dodgesim run` it.");
}

// With other models, or with another plug-in if that is the pilot, it would be another throw.
void expect_models(const Scenario& campaign, const std::string& pilot, const std::string& directory,
                   const JournalIndex& index) {
  CampaignIdentity now = index.identity;
  now.models = digest_of_models(campaign);
  if (pilot == kPluginPilot) now.plugin = campaign.plugin.digest;
  if (now == index.identity) return;
  throw ScenarioError(directory + " holds results " + difference(index.identity, now) +
                      "; --models and --plugin say where those are that it was flown with.");
}

// The result of this throw, from the journal, which a campaign under way has, too; nothing if its
// worker died.
std::optional<ThrowResult> recorded_result(const std::filesystem::path& directory,
                                           const JournalIndex& index, int throw_index) {
  const auto record = index.throws.find(throw_index);
  if (record == index.throws.end()) {
    throw ScenarioError(directory.string() + " has no result of throw " +
                        std::to_string(throw_index) + ".");
  }
  ThrowResult result = read_result(directory / kJournalFile, record->second);
  if (!result.lost()) return result;
  std::cerr << "Throw " << throw_index
            << " was lost, there is nothing to compare with: " << result.flown.error << "\n";
  return std::nullopt;
}

// The columns in which two rows differ, a line each.
std::string differences(const std::string& header, const std::string& recorded,
                        const std::string& flown) {
  const CsvTable rows(header + recorded + flown, "The throw");
  const auto shown = [](const std::string& cell) { return cell.empty() ? "nothing" : cell; };
  std::string text;
  for (const std::string& column : rows.columns()) {
    const std::string &before = rows.at(0, column), &now = rows.at(1, column);
    if (before == now) continue;
    text += "  " + column + ": recorded " + shown(before) + ", flown " + shown(now) + "\n";
  }
  return text;
}

struct OutputOption {
  const char* name;
  const std::string& file;
};

// Before anything flies for them.
void refuse(std::initializer_list<OutputOption> options, const std::string& why) {
  for (const OutputOption& option : options) {
    if (option.file.empty()) continue;
    throw ScenarioError(std::string(option.name) + " " + option.file + ": " + why);
  }
}

void expect_showable(const Scenario& scenario, const ReplayArguments& arguments) {
  if (!arguments.camera.empty() && arguments.events.empty() && arguments.frames.empty()) {
    throw ScenarioError("--camera says whose --events or --frames are written; neither is given.");
  }
  if (!arguments.frames.empty() && arguments.frames == arguments.timestamps) {
    throw ScenarioError("--timestamps " + arguments.timestamps + ": is the file of the frames.");
  }
  const std::string number = std::to_string(arguments.throw_index);
  const OutputOption events = {"--events", arguments.events};
  const OutputOption stages = {"--stages", arguments.stages};
  const OutputOption picture = {"--picture", arguments.picture};
  if (!perceives(scenario.pilot)) {
    refuse({events, stages}, "the pilot of throw " + number + " is " + scenario.pilot +
                                 ", which flies without cameras.");
  }
  if (!scenario.dodger.position.stereo_depth() && arguments.camera_name() != kCameraNames[0]) {
    refuse({events}, "with dodger.position.depth mono there are no events of the camera " +
                         arguments.camera_name() + ".");
  }
  if (scenario.pilot == kPluginPilot) {
    refuse({stages}, "the pilot of throw " + number + " is a plug-in, whose stages nobody knows.");
  }
  if (!scenario.anyone_throws()) {
    refuse({picture, stages}, "in throw " + number + " nobody throws.");
  }
}

int replay(const ReplayArguments& arguments) {
  const std::string& directory = arguments.directory;
  const JournalIndex index = read_journal(std::filesystem::path(directory) / kJournalFile);
  const Scenario campaign = with_plugin(
      load_scenario(directory + "/" + kScenarioFile, arguments.models_dir), arguments.plugin);
  expect_scenario(directory, index);
  if (arguments.throw_index >= throw_count(campaign)) {
    throw ScenarioError(directory + " has no throw " + std::to_string(arguments.throw_index) + ".");
  }
  const Scenario scenario = case_of(campaign, arguments.throw_index).scenario;
  expect_models(campaign, scenario.pilot, directory, index);
  try_models({campaign});
  if (!campaign.plugin.file.empty() || scenario.pilot == kPluginPilot) try_plugin(campaign);
  expect_showable(scenario, arguments);
  if (!arguments.stages.empty()) expect_no_campaign(arguments.stages, "--stages");
  if (!arguments.record.empty()) {
    expect_no_campaign(arguments.record, "--record");
    expect_recording_or_nothing(arguments.record, "--record");
  }
  const std::optional<ThrowResult> recorded =
      recorded_result(directory, index, arguments.throw_index);

  watch_stop_signals();
  const bool length_known = recorded && recorded->flown.ok();
  Onlookers onlookers(scenario, arguments,
                      length_known ? std::optional(recorded->duration_us) : std::nullopt);
  const ThrowResult result = fly_throw(campaign, arguments.throw_index, onlookers.observer());
  onlookers.end_progress();
  if (result.flown.failed()) {
    std::cerr << "Throw " << arguments.throw_index << " fails: " << result.flown.error << "\n";
  }
  const bool shown = onlookers.finish(result);
  if (!recorded) return kIncomplete;
  const std::string flown = csv_row(result), before = csv_row(*recorded);
  if (flown == before) {
    std::cout << "Throw " << arguments.throw_index
              << (result.flown.failed() ? " fails as recorded.\n"
                                        : " flew as recorded, bit for bit.\n");
    return shown ? kOk : kIncomplete;
  }
  std::cerr << "Throw " << arguments.throw_index
            << " did not fly as recorded: was it another commit or another kind of machine, or "
               "does its pilot not do the same twice?\n"
            << differences(csv_header(result), before, flown);
  return kBelowBar;
}

void add_event_options(CLI::App& command, ReplayArguments& arguments) {
  command
      .add_option(
          "--events", arguments.events,
          "Write a camera's events with their causes (t, x, y, p, cause), as far as they\n"
          "reach the computer before the flight ends, and print how well the pilot finds\n"
          "an object's events. Causes: 0 the static scene, moved by ego-motion; 1 + i\n"
          "object i; 253 leak; 254 shot noise; 255 a hot pixel. In .raw (Prophesee) without")
      ->type_name("FILE.h5|.npy|.txt|.raw");
  CLI::Option* frames =
      command
          .add_option(
              "--frames", arguments.frames,
              "Write what a camera sees as pictures (N, H, W) of float32 linear luminance,\n"
              "in which 1 is white, without blur and noise: as `emulate` and other event\n"
              "simulators read them. 300 MB a second of flight at 1000 Hz")
          ->check(file_ending(".npy"))
          ->type_name("FRAMES.npy");
  CLI::Option* timestamps =
      command
          .add_option("--timestamps", arguments.timestamps,
                      "Their instants (N) in int64 microseconds, multiples of 250")
          ->check(file_ending(".npy"))
          ->needs(frames)
          ->type_name("T.npy");
  frames->needs(timestamps);
  command.add_option("--frames-hz", arguments.frames_hz, "How many a second")
      ->check(number_between(1, 4000))
      ->needs(frames)
      ->capture_default_str();
  command
      .add_option("--camera", arguments.camera,
                  "Whose events and frames: top (the default) or bottom")
      ->check(CLI::IsMember(std::vector<std::string>(kCameraNames.begin(), kCameraNames.end())));
}

}  // namespace

void add_replay_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = program.add_subcommand("replay", "Fly one throw of a campaign again");
  command->add_option("directory", arguments->directory, "What `dodgesim run --out DIR` wrote")
      ->required()
      ->type_name("DIR");
  command->add_option("--throw", arguments->throw_index, "Number of the throw, from 0")
      ->required()
      ->check(whole_number_between(0, INT_MAX));
  CLI::Option* video = command
                           ->add_option("--video", arguments->video,
                                        "Write a video (H.264): the scene and both event streams")
                           ->check(file_ending(".mp4"))
                           ->type_name("FILE.mp4");
  command->add_option("--slow", arguments->slow, "How many times slower than real the video is")
      ->check(number_between(1, Film::kSlowest))
      ->needs(video)
      ->capture_default_str();
  command
      ->add_option("--mcap", arguments->mcap,
                   "Write a recording for Foxglove or Lichtblick: scene, both event cameras,\n"
                   "sensors, detections, commands, and what became of it")
      ->check(file_ending(".mcap"))
      ->type_name("FILE.mcap");
  command
      ->add_option("--stages", arguments->stages,
                   "Write the pilot's stages, a PNG for each of its cycles while an object flies")
      ->type_name("DIR2");
  command
      ->add_option("--picture", arguments->picture,
                   "Write one picture: both flight paths and what the pilot first noticed (if "
                   "nothing, the\nclosest approach)")
      ->check(file_ending(".png"))
      ->type_name("FILE.png");
  add_event_options(*command, *arguments);
  command
      ->add_option("--record", arguments->record,
                   "Write what the pilot gets (events and calibration of both cameras, IMU, state\n"
                   "estimates, range), its scenario and the truth, for `dodgesim detect` or a "
                   "detector of yours")
      ->type_name("DIR3");
  add_models_option(*command, arguments->models_dir);
  add_plugin_option(*command, arguments->plugin);
  command->footer(
      "Exit code 1 if the throw did not fly as recorded, bit for bit.\n\n"
      "Examples:\n"
      "  dodgesim replay out/demo --throw 3 --video throw3.mp4 --slow 5\n"
      "  dodgesim replay out/demo --throw 3 --mcap throw3.mcap       look around in Foxglove\n"
      "  dodgesim replay out/demo --throw 3 --events top.h5          every event and its cause\n"
      "  dodgesim replay out/demo --throw 3 --frames top.npy --timestamps t.npy");
  command->callback([arguments, &exit_code] { exit_code = replay(*arguments); });
}

}  // namespace dodgesim
