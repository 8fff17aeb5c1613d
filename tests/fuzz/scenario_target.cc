#include "sim/config/scenario.h"

#include "sim/config/expand.h"
#include "sim/config/resolve_throw.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

bool scenario(Bytes bytes) {
  const std::string text(text_of(bytes));
  Scenario scenario;
  if (!accepts([&] { scenario = parse_scenario(text, "fuzz.yaml", ""); })) return false;
  const std::string resolved = to_yaml(scenario);
  Scenario again;
  require(accepts([&] { again = parse_scenario(resolved, "resolved.yaml", ""); }),
          "a resolved scenario is a scenario");
  require(to_yaml(again) == resolved, "resolving a resolved scenario changes nothing");
  for (const int t : {0, throw_count(scenario) - 1}) {
    const ThrowCase thrown = case_of(scenario, t);
    if (thrown.scenario.anyone_throws()) resolve_throws(thrown.scenario, thrown.stream);
  }
  return true;
}

}  // namespace dodgesim::fuzz
