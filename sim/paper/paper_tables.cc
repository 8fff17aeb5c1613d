#include "sim/paper/paper_tables.h"

#include <algorithm>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/campaign/build_info.h"
#include "sim/campaign/load_campaign.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

std::string flown_markdown(const PaperExperiment& experiment,
                           const std::vector<LoadedCampaign>& campaigns) {
  if (campaigns.empty()) return "";
  std::string text = "\nFlown:\n\n";
  for (std::size_t i = 0; i < campaigns.size(); ++i) {
    const auto& results = campaigns[i].results;
    const auto failed =
        std::ranges::count_if(results, [](const ThrowResult& r) { return !r.flown.ok(); });
    text += "- " + std::to_string(results.size()) + " throws, seed " +
            std::to_string(campaigns[i].scenario.seed) + ": `dodgesim run " +
            experiment.flights[i].arguments() + "`";
    if (failed > 0) text += "; **" + std::to_string(failed) + " could not be flown**";
    text += "\n";
  }
  return text;
}

// Returns the lines that show them.
std::string write_plots(const fs::path& out, const std::string& experiment,
                        const std::vector<PaperPlot>& plots) {
  std::string text;
  for (const PaperPlot& plot : plots) {
    const std::string file = experiment + "_" + plot.name + ".png";
    write_file(out / file, png_of(plot.plot));
    text += "![" + plot.plot.title + "](" + file + ")\n";
  }
  return text.empty() ? text : text + "\n";
}

PaperTables tables_of(const fs::path& out, const PaperExperiment& experiment,
                      const PaperSources& sources, const std::vector<LoadedCampaign>& campaigns) {
  if (!experiment.measure) return experiment.analyse(campaigns);
  BenchOptions options;
  options.models_dir = sources.models_dir;
  options.scenarios_dir = sources.scenarios_dir;
  options.plots_dir = out;
  return experiment.measure(options);
}

// Of all tables that are there, also those of other commands.
std::string contents_of(const fs::path& out) {
  std::string text =
      "# Falanga et al. 2020, reproduced\n\nEach table says which command and program made "
      "it.\n\n| experiment | tables |\n|---|---|\n";
  for (const PaperExperiment& experiment : paper_experiments()) {
    const std::string& name = experiment.name;
    if (!fs::exists(out / (name + ".md"))) continue;
    text += "| " + experiment.title + " | [" + name + ".md](" + name + ".md), [" + name + ".csv](" +
            name + ".csv) |\n";
  }
  return text;
}

}  // namespace

std::vector<PaperExperiment> experiments_named(const std::vector<std::string>& names) {
  const std::vector<PaperExperiment>& all = paper_experiments();

  for (const std::string& name : names) {
    if (contains(all, name, &PaperExperiment::name)) continue;
    throw ScenarioError("There is no experiment \"" + name + "\"; there are " +
                        joined(all, &PaperExperiment::name) + ".");
  }
  std::vector<PaperExperiment> chosen;
  for (const PaperExperiment& experiment : all) {
    const bool wanted = names.empty() ? !experiment.only_named : contains(names, experiment.name);
    if (wanted) chosen.push_back(experiment);
  }
  return chosen;
}

std::vector<PaperFlight> flights_of(const std::vector<PaperExperiment>& experiments) {
  std::vector<PaperFlight> flights;
  for (const PaperExperiment& experiment : experiments) {
    for (const PaperFlight& flight : experiment.flights) {
      const bool known = contains(flights, flight.name, &PaperFlight::name);
      if (!known) flights.push_back(flight);
    }
  }
  return flights;
}

fs::path flight_directory(const fs::path& out, const PaperFlight& flight) {
  return out / "flights" / flight.name;
}

std::string write_paper_tables(const fs::path& out, const std::vector<PaperExperiment>& experiments,
                               const PaperSources& sources, const std::string& command) {
  make_directory(out);
  const std::string program = build_info().name();
  std::string shown;
  for (const PaperExperiment& experiment : experiments) {
    std::vector<LoadedCampaign> campaigns;
    for (const PaperFlight& flight : experiment.flights) {
      campaigns.push_back(
          load_campaign(flight_directory(out, flight), sources.models_dir, Rows::kKeep));
    }
    const PaperTables tables = tables_of(out, experiment, sources, campaigns);
    const std::string text = "# " + experiment.title + "\n\nMade by `" + command + "`, dodgesim " +
                             program + ".\n\n" + write_plots(out, experiment.name, tables.plots) +
                             tables.markdown + flown_markdown(experiment, campaigns);
    write_file(out / (experiment.name + ".md"), text);
    write_file(out / (experiment.name + ".csv"), tables.csv);
    shown += text + "\n";
  }
  write_file(out / "README.md", contents_of(out));
  return shown;
}

}  // namespace dodgesim
