// What the commands that fly campaigns (run, gate) share.
#pragma once

#include <CLI/CLI.hpp>

#include "sim/campaign/campaign.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// Adds --out, -j, --force, --resume and the limits of a worker.
void add_campaign_options(CLI::App& command, CampaignOptions& options);

// Flies the throws in workers, with progress on a terminal, until done or until the user asks for
// the end (SIGINT, SIGTERM).
CampaignSummary fly_campaign(const Scenario& scenario, CampaignOptions options);

// Says that the campaign was stopped and how it goes on; returns the exit code.
int report_stop(const CampaignSummary& summary);

}  // namespace dodgesim
