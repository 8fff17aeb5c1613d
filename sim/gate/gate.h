// The regression gate: whether a campaign is as good as its baseline.
#pragma once

#include <string>
#include <vector>

#include "sim/gate/baseline.h"
#include "sim/gate/comparison.h"

namespace dodgesim {

struct GateCheck {
  enum class Result { kPassed, kFailed, kLeftOut };
  std::string name;
  Result result = Result::kPassed;
  std::string reason;
};

struct GateVerdict {
  Comparison comparison;
  std::vector<GateCheck> checks;

  bool passed() const;
};

// `flown` is a campaign of the baseline's throws on a machine of `machine_kind`; that a throw is
// another one, is missing or would have hit in only one of the two fails. The rate fell if it is
// shown, with the confidence of the rules, that it fell by more than their margin (judge_drop()).
// Throws IoError if a table is not that of a campaign.
GateVerdict judge(const Baseline& baseline, const CampaignTables& flown,
                  const std::string& machine_kind, const GateRules& rules);

// One test case a check, for continuous integration (the JUnit XML that Jenkins, GitLab and GitHub
// read). `text` says everything else.
std::string junit_xml(const GateVerdict& verdict, const std::string& name, const std::string& text);
// Whether that made the text.
bool is_junit(const std::string& text);

}  // namespace dodgesim
