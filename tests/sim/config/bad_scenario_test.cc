// Every mistake gives one sentence with file, line, column, key, value and what is allowed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/config/bad_scenario.h"

namespace dodgesim {
namespace {

class BadScenarioTest : public ::testing::TestWithParam<BadScenario> {};

TEST_P(BadScenarioTest, IsRefusedWithPlaceKeyAndReason) {
  EXPECT_THAT(error_of(GetParam().yaml), ::testing::StartsWith(GetParam().message));
}

// "0.51, 0.52, ..."
std::string numbers(int count) {
  std::string all;
  for (int i = 1; i <= count; ++i) all += (i > 1 ? ", 0.5" : "0.5") + std::to_string(1000 + i);
  return all;
}

const BadScenario kBadScenarios[] = {
    // Ranges.
    {"NegativeSize", "seed: 1\nthrow:\n  size_m: -1\n",
     "bad.yaml:3:11: throw.size_m is -1, but must be between 0.01 and 1."},
    {"TooManyThrows", "repeats: 1000001\n",
     "bad.yaml:1:10: repeats is 1000001, but must be between 1 and 1000000."},
    {"NameOfTwoLines", "seed: 1\nname: \"a\\nb\"\n",
     "bad.yaml:2:7: name has a line break, a tab or another control character."},
    {"DescriptionWithABell", "description: \"a\\ab\"\n",
     "bad.yaml:1:14: description has a control character other than line break and tab."},
    {"NameWithATerminalsEscape", "name: \"a\\x9b31m\"\n",
     "bad.yaml:1:7: name has a line break, a tab or another control character."},
    {"DescriptionWithATerminalsEscape", "description: \"a\\x9b31m\"\n",
     "bad.yaml:1:14: description has a control character other than line break and tab."},
    // yaml-cpp makes a byte of Latin-1 of it.
    {"DescriptionThatBecomesLatin1", "description: \"a\\Nb\"\n",
     "bad.yaml:1:14: description is not UTF-8 text."},
    {"NegativeSeed", "seed: -1\n",
     "bad.yaml:1:7: seed is -1, but must be between 0 and 18446744073709551615."},
    {"SeedBeyond64Bits", "seed: 18446744073709551616\n",
     "bad.yaml:1:7: seed is 18446744073709551616"},
    {"NumberBeyondDouble", "after_s: 1e999\n",
     "bad.yaml:1:10: after_s is 1e999, but must be between 0.1 and 60."},
    {"NestedThreeDeep", "dodger:\n  position:\n    stereo:\n      max_cost: -2\n",
     "bad.yaml:4:17: dodger.position.stereo.max_cost is -2, but must be between 0 and 1000."},
    {"VectorComponent", "mission:\n  start_m: [0, 1000, 2]\n",
     "bad.yaml:2:16: mission.start_m[1] is 1000, but must be between -100 and 100."},
    {"RangeSensorThatNeverReads", "sensors:\n  range: {min_range_m: 50, max_range_m: 10}\n",
     "bad.yaml:2:24: sensors.range.min_range_m is 50, but must be less than "
     "sensors.range.max_range_m, which is 10."},
    // Numbers that are none.
    {"Nan", "after_s: .nan\n",
     "bad.yaml:1:10: after_s is .nan, but must be a number between 0.1 and 60 (it must be "
     "finite)."},
    {"MinusInfinity", "throw: {speed_mps: -.inf}\n",
     "bad.yaml:1:20: throw.speed_mps is -.inf, but"},
    {"Octal", "seed: 010\n",
     "bad.yaml:1:7: seed is 010, but must be a whole number between 0 and 18446744073709551615 "
     "without leading zeros"},
    {"OctalFraction", "after_s: 01.5\n", "bad.yaml:1:10: after_s is 01.5, but"},
    {"Hexadecimal", "seed: 0x10\n", "bad.yaml:1:7: seed is \"0x10\", but must be a whole number"},
    {"Fraction", "repeats: 1.5\n", "bad.yaml:1:10: repeats is 1.5, but must be a whole number"},
    {"NumberInQuotes", "repeats: \"5\"\n", "bad.yaml:1:10: repeats is \"5\", but must be a whole"},
    {"NumberWithUnit", "throw:\n  size_m: 20 cm\n",
     "bad.yaml:2:11: throw.size_m is \"20 cm\", but must be a number"},
    {"WordForNumber", "after_s: long\n",
     "bad.yaml:1:10: after_s is \"long\", but must be a number"},
    // Wrong types.
    {"ListForNumber", "after_s: [1, 2]\n",
     "bad.yaml:1:10: after_s is a list of 2, but must be a number"},
    {"MapForNumber", "after_s: {a: 1}\n", "bad.yaml:1:10: after_s is a map, but must be a number"},
    {"NoValue", "after_s:\n", "bad.yaml:1:1: after_s is empty, but must be a number"},
    {"NumberForMap", "throw: 3\n", "bad.yaml:1:8: throw is 3, but must be a map of keys."},
    {"EmptyMap", "throw:\nseed: 1\n", "bad.yaml:1:1: throw is empty, but must be a map of keys."},
    {"YesForBool", "fly_oracle: yes\n",
     "bad.yaml:1:13: fly_oracle is \"yes\", but must be true or false."},
    {"ShortVector", "mission: {start_m: [0, 1]}\n",
     "bad.yaml:1:20: mission.start_m is a list of 2, but must be [x, y, z]"},
    {"ListForName", "name: [a]\n", "bad.yaml:1:7: name is a list of 1, but must be text."},
    {"UnknownPilot", "pilot: falanga\n",
     "bad.yaml:1:8: pilot is \"falanga\", but must be falanga2020, dodgesim, oracle, none or "
     "plugin."},
    {"MisspelledPilot", "pilot: orcale\n",
     "bad.yaml:1:8: pilot is \"orcale\", but must be falanga2020, dodgesim, oracle, none or plugin "
     "(did "
     "you mean "
     "oracle?)."},
    {"TagOnNumber", "after_s: !int 1\n", "bad.yaml:1:10: after_s is !int"},
    {"TagOfYamlOnNumber", "seed: !!int 5\n",
     "bad.yaml:1:7: seed is !!int 5, but must be a whole number between"},
    // Characters that look like others.
    {"NoBreakSpaceBeforeKey", "throw:\n  \xc2\xa0size_m: 0.2\n",
     "bad.yaml:2:3: throw.\xc2\xa0size_m is not a known key (it has the character U+00A0); did "
     "you mean throw.size_m?"},
    {"CyrillicLetterInKey", "s\xd0\xb5\x65\x64: 1\n",
     "bad.yaml:1:1: s\xd0\xb5\x65\x64 is not a known key (it has the character U+0435); did you "
     "mean seed?"},
    {"NoBreakSpaceBehindColon", "throw:\n  size_m:\xc2\xa0\x30.2\n",
     "bad.yaml:2:3: throw is \"size_m:\xc2\xa0\x30.2\" (with the character U+00A0), but must be"},
    {"NoBreakSpaceBehindNumber", "seed: 1\xc2\xa0\n",
     "bad.yaml:1:7: seed is \"1\xc2\xa0\" (with the character U+00A0), but must be"},
    {"NoBreakSpaceForAllSpaces", "seed:\xc2\xa0\x31\n",
     "bad.yaml:1:1: The file must be a map of keys, one a line, such as \"seed: 1\"; this has the "
     "character U+00A0."},
    // Keys.
    {"Misspelled", "throw:\n  sise_m: 0.1\n",
     "bad.yaml:2:3: throw.sise_m is not a known key; did you mean throw.size_m?"},
    {"UnitForgotten", "throw:\n  distance: 3\n",
     "bad.yaml:2:3: throw.distance is not a known key; did you mean throw.distance_m?"},
    {"WordOfAName", "throw:\n  height: 2\n",
     "bad.yaml:2:3: throw.height is not a known key; did you mean throw.launch_height_m?"},
    {"FurtherDown", "dodger: {max_range: 3}\n",
     "bad.yaml:1:10: dodger.max_range is not a known key; did you mean "
     "dodger.position.max_range_m?"},
    {"WrongPlace", "compute_us: 3\n",
     "bad.yaml:1:1: compute_us is not a known key; delays.compute_us is."},
    {"WrongPlaceOfTwo", "throw: {}\nspeed_mps: 5\n",
     "bad.yaml:2:1: speed_mps is not a known key; mission.speed_mps and throw.speed_mps are."},
    {"Dotted", "seed: 1\nthrow.size_m: 0.2\n",
     "bad.yaml:2:1: throw.size_m is not a known key; write throw: {size_m: 0.2} or use --set "
     "throw.size_m=VALUE."},
    {"DottedFurtherDown", "dodger: {position.stereo.max_cost: 2}\n",
     "bad.yaml:1:10: dodger.position.stereo.max_cost is not a known key; write position: {stereo: "
     "{max_cost: 2}} or use --set dodger.position.stereo.max_cost=VALUE."},
    {"DottedAndMisspelled", "throw.sise_m: 0.2\n",
     "bad.yaml:1:1: throw.sise_m is not a known key; did you mean throw.size_m?"},
    {"Unknown", "throw:\n  colour_of_the_sky: 3\n",
     "bad.yaml:2:3: throw.colour_of_the_sky is not a known key."},
    {"Duplicate", "seed: 1\nrepeats: 2\nseed: 3\n",
     "bad.yaml:3:1: seed is given twice; it is already in line 1."},
    {"NestedDuplicate", "throw:\n  size_m: 0.1\n  size_m: 0.2\n",
     "bad.yaml:3:3: throw.size_m is given twice; it is already in line 2."},
    {"ListAsKey", "[a, b]: 1\n", "bad.yaml:1:1: A key must be a plain word"},
    // YAML features that make a file mean something else than it says.
    {"MergeKey", "throw:\n  <<: {size_m: 0.1}\n",
     "bad.yaml:2:3: Merge keys (<<) are not supported"},
    {"Anchor", "throw: &t {size_m: 0.1}\n", "bad.yaml:1:8: Anchors (&name) are not supported"},
    {"TwoDocuments", "seed: 1\n---\nseed: 2\n", "bad.yaml:3:1: This is more than one YAML"},
    // Not a scenario at all.
    {"Empty", "", "bad.yaml: The file is empty."},
    {"OnlyComments", "# nothing\n", "bad.yaml: The file is empty."},
    {"List", "- 1\n- 2\n", "bad.yaml:1:1: The file must be a map of keys"},
    {"Text", "hello\n", "bad.yaml:1:1: The file must be a map of keys"},
    {"Syntax", "throw: {size_m: 0.1\nseed: 1\n", "bad.yaml:2:"},
    {"Tab", "throw:\n\tsize_m: 0.1\n",
     "bad.yaml:2:8: This is not valid YAML (illegal map value). Line 2 is indented with a tab; "
     "YAML takes spaces only."},
    {"TabFarAway", "seed: 1 # c\n\n \trepeats: 2\n",
     "bad.yaml:3:3: This is not valid YAML (end of map not found). Line 3 is indented with a tab"},
    {"NotUtf8", "name: \"\xff\"\n", "bad.yaml:1:8: This is not UTF-8 text (byte 255)."},
    {"Overlong", "name: \"\xc0\xaf\"\n", "bad.yaml:1:8: This is not UTF-8 text"},
    {"Zero", std::string("name: a\0b\n", 10),
     "bad.yaml:1:8: This is a control character (byte 0)."},
    {"Utf16", std::string("\xff\xfes\0e\0e\0d\0", 10), "bad.yaml:1:1: This is not UTF-8 text"},
    // Bounded time and memory.
    {"DeepFlow", "throw: " + repeat("[", 100000), "bad.yaml:1:"},
    {"DeepBlock", repeat("a: \n ", 1) + "b: " + repeat("{a: ", 1000) + repeat("}", 1000),
     "bad.yaml:"},
    {"DeepSequence", repeat("- ", 50000) + "1\n", "bad.yaml:1:"},
    {"Huge", "name: " + std::string(300000, 'x') + "\n", "bad.yaml: The file has 300007 bytes"},
    {"ManyValues", "throw: {size_m: !choice [" + repeat("0.1, ", 6000) + "0.1]}\n", "bad.yaml:1:"},
    // Distributions.
    {"UniformOutOfRange", "throw: {size_m: !uniform [0.1, 3]}\n",
     "bad.yaml:1:32: throw.size_m[1] is 3, but must be between 0.01 and 1."},
    {"UniformBackwards", "throw: {size_m: !uniform [0.3, 0.1]}\n",
     "bad.yaml:1:27: throw.size_m[0] is 0.3, but the lowest value must come first"},
    {"UniformOfOne", "throw: {size_m: !uniform [0.3]}\n",
     "bad.yaml:1:17: throw.size_m is !uniform with a list of 1, but must be !uniform [lowest, "
     "highest]"},
    {"UniformOfText", "throw: {size_m: !uniform [a, b]}\n",
     "bad.yaml:1:27: throw.size_m[0] is \"a\", but must be a number"},
    {"ChoiceOfNothing", "throw: {size_m: !choice []}\n",
     "bad.yaml:1:17: throw.size_m is !choice with an empty list"},
    {"ChoiceOutOfRange", "throw: {size_m: !choice [0.1, 0]}\n",
     "bad.yaml:1:31: throw.size_m[1] is 0, but must be between 0.01 and 1."},
    {"NormalWithoutSd", "throw: {size_m: !normal {mean: 0.2}}\n",
     "bad.yaml:1:17: throw.size_m is !normal {mean: 0.2}, but must be !normal {mean: a, sd: b}"},
    {"NormalWithZeroSd", "throw: {size_m: !normal {mean: 0.2, sd: 0}}\n",
     "bad.yaml:1:41: throw.size_m.sd is 0, but must be between"},
    {"NormalMeanOutside", "throw: {size_m: !normal {mean: 0.2, sd: 0.1, min: 0.3, max: 0.4}}\n",
     "bad.yaml:1:17: throw.size_m is !normal {mean: 0.2, sd: 0.1, min: 0.3, max: 0.4}, but must "
     "have min < max and its mean between"},
    {"NormalUnknownKey", "throw: {size_m: !normal {mean: 0.2, sd: 0.1, sigma: 1}}\n",
     "bad.yaml:1:46: throw.size_m.sigma is not a known key"},
    {"UnknownDistribution", "throw: {size_m: !gauss [0, 1]}\n",
     "bad.yaml:1:17: throw.size_m is !gauss with a list of 2, but must be a number between"},
    {"ListWithoutTag", "throw: {size_m: [0.1, 0.2]}\n",
     "bad.yaml:1:17: throw.size_m is a list of 2, but must be a number between 0.01 and 1, "
     "!uniform"},
    {"WrongComponentCount", "throw: {aim_offset_m: [0, 0, 0]}\n",
     "bad.yaml:1:23: throw.aim_offset_m is a list of 3, but must be one number or distribution, or "
     "a list of 2."},
    {"BadComponent", "throw: {aim_offset_m: [0, !uniform [0, 9]]}\n",
     "bad.yaml:1:40: throw.aim_offset_m[1][1] is 9, but must be between -2 and 2."},
    {"DistributionOutsideThrow", "after_s: !uniform [1, 2]\n",
     "bad.yaml:1:10: after_s is !uniform"},
    // Models.
    {"MissingModel", "throw: {object: anvil}\n",
     "bad.yaml:1:17: throw.object is \"anvil\", but there is no model file "},
    {"MissingRoom", "room: attic\n",
     "bad.yaml:1:7: room is \"attic\", but there is no model file "},
    {"DrawnModelOfAWrongTag", "throw: {object: !uniform [ball, box]}\n",
     "bad.yaml:1:17: throw.object is !uniform with a list of 2, but must be the name of a file in "
     "models/objects without .xml, or !choice [a, b, ...] of such names."},
    {"MissingChoice", "throw: {object: !choice [ball, anvil]}\n",
     "bad.yaml:1:32: throw.object[1] is \"anvil\", but there is no model file "},
    {"PathAsModel", "room: ../../etc/passwd\n",
     "bad.yaml:1:7: room is \"../../etc/passwd\", but must be the name of a file in models/rooms"},
    // Keys that need each other.
    {"GoalMissing", "mission: {type: goal}\n",
     "bad.yaml:1:17: mission.goal_m is missing, but mission.type goal needs it."},
    {"GoalWithoutUse", "mission: {goal_m: [1, 2, 3]}\n",
     "bad.yaml:1:19: mission.goal_m is given, but mission.type hover does not fly there."},
    {"WaypointsMissing", "mission: {type: waypoints}\n",
     "bad.yaml:1:17: mission.waypoints_m is missing, but mission.type waypoints needs it."},
    {"WaypointsWithoutUse", "mission: {waypoints_m: [[1, 2, 3]]}\n",
     "bad.yaml:1:24: mission.waypoints_m is given, but mission.type hover does not fly there."},
    {"WaypointOfTwo", "mission: {type: waypoints, waypoints_m: [[0, 0, 1], [1, 2]]}\n",
     "bad.yaml:1:53: mission.waypoints_m[1] is a list of 2, but must be [x, y, z]"},
    {"NoWaypoints", "mission: {type: waypoints, waypoints_m: []}\n",
     "bad.yaml:1:41: mission.waypoints_m is an empty list, but must be a list of [x, y, z], 1 to "
     "100"},
    // Several objects.
    {"ThrowAndThrows", "throw: {}\nthrows: [{}]\n",
     "bad.yaml:1:8: throw is given, and throws too; one of them is enough: 'throw: ~' or "
     "'throws: ~' takes away that of a scenario that this one extends."},
    {"ThrowsIsNoList", "throws: {size_m: 0.1}\n",
     "bad.yaml:1:9: throws is a map, but must be a list of maps, 1 to 16 of them."},
    {"EmptyThrows", "throws: []\n", "bad.yaml:1:9: throws is an empty list, but must be a list of"},
    {"ManyThrows", "throws: [" + repeat("{}, ", 16) + "{}]\n",
     "bad.yaml:1:9: throws is a list of 17, but must be a list of maps, 1 to 16 of them."},
    {"ThrowsOfNumbers", "throws: [{}, 3]\n",
     "bad.yaml:1:14: throws[1] is 3, but must be a map of keys."},
    {"KeyOfOneOfTheThrows", "throws: [{}, {sise_m: 3}]\n",
     "bad.yaml:1:15: throws[1].sise_m is not a known key; did you mean throws[1].size_m?"},
    {"ValueOfOneOfTheThrows", "throws: [{}, {size_m: 3}]\n",
     "bad.yaml:1:23: throws[1].size_m is 3, but must be between 0.01 and 1."},
    {"TooManyObjects", "throws: [{count: 9}, {count: 8}]\n",
     "bad.yaml:1:9: throws has 17 objects; at most 16 can fly."},
    // Grid and sweep.
    {"GridIsNoMap", "grid: [1]\n", "bad.yaml:1:7: grid is a list of 1, but must be a map of keys."},
    {"GridOfUnknownKey", "throw: {}\ngrid: {sise_m: [0.1]}\n",
     "bad.yaml:2:8: grid.sise_m is not a key that can take several values; did you mean "
     "throw.size_m?"},
    {"SweepOfMisplacedKey", "sweep: {compute_us: [1]}\n",
     "bad.yaml:1:9: sweep.compute_us is not a key that can take several values; did you mean "
     "delays.compute_us?"},
    {"GridOfAGroup", "throw: {}\ngrid: {throw: [{size_m: 1}]}\n",
     "bad.yaml:2:8: grid.throw is not a key that can take several values"},
    {"SweepOfTheSeed", "sweep: {seed: [1, 2]}\n",
     "bad.yaml:1:9: sweep.seed is not a key that can take several values"},
    {"SweepOfASweep", "sweep: {sweep: [1, 2]}\n", "bad.yaml:1:9: sweep.sweep is not a key"},
    {"GridOfANumber", "throw: {}\ngrid: {size_m: 0.1}\n",
     "bad.yaml:2:16: grid.size_m is 0.1, but must be a list of values, such as [0.1, 0.2]."},
    {"GridOfAChoice", "throw: {}\ngrid: {size_m: !choice [0.1, 0.2]}\n",
     "bad.yaml:2:16: grid.size_m is !choice with a list of 2, but must be a list of values"},
    {"GridOfNothing", "throw: {}\ngrid: {size_m: []}\n",
     "bad.yaml:2:16: grid.size_m is an empty list, but must be a list of values"},
    {"GridValueOutOfRange", "throw: {}\ngrid:\n  size_m: [0.1, 3]\n",
     "bad.yaml:3:17: throw.size_m is 3, but must be between 0.01 and 1."},
    {"SweepValueOfWrongType", "sweep:\n  delays.compute_us: [0, 3.5]\n",
     "bad.yaml:2:26: delays.compute_us is 3.5, but must be a whole number"},
    {"SweepValueNan", "sweep: {after_s: [.nan]}\n", "bad.yaml:1:19: after_s is .nan, but must be"},
    {"GridDistributionOutOfRange", "throw: {}\ngrid: {size_m: [!uniform [0.1, 7]]}\n",
     "bad.yaml:2:32: throw.size_m[1] is 7, but must be between 0.01 and 1."},
    {"GridModelMissing", "throw: {}\ngrid: {object: [ball, anvil]}\n",
     "bad.yaml:2:23: throw.object is \"anvil\", but there is no model file "},
    {"SweepRoomOutside", "sweep: {room: [../../etc/passwd]}\n",
     "bad.yaml:1:16: room is \"../../etc/passwd\", but must be the name of a file"},
    {"GridTwiceTheSame", "throw: {}\ngrid: {size_m: [0.1, 0.2, 0.1]}\n",
     "bad.yaml:2:27: grid.size_m[2] is 0.1, but this value is in the list already."},
    {"GridTwiceTheSameNumber", "throw: {}\ngrid: {size_m: [0.2, 2e-1]}\n",
     "bad.yaml:2:22: grid.size_m[1] is 2e-1, but this value is in the list already."},
    {"GridTwiceTheSameRange",
     "throw: {}\ngrid: {size_m: [!uniform [0.1, 0.2], !uniform [0.1, 0.20]]}\n",
     "bad.yaml:2:38: grid.size_m[1] is !uniform with a list of 2, but this value is in the list "
     "already."},
    {"GridByBothNames", "throw: {}\ngrid: {size_m: [0.1], throw.size_m: [0.2]}\n",
     "bad.yaml:2:23: grid.throw.size_m is given twice; it is already in bad.yaml:2:8."},
    {"GridAndSweep", "throw: {}\ngrid: {size_m: [0.1]}\nsweep: {size_m: [0.2]}\n",
     "bad.yaml:2:8: throw.size_m is in grid and in sweep."},
    {"GridOfPilots", "grid: {pilot: [none, oracle]}\n",
     "bad.yaml:1:8: pilot belongs into sweep: pilots are compared, not pooled."},
    {"SweepOfStops", "throw: {}\nsweep: {stop.half_width: [0.1, 0.2]}\n",
     "bad.yaml:2:9: stop.half_width cannot vary: it is about the whole campaign."},
    {"GridWithoutThrow", "grid: {size_m: [0.1]}\n",
     "bad.yaml:1:8: throw.size_m has several values, but nobody throws; add throw: {}."},
    {"SweepContradiction",
     "dodger: {position: {min_range_m: 0.2}}\nsweep:\n"
     "  dodger.position.max_range_m: [0.1, 1]\n",
     "bad.yaml:1:34: dodger.position.min_range_m is 0.2 but must be less than "
     "position.max_range_m, which is 0.1. That is so with dodger.position.max_range_m 0.1."},
    {"GridWithTwoMistakes",
     "flight_controller: {period_us: 300}\nthrow: {}\ngrid: {mission.type: [hover, goal]}\n",
     "bad.yaml:1:32: flight_controller.period_us is 300, but must be a multiple of 250.\n"
     "bad.yaml:3:30: mission.goal_m is missing, but mission.type goal needs it. That is so with "
     "mission.type goal."},
    {"GridTooLarge", "throw: {}\nrepeats: 1000000\ngrid: {size_m: [" + numbers(11) + "]}\n",
     "bad.yaml:3:7: repeats, grid and sweep make 11000000 throws; at most 10000000 are allowed."},
    {"GridBomb",
     "throw: {}\ngrid: {size_m: [" + numbers(99) + "], speed_mps: [" + numbers(99) +
         "], distance_m: [" + numbers(99) + "]}\nsweep: {after_s: [" + numbers(99) +
         "], duration_s: [" + numbers(99) + "]}\n",
     "bad.yaml:2:7: grid and sweep have more than 10000 combinations of values."},
    {"StopOfASweep", "throw: {}\nsweep: {throw.speed_mps: [4, 5]}\nstop: {half_width: 0.1}\n",
     "bad.yaml:3:7: stop and sweep are both given"},
    {"StopOfAGrid", "throw: {}\ngrid: {throw.speed_mps: [4, 5]}\nstop: {half_width: 0.1}\n",
     "bad.yaml:3:7: stop and grid are both given"},
    {"StopOfNothing", "stop: {half_width: 0.1}\n",
     "bad.yaml:1:7: stop is given, but nobody throws."},
    {"StopTooNarrow", "throw: {}\nstop: {half_width: 0.001}\n",
     "bad.yaml:2:20: stop.half_width is 0.001, but must be between 0.005 and 0.5."},
    // Files and vehicles.
    {"ExtendsNowhere", "extends: no_such.yaml\n",
     "bad.yaml:1:10: extends is \"no_such.yaml\", but there is no such file."},
    {"ExtendsOutside", "extends: ../../../../../../../../etc/passwd\n",
     "bad.yaml:1:10: extends is \"../../../../../../../../etc/passwd\", but must end in .yaml or"},
    {"ExtendsAbsolute", "extends: /etc/hosts.yaml\n",
     "bad.yaml:1:10: extends is \"/etc/hosts.yaml\", but must be relative"},
    {"NegativeMass", "vehicle_overrides: {mass_scale: -1}\n",
     "bad.yaml:1:33: vehicle_overrides.mass_scale is -1, but must be between 0.1 and 10."},
    {"CoreContradiction", "dodger: {position: {min_range_m: 2, max_range_m: 1}}\n",
     "bad.yaml:1:34: dodger.position.min_range_m is 2 but must be less than "
     "position.max_range_m, which is 1."},
    {"KhoslaFieldTooFlat", "dodger: {repulsive: {field: khosla, gamma: 0.1}}\n",
     "bad.yaml:1:44: dodger.repulsive.gamma is 0.1 but must be at least 1 for the khosla field"},
    {"CoreContradictionOfOneKey",
     "dodger:\n  position: {max_range_m: 3}\n  time_image: {blur_px: 4}\n",
     "bad.yaml:3:25: dodger.time_image.blur_px is 4 but must be odd"},
    {"ImuRateOffTheTicks", "sensors: {imu: {rate_hz: 300}}\n",
     "bad.yaml:1:26: sensors.imu.rate_hz is 300, but must divide 4000."},
    {"RangeSensorRateOffTheTicks", "sensors: {range: {rate_hz: 240}}\n",
     "bad.yaml:1:28: sensors.range.rate_hz is 240, but must divide 4000."},
    {"StateEstimateRateOffTheTicks", "sensors: {state_estimate: {rate_hz: 260}}\n",
     "bad.yaml:1:37: sensors.state_estimate.rate_hz is 260, but must divide 4000."},
    {"FlightControllerOffTheTicks", "flight_controller: {period_us: 300}\n",
     "bad.yaml:1:32: flight_controller.period_us is 300, but must be a multiple of 250."},
    {"IdleThrustAboveTheGreatest",
     "motors: {min_thrust_n: 5}\nvehicle_overrides: {max_thrust_n: 4.9}\n",
     "bad.yaml:1:24: motors.min_thrust_n is 5, but must be less than "
     "vehicle_overrides.max_thrust_n, which is 4.9."},
    {"PilotFasterThanTheVehicle", "pilot: oracle\ndodger:\n  velocity_limit: {max_speed_mps: 8}\n",
     "bad.yaml:3:35: dodger.velocity_limit.max_speed_mps is 8, but must not exceed "
     "controller.evading_speed_limit_mps, which is 5."},
    {"CruiseFasterThanThePilotFlies", "mission: {type: goal, goal_m: [5, 0, 2], speed_mps: 8}\n",
     "bad.yaml:1:53: mission.speed_mps is 8, but must not exceed "
     "dodger.velocity_limit.max_speed_mps, which is 5."},
    {"VehicleSlowerThanItsPilot", "controller:\n  evading_speed_limit_mps: 3\n",
     "bad.yaml:2:28: controller.evading_speed_limit_mps is 3, but must not be less than "
     "dodger.velocity_limit.max_speed_mps, which is 5."},
    {"SweptToTooSlowARangeSensor", "sweep: {sensors.range.rate_hz: [200, 10]}\n", "bad.yaml:1:"},
};

INSTANTIATE_TEST_SUITE_P(All, BadScenarioTest, ::testing::ValuesIn(kBadScenarios),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace dodgesim
