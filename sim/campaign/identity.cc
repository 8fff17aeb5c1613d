#include "sim/campaign/identity.h"

#include "sim/config/scenario_changes.h"

namespace dodgesim {

std::string difference(const CampaignIdentity& a, const CampaignIdentity& b) {
  if (a.scenario != b.scenario) {
    return "of another scenario (" + scenario_difference(a.scenario, b.scenario) + ")";
  }
  if (a.program != b.program) {
    return "of another version of dodgesim (" + a.program + ", not " + b.program + ")";
  }
  if (a.models != b.models) return "of other models (room, vehicle or objects have changed)";
  if (a.plugin != b.plugin) {
    if (b.plugin.empty()) return "of a plug-in (add --plugin FILE.so)";
    return a.plugin.empty() ? "without a plug-in" : "of another plug-in (the library has changed)";
  }
  return a.truth ? "with --truth, not without" : "without --truth, not with it";
}

}  // namespace dodgesim
