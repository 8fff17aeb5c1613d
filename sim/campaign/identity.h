// What must be the same for results to be put together.
#pragma once

#include <string>

namespace dodgesim {

struct CampaignIdentity {
  std::string scenario;  // as it was resolved, YAML
  std::string program;   // version and commit, and what was changed since
  std::string models;    // digest of room, vehicle and objects (sim/preflight/try_models.h)
  std::string plugin;    // digest of the library, when it flies
  bool truth = false;    // the results hold truth_rows

  bool operator==(const CampaignIdentity&) const = default;

  template <class Visitor>
  void visit(Visitor& v) {
    v("scenario", scenario);
    v("program", program);
    v("models", models);
    v("plugin", plugin);
    v("truth", truth);
  }
};

// How `a` differs from `b`, to follow "results": "of another scenario (seed is 3, not 4)".
std::string difference(const CampaignIdentity& a, const CampaignIdentity& b);

}  // namespace dodgesim
