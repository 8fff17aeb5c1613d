// What became of the throws of a campaign, from its tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/config/axis_value.h"
#include "sim/files/csv_table.h"

namespace dodgesim {

struct CampaignTables {
  CsvTable throws;
  std::optional<CsvTable> objects = std::nullopt;       // needed where a throw has several objects
  std::optional<std::uint64_t> seed = std::nullopt;     // the campaign's, if it is known
  std::optional<std::uint64_t> planned = std::nullopt;  // throws of its scenario, if it is known
  std::optional<std::uint64_t> sweep_values = std::nullopt;  // likewise, values of its sweep
  std::string models = {};  // digest of room, vehicle and objects; empty: not known
};

// throws.csv and, if they are there, objects.csv, and seed, throws, sweep values and models of
// manifest.json. Throws IoError; MissingThrows if the campaign is not finished.
CampaignTables read_tables(const std::filesystem::path& directory);

// One object of a throw, as drawn before anything flies.
struct DrawnObject {
  std::string kind;
  std::vector<double> numbers;  // size, speed and so on, in the order of the columns
};

struct ThrowOutcome {
  int number = 0;
  int cell = 0, sweep = 0;            // numbers of the grid's cell and of the sweep value
  std::int64_t stream = 0;            // its number within the sweep value (sim/config/expand.h)
  std::vector<AxisValue> settings;    // the keys of both, in the order of the columns
  std::string label;                  // "0.2 m ball, 5.1 m/s from 3.2 m", or "quiet flight"
  std::vector<DrawnObject> draw;      // empty: nobody threw
  std::optional<std::uint64_t> seed;  // of the noise, too
  // It would have hit, or nobody threw. So may a throw whose flight failed; not so one that nobody
  // could fly.
  bool counts = false;
  bool nobody_could_fly = false;  // ThrowResult::nobody_could_fly()
  bool failed = false;            // the pilot's flight, or that without a pilot
  // Neither hit nor crashed, nor given up on with a landing; without a throw, no dodge either.
  bool success = false;
  // "dodged", "hit", "crashed", "landed", "evaded nothing", "quiet", "error: ..."; "not judged:
  // ..." where the flight failed that tells whether it would have hit.
  std::string what;
};

// Whether a column of throws.csv or objects.csv says what was drawn.
bool is_drawn(const std::string& column);

// In the order of the table. Throws IoError if the tables are not those of a campaign: a column or
// an object of a throw is missing, a number is none, or throws are not in order.
std::vector<ThrowOutcome> outcomes(const CampaignTables& campaign);

// What was not drawn alike for some object: "object" (its kind) and columns of numbers, in their
// order; or "number of objects" alone. Kinds are alike if they are equal, and numbers within 1e-9
// of the larger one (of 1, if that is more), because their last digits depend on the machine's
// libm.
std::vector<std::string> differing_draws(const ThrowOutcome& a, const ThrowOutcome& b);

// Whether everything was drawn alike, with the same seed as far as it is known.
bool same_throw(const ThrowOutcome& a, const ThrowOutcome& b);

// Whether two throws with one number within their sweep values were drawn from the same random
// numbers, if perhaps from other distributions: they are of the same seed and cell. Of a seed that
// is not known equal draws tell.
bool same_random_numbers(const ThrowOutcome& a, const ThrowOutcome& b);

}  // namespace dodgesim
