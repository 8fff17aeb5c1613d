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
| `ci.yaml` | the throws of the project's own regression gate |
| `goal_flight.yaml` | balls at a vehicle on its way to a goal at 1.5 m/s |
| `size_by_distance.yaml` | a grid: balls of three sizes from four distances |
| `latency.yaml` | a sweep: how much latency a dodge survives, by the speed of the throw |
| `several_balls.yaml` | two balls at once and a third after them |
| `waypoints.yaml` | balls at a vehicle on its way along waypoints |
| `mono.yaml` | one camera and balls of known size |
| `range_cap_1_5m.yaml`, `range_cap_3m.yaml` | 200 balls that pilot and oracle believe alike |
| `quiet_hover.yaml`, `quiet_goal_flight.yaml` | nothing: dodges would be false alarms |
| `paper/drift_up.yaml`, `paper/drift_down.yaml` | a state estimate that drifts in height: lands or crashes |
| `paper/drift_none.yaml` | their control: nothing drifts, nothing lands |
| `paper/drift_thrown_at.yaml` | balls at a vehicle whose height estimate drifts |
| `paper/toward*.yaml`, `paper/passing.yaml`, `paper/indoor.yaml`, `paper/outdoor_*.yaml` | the first paper's experiments (`dodgesim paper`) |
| `paper/claims*.yaml` | the claims behind its method: latency, speed, range, physics, field, threshold, translation |
| `paper/training_*.yaml` | the throws on which `tools/search` looks for parameters |

```
dodgesim validate scenarios/demo.yaml                  # is it well-formed?
dodgesim run scenarios/demo.yaml --out out/demo -j 2   # fly it
dodgesim run scenarios/demo.yaml --out out/fast --set throw.speed_mps=8   # with another value
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
number of the throw and the key: changing one key leaves the draws of all others as they were, and
`dodgesim compare` pairs the throws of one seed, grid and sweep, whatever other keys differ.

## Grids

```yaml
repeats: 10
grid:
  size_m: [0.1, 0.2]                             # throw.size_m: keys of throw may stand alone
  speed_mps: [4, 6, !uniform [8, 10]]
```

Every combination of the values is a cell with `repeats` throws, each with draws of its own: here 6
cells and 60 throws. Any single key but `extends`, `name`, `description`, `seed`, `repeats`, `pilot`,
`throws`, `grid`, `sweep` and `stop` may stand there. Throw i = repeat x cells + cell, so more repeats
leave the throws that there are as they were.

## Sweeps

```yaml
sweep:
  delays.compute_us: [0, 3500, 30000]
```

flies the same throws with the same noise again with every value (with every combination, if there
are several keys). So two values can be compared throw by throw, and are never pooled: the tables
have a part for each. The throws of sweep value k are numbered from k x cells x repeats. `dodgesim
sweep FILE --over delays.compute_us=0,3500,30000` does the same to any scenario. A swept
`sensors.events.preset` takes the place of the whole camera, a swept `pilot` (dodgesim beside others)
that of `dodger`: a key of theirs that is to hold for all stands in the sweep, too, as a list of one. `throws.csv` has the columns `cell` and
`sweep` and one for every key of both.

## Bases and settings

`extends: other.yaml` takes the keys of another scenario where this one has none. Maps merge, any
other value takes the place of the base's, and `~` takes a key away (`throw: ~`). Its `name` and
`description` do not count. The base is named relative to the file, ends in `.yaml` or `.yml`, and
lies in the folder of the scenario, below it or at most two folders up; bases may have bases, up to
8. `--set KEY=VALUE` of `run`, `sweep`, `gate`, `paper` and `validate` comes after the files (and before
`--throws` and `--seed`), its value is YAML, and it may be repeated: `--set
'throw.speed_mps=!uniform [4, 6]'`, `--set grid.size_m=[0.1,0.2]`, `--set 'throw=~'`.

## Several objects

```yaml
throws:                                          # instead of throw
  - {bearing_deg: 15, launch_s: 0.5}
  - {bearing_deg: -15, launch_s: 0.5}            # at the same time
  - {object: box, launch_s: 1.5, count: 3, interval_s: 0.4}
```

Each object is thrown at the place where the vehicle would be when it arrives if it did not dodge. A
flight ends when one hits. `objects.csv` has a row for each; in `throws.csv` the drawn numbers are
those of the first, and hit, closest approach and detection those of all. A grid over a key of throw
sets it for all of them.

## What a campaign writes

| file | what it holds |
|---|---|
| `table.md`, `table.csv`, `report.html` | rates, and the report |
| `throws.csv` | a row for each throw |
| `objects.csv` | a row for each object of each throw |
| `detections.csv` | a row for each detection of the scenario's pilot, false ones too |
| `truth.csv` | with `--truth`: events and found events by cycle of the pilot |
| `timing.csv` | simulated and computing time of each throw; differs from run to run |
| `manifest.json`, `scenario.resolved.yaml` | commit, versions, machine; every value of the scenario |
| `results.bin` | all results, from which the tables are made |

Times that end in `_us` are simulated microseconds since the start of the flight, flags are 0 or 1,
and a cell is empty where there is nothing to tell. `throw` is the same number in all files, and the
one that `dodgesim replay --throw` takes.

`throws.csv`:

| column | meaning |
|---|---|
| `throw`, `cell`, `sweep` | its number, cell of the grid and number of the sweep value; a column for every key of both follows |
| `objects`, `object` | how many are thrown; the model of the first (empty: nobody threw) |
| `size_m`, `speed_mps`, `distance_m`, `bearing_deg`, `aim_offset_m_0`, `_1`, `spin_radps_0` to `_2`, `launch_height_m`, `launch_us` | as drawn, of the first object |
| `flown_status` | of the scenario's pilot: `ok`, `error`, `lost` (with its worker) or `not flown` |
| `flown_error` | why, after `error` or `lost` |
| `flown_hit`, `flown_crashed` | an object touched the vehicle; the vehicle touched the room |
| `flown_hit_us`, `flown_closest_us` | the first contact with an object; the closest approach (after a hit the same) |
| `flown_clearance_m` | least distance between the surfaces of vehicle and objects until the flight ended, 0 after a hit |
| `none_status` to `none_clearance_m`, `oracle_*` | the same seven of these pilots |
| `none_after_room` | an object had touched the room when it came nearest to the vehicle that `none` flew |
| `first_in_view_us` | the object that was detected first (any, if none was) had its centre in a camera's image and was a pixel wide |
| `first_detection_us`, `first_detection_t_us` | the first detection within 0.5 m of the centre of an object (of one larger than 30 cm: 0.35 m more than its radius), given out before the flight ended: when the pilot gave it out, and the instant it speaks of |
| `first_detection_distance_m` | true distance from the top camera to the object at that instant |
| `time_to_contact_us` | from `first_detection_us` to the contact of `none` (without one, to its closest approach); empty if that is with another object |
| `first_command_us`, `evaded` | the flight controller's first command to evade; whether there was one |
| `false_alarm` | evaded before `first_detection_us`, or without any; never of `oracle` |
| `landing_us`, `landed_us` | the first command to land in an emergency; a gentle touch-down |
| `cause` | of a hit or crash: `sim/outcome/collision_cause.h` |
| `escape_left_s`, `escape_needed_s` | from the command to evade to the contact that it should avoid; the least time in which a manoeuvre would have avoided it (empty: none within 1 s) |
| `detections` | number of rows in `detections.csv` |
| `events_0`, `_1`, `events_lost_0`, `_1` | of the top and the bottom camera; lost in a saturated readout |
| `events_hash` | of all events in order |
| `duration_us` | length of the flight of the scenario's pilot |

`objects.csv`:

| column | meaning |
|---|---|
| `throw`, `object` | its throw, and its number in it from 0 |
| `kind`, `size_m`, `speed_mps`, `distance_m`, `bearing_deg`, `aim_offset_m_0`, `_1`, `spin_radps_0` to `_2`, `launch_height_m`, `launch_us` | its model and numbers, as drawn |
| `hit`, `hit_us`, `closest_us`, `clearance_m` | as in `throws.csv`, of this object with the scenario's pilot |
| `first_detection_us`, `first_detection_distance_m` | likewise |
| `none_hit` | it touched the vehicle that `none` flew |
| `none_after_room` | it had touched the room when it came nearest to that vehicle |

`detections.csv`:

| column | meaning |
|---|---|
| `throw` | its throw |
| `t_us`, `output_us` | the instant it speaks of; when the pilot gave it out |
| `obstacle_id` | the pilot's track that took it, -1: none |
| `p_W_0` to `_2`, `size_m` | estimated centre in the world and size |
| `depth_m`, `depth_sigma_m` | along the optical axis, and its standard deviation as the pilot believes |
| `object` | the object nearest to the estimate at `t_us`, of those launched by then (empty: none) |
| `true_p_W_0` to `_2`, `true_depth_m` | its centre, and that along the top camera's axis |
| `position_error_m` | from the estimate to that centre |

What is easily misread:

- A flight whose status is not `ok` has 0 for hit and crashed, which says nothing. `none` and `oracle`
  are `not flown` when nobody threw or the throw was impossible, `oracle` also with `fly_oracle: false`.
- A throw counts for no pilot if `flown_status` is `error`, and neither `none_status` nor
  `oracle_status` is `ok`: nobody could fly it. If only some flights failed, it stays in the
  denominator, and is not dodged.
- A throw is dodged if `none_status` and `flown_status` are `ok`, `none_hit` is 1, `flown_hit` and
  `flown_crashed` are 0, and `landing_us` is empty or not before `none_hit_us`.
- A flight ends at the first hit, crash or touch-down. Of several objects only the first to touch has
  `hit` or `none_hit`, and the others' closest approach is that until then.
- `object` in `detections.csv` is the nearest one even if the detection is false, which it is from a
  `position_error_m` of 0.5 on, for objects larger than 30 cm of 0.35 more than their radius.
- `first_detection_us` and what follows from it are what the pilot says it has detected. `none` and
  `oracle` have no cameras: no detections, and no events.

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
