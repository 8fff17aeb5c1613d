// From the flown campaigns of the paper's experiments to a directory of tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/paper/experiment.h"

namespace dodgesim {

// In the paper's order; for no names, all but those that must be named. Throws ScenarioError for a
// name that is none.
std::vector<PaperExperiment> experiments_named(const std::vector<std::string>& names);

// Their campaigns, each once.
std::vector<PaperFlight> flights_of(const std::vector<PaperExperiment>& experiments);

// The directory of a campaign below that of the tables.
std::filesystem::path flight_directory(const std::filesystem::path& out, const PaperFlight& flight);

// Where models, and the scenarios of what is timed, are found.
struct PaperSources {
  std::string models_dir, scenarios_dir;
};

// Reads the campaigns, times what is to be timed, and writes NAME.md, with `command`, the line that
// made it, and NAME.csv for each experiment into `out`, and README.md, which lists them. Returns
// the tables for people. But for times, the same bytes for the same campaigns, program and command.
// Throws IoError; ScenarioError and std::invalid_argument for campaigns without a table.
std::string write_paper_tables(const std::filesystem::path& out,
                               const std::vector<PaperExperiment>& experiments,
                               const PaperSources& sources, const std::string& command);

}  // namespace dodgesim
