// What the subcommands of dodgesim share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/config/scenario.h"
#include "sim/outcome/result.h"

namespace dodgesim {

struct LoadedCampaign;

// Exit codes of the program.
inline constexpr int kOk = 0;
inline constexpr int kBelowBar = 1;    // below the baseline, or not what was flown before
inline constexpr int kUsageError = 2;  // bad command line or scenario
inline constexpr int kIncomplete = 3;  // flights failed, or are missing
inline constexpr int kIoError = 4;     // a file could not be read or written

// Each adds its subcommand, which sets `exit_code` when it is run. Errors leave as exceptions.
void add_run_command(CLI::App& program, const std::string& command_line, int& exit_code);
void add_sweep_command(CLI::App& program, const std::string& command_line, int& exit_code);
void add_merge_command(CLI::App& program, const std::string& command_line, int& exit_code);
void add_compare_command(CLI::App& program, int& exit_code);
void add_gate_command(CLI::App& program, const std::string& command_line, int& exit_code);
void add_table_command(CLI::App& program, int& exit_code);
void add_report_command(CLI::App& program, int& exit_code);
void add_replay_command(CLI::App& program, int& exit_code);
void add_validate_command(CLI::App& program, int& exit_code);
void add_explain_command(CLI::App& program, int& exit_code);
void add_emulate_command(CLI::App& program, int& exit_code);
void add_detect_command(CLI::App& program, int& exit_code);
void add_bench_command(CLI::App& program, const std::string& command_line, int& exit_code);
void add_check_sensor_command(CLI::App& program, const std::string& command_line, int& exit_code);
void add_paper_command(CLI::App& program, const std::string& command_line, int& exit_code);

// Adds --models: where rooms, vehicles and objects are.
void add_models_option(CLI::App& command, std::string& models_dir);

// Adds --plugin: the library of the pilot plugin.
void add_plugin_option(CLI::App& command, std::string& file);

// The scenario with that library; an empty name: without one. Throws IoError.
Scenario with_plugin(Scenario scenario, const std::string& file);

// Adds --set: keys of the scenario given on the command line, as KEY=VALUE.
void add_set_option(CLI::App& command, std::vector<std::string>& set);

// Settings from KEY=VALUE, as they stand behind `option` each. Throws ScenarioError without a `=`
// or a value.
std::vector<Setting> parse_settings(const std::string& option,
                                    const std::vector<std::string>& texts);

// Throws ScenarioError if `file`, which is to be written for `option` ("--out DIR"), or its
// temporary name is one of the inputs; an empty name is none.
void refuse_to_overwrite(const std::vector<std::string>& inputs, const std::string& file,
                         const std::string& option);

// Three lines about precision and recall, without the last line's end.
std::string truth_text(const EventTruthSums& sums);

// The exit code of a command that reads a campaign; tells on standard error of throws that it
// lacks, or that its scenario's key stop has ended it.
int completeness(const std::string& directory, const LoadedCampaign& campaign);

// What the value of an option must be; the ranges of CLI11 let a NaN pass.
CLI::Validator number_between(double least, double most);
CLI::Validator whole_number_between(std::uint64_t least, std::uint64_t most);
CLI::Validator file_ending(const std::string& extension);

}  // namespace dodgesim
