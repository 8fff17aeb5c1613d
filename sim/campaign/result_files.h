// The files of a campaign that people and programs read, made from its journal.
#pragma once

#include <filesystem>

#include "sim/campaign/campaign.h"
#include "sim/campaign/journal.h"

namespace dodgesim {

// Writes throws.csv, objects.csv, detections.csv, timing.csv, table.md, table.csv, report.html and,
// with `truth`, truth.csv, and fills in what the summary says about the results. The same bytes for
// the same results, but for timing.csv and report.html, which say how long it took.
void write_result_files(const std::filesystem::path& out, const Scenario& scenario,
                        const JournalIndex& index, bool truth, CampaignSummary& summary);

}  // namespace dodgesim
