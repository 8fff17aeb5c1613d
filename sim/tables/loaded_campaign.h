// A campaign as its tables and its report need it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/config/expand.h"
#include "sim/outcome/result.h"
#include "sim/tables/early_stop.h"
#include "sim/tables/throw_statistics.h"

namespace dodgesim {

struct LoadedCampaign {
  Scenario scenario;
  std::string program;               // version and commit that flew it
  std::vector<ThrowResult> results;  // in throw order, without their rows unless kept
  std::optional<EarlyStop> stop;     // with the results; empty without the scenario's key stop
  bool damaged = false;              // records of its journal cannot be read

  // The number of its throws: fewer than the scenario's when stop has ended it.
  int wanted() const { return ended_early() ? *stop->end() : throw_count(scenario); }
  bool ended_early() const { return stop && stop->end(); }
  bool complete() const { return static_cast<int>(results.size()) == wanted(); }

  // A sentence if the readout of the event cameras lost a good part of their events, of which no
  // cause of a collision speaks; else empty.
  std::string losses() const;
};

// Leaves out throws that were flown while the campaign came to its early end.
LoadedCampaign campaign_of(Scenario scenario, std::string program,
                           std::vector<ThrowResult> results);

// What may be pooled of it (throw_statistics.h).
std::vector<Part> parts_of(const LoadedCampaign& campaign);

}  // namespace dodgesim
