// What a gate compares with: a directory of a few small files, kept under version control.
//
//   throws.csv, objects.csv  of the campaign
//   scenario.resolved.yaml   that it flew
//   table.md                 for people
//   manifest.json            commit, versions and machine of the campaign, and the gate's rules
#pragma once

#include <filesystem>
#include <string>

#include "sim/gate/outcomes.h"

namespace dodgesim {

struct GateRules {
  double margin = 0.05;      // the success rate may fall by so much
  double confidence = 0.95;  // the gate fails when it is so sure that the rate fell by more
  // What must not change by a single byte, on machines of one kind: "nothing", "physics" (what is
  // thrown, and what becomes of it when nobody dodges) or "all".
  std::string must_equal = "physics";
};

struct Baseline {
  CampaignTables tables;
  std::string scenario;  // YAML
  GateRules rules;
  std::string commit;
  std::string machine_kind;  // byte-equality is promised between machines with the same only
};

// Throws IoError, with the file, if one is missing or broken.
Baseline read_baseline(const std::filesystem::path& directory);

// Whether one of a baseline's files is there, however broken.
bool holds_baseline_files(const std::filesystem::path& directory);

// Whether the manifest there, however broken, has the gate's rules, as that of no campaign has: the
// files are a baseline's.
bool is_marked_as_baseline(const std::filesystem::path& directory);

// The rules of a baseline that may be missing or broken: the default's if they cannot be read.
GateRules rules_or_default(const std::filesystem::path& directory);

// Makes the campaign in `campaign` the baseline, in place of an earlier one; other files in the
// directory stay. Throws IoError.
void write_baseline(const std::filesystem::path& directory, const std::filesystem::path& campaign,
                    const GateRules& rules);

// Baseline::machine_kind of a campaign's or baseline's directory. Throws IoError.
std::string machine_kind(const std::filesystem::path& directory);

}  // namespace dodgesim
