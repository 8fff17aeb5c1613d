// What became of the throws of a campaign, from its tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/config/varied_key.h"
#include "sim/gate/csv_table.h"

namespace dodgesim {

struct CampaignTables {
  CsvTable throws;
  std::optional<CsvTable> objects = std::nullopt;       // needed where a throw has several objects
  std::optional<std::uint64_t> seed = std::nullopt;     // the campaign's, if it is known
  std::optional<std::uint64_t> planned = std::nullopt;  // throws of its scenario, if it is known
};

// throws.csv and, if they are there, objects.csv, and seed and throws of manifest.json. Throws
// IoError.
CampaignTables read_tables(const std::filesystem::path& directory);

// One object of a throw, as drawn before anything flies.
struct DrawnObject {
  std::string kind;
  std::vector<double> numbers;  // size, speed and so on, in the order of the columns
};

struct ThrowOutcome {
  int number = 0;
  int cell = 0, sweep = 0;            // numbers of the grid's cell and of the sweep value
  std::vector<AxisValue> settings;    // the keys of both, in the order of the columns
  std::string label;                  // "0.2 m ball, 5.1 m/s from 3.2 m", or "quiet flight"
  std::vector<DrawnObject> draw;      // empty: nobody threw
  std::optional<std::uint64_t> seed;  // of the noise, too
  bool counts = false;                // it would have hit, or nobody threw
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

// Whether everything was drawn alike, with the same seed as far as it is known: kinds are equal,
// and numbers within 1e-9 of the larger one (of 1, if that is more), because their last digits
// depend on the machine's libm.
bool same_throw(const ThrowOutcome& a, const ThrowOutcome& b);

}  // namespace dodgesim
