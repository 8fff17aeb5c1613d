// What the commands that fly campaigns (run, sweep, gate, paper) share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "sim/campaign/campaign.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// Adds --out, -j, --force, --resume and the limits of a worker. Without --out the results go to
// out/NAME of the current directory: `by_default` is that NAME in the help, set_default_out() sets
// it.
void add_campaign_options(CLI::App& command, const std::string& by_default,
                          CampaignOptions& options);
void set_default_out(const std::filesystem::path& name, CampaignOptions& options);

// --throws and --seed, which stand for keys of the scenario; as written, empty if not given.
struct RepeatOptions {
  std::string throws, seed;
};

void add_repeat_options(CLI::App& command, RepeatOptions& options, const std::string& throws_help,
                        const std::string& seed_help);
void append_settings(const RepeatOptions& options, std::vector<Setting>& settings);

// Campaigns that show their progress on a terminal and end when the user asks for it
// (stop_signal.h). Call try_models() before they are flown. fly_campaigns() is run_campaigns().
// The scenario must outlive what is planned.
PlannedCampaign plan_campaign(const Scenario& scenario, CampaignOptions options);
PlannedCampaign plan_campaign(Scenario&& scenario, CampaignOptions options) = delete;
void fly_campaigns(const std::vector<PlannedCampaign>& plans, const CampaignListener& listener);
CampaignSummary fly_campaign(const Scenario& scenario, const CampaignOptions& options);

// Says that the flights were stopped, after how much, and how they go on; returns the exit code.
int report_stop(const std::string& flown, const CampaignOptions& options);
int report_stop(const CampaignSummary& summary, const CampaignOptions& options);

// Says how many throws had a flight that failed, and why the first; returns the exit code.
int report_errors(const CampaignSummary& summary);

}  // namespace dodgesim
