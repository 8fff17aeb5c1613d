// From the flown campaigns of the paper's experiments to a directory of tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/paper/experiment.h"

namespace dodgesim {

// In the paper's order; all of them for no names. Throws ScenarioError for a name that is none.
std::vector<PaperExperiment> experiments_named(const std::vector<std::string>& names);

// Their campaigns, each once.
std::vector<PaperFlight> flights_of(const std::vector<PaperExperiment>& experiments);

// The directory of a campaign below that of the tables.
std::filesystem::path flight_directory(const std::filesystem::path& out, const PaperFlight& flight);

// Reads the campaigns and writes NAME.md and NAME.csv for each experiment into `out`, and README.md
// with `command`, the line that made them. Returns the tables for people. The same bytes for the
// same campaigns, program and command. Throws IoError.
std::string write_paper_tables(const std::filesystem::path& out,
                               const std::vector<PaperExperiment>& experiments,
                               const std::string& models_dir, const std::string& command);

}  // namespace dodgesim
