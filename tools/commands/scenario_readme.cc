#include "tools/commands/scenario_readme.h"

#include "sim/config/scenario.h"

namespace dodgesim {

namespace {

constexpr const char* kIntroduction = R"(# Scenarios

A scenario is a YAML file that says who throws what at whom, and how well the vehicle sees, thinks
and flies. Each file here runs as it is:

| file | what it flies |
|---|---|
| `demo.yaml` | 40 balls of 10, 20 and 30 cm at a hovering vehicle |
| `ci.yaml` | a few throws, for a quick check of the whole loop |
| `goal_flight.yaml` | balls at a vehicle on its way to a goal at 1.5 m/s |
| `mono.yaml` | one camera and balls of known size |
| `range_cap_1_5m.yaml`, `range_cap_3m.yaml` | 200 balls that pilot and oracle believe alike |
| `quiet_hover.yaml`, `quiet_goal_flight.yaml` | nothing: dodges would be false alarms |

```
dodgesim validate scenarios/demo.yaml                  # is it well-formed?
dodgesim run scenarios/demo.yaml --out out/demo -j 2   # fly it
dodgesim explain throw.speed_mps                       # what does a key mean?
```

Every key may be left out; then its default holds. `DIR/scenario.resolved.yaml` of a campaign has
every value spelled out and is itself a scenario. A key that is unknown, misspelled, given twice, of
the wrong type or out of its range is an error with file, line and column; YAML anchors, aliases and
merge keys are not supported.

## Distributions

A number under `throw` may be a distribution, from which every throw draws a value of its own:

| written as | meaning |
|---|---|
| `0.2` | always this value |
| `!uniform [0.1, 0.3]` | any value between the two |
| `!normal {mean: 6, sd: 1}` | normal, cut at the limits of the key, or at `min` and `max` |
| `!choice [0.1, 0.2, 0.3]` | one of these, each as likely |

`aim_offset_m` and `spin_radps` take a list, one number or distribution for each component, or a
single one. `object` takes a name or a `!choice` of names. A throw's draws depend only on `seed`, the
number of the throw and the key: changing one key leaves the draws of all others as they were.

## Keys

This part is made from the program's own list of parameters (`dodgesim explain --markdown`).

)";

}  // namespace

std::string scenario_readme() {
  std::string text = kIntroduction + to_markdown(scenario_docs());
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace dodgesim
