// What is counted and measured over throws. "Dodged" is ThrowResult::dodged(). A throw that the
// pilot gave up on, or whose flight failed with an error, never counts as a success and stays in
// the denominator. One that nobody could fly is in no rate of any pilot, and an error.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/outcome/result.h"
#include "sim/statistics/quantiles.h"

namespace dodgesim {

// What a pilot is in a campaign, whatever its name: the scenario's, its oracle, or nobody.
enum class Role { kFlown, kOracle, kNone };
const char* role_name(Role role);  // "flown", "oracle", "none"

// Of a rate whose counts decided when to stop counting, which makes the usual interval too narrow
// (sequential.h).
struct SequentialInterval {
  Interval interval;
  double confidence = 0.95;
};

struct Rate {
  std::int64_t count = 0;
  std::int64_t of = 0;
  std::optional<SequentialInterval> sequential = {};  // in place of Wilson's
  // It is the complement of a rate whose counts decided when to stop: no interval of it is known.
  bool stopped = false;

  void add(bool success) {
    ++of;
    count += success ? 1 : 0;
  }
  std::optional<double> value() const;  // empty when nothing was counted
  Interval interval() const { return sequential ? sequential->interval : wilson(count, of); }
  bool has_interval() const { return of > 0 && !stopped; }
  std::string interval_name() const;  // "Wilson 95 %", "sequential 95 %" or "none"
};

// "25 / 34 (0.735, 0.569 to 0.854)"; "0 / 0" without trials. An interval other than Wilson's is
// named: "25 / 34 (0.735, 0.569 to 0.854, sequential 95 %)". Where none is known, there is none:
// "25 / 34 (0.735)".
std::string rate_text(const Rate& rate);

// Counts over some throws, for one pilot.
struct Tally {
  int throws = 0;          // thrown, and tried by the pilot
  int would_have_hit = 0;  // of those, hit when nobody dodged, or that flight failed
  int dodged = 0;          // of those that would have hit
  Rate hit_undisturbed;    // by the pilot none, of its flights that did not fail
  // Throws of which the flight of this pilot or of none failed, and flights of this pilot that
  // failed though nobody threw. Throws that nobody could fly are among those of the flown pilot
  // alone.
  int errors = 0;
  Rate collisions;  // hit or crashed, of all flights of the pilot that did not fail, thrown at or
                    // not
  std::optional<SequentialInterval> sequential = {};  // of the success rate, see Rate

  void add(const ThrowResult& result, ThrowResult::FlightOf by = &ThrowResult::flown);
  Rate success() const { return {dodged, would_have_hit, sequential}; }
  // What tables show. The pilot none dodges nothing: of it, how many throws would have hit.
  Rate shown(Role role) const { return role == Role::kNone ? hit_undisturbed : success(); }
};

// What tables show of it, with its errors: "25 / 34 (0.735, 0.569 to 0.854), 1 error".
std::string tally_text(const Tally& tally, Role role);

// Numbers of throws that lie on a line, such as the clearance.
class Measured {
 public:
  void add(std::optional<double> value) {
    if (value) values_.push_back(*value);
  }
  std::size_t count() const { return values_.size(); }
  // Empty for an empty sample.
  std::optional<QuantileEstimate> quantile(double share) const;

 private:
  std::vector<double> values_;
};

struct PilotStatistics {
  std::string pilot;
  Tally tally;
  Measured clearance_m;  // 0 when it was hit
};

struct ThrowStatistics {
  std::array<PilotStatistics, 3> pilots;  // in the order of Role
  bool oracle_flew = false;

  // Of the flown pilot.
  Rate detected;                      // of the throws that came into view
  Rate false_alarms;                  // of all flights: evaded before it had detected an object
  std::map<std::string, int> causes;  // of its hits and crashes
  Measured detection_distance_m;      // of the first detection of a true object
  Measured time_to_contact_s;         // from there, if nobody dodged
  // The latency chain of the first detection: from the first moment in view to its output, from
  // the instant that it speaks of to its output, from there to the first evasive command at the
  // flight controller.
  Measured view_to_detection_s, image_to_detection_s, detection_to_command_s;

  PilotStatistics& by(Role role) { return pilots[static_cast<std::size_t>(role)]; }
  const PilotStatistics& by(Role role) const { return pilots[static_cast<std::size_t>(role)]; }
  const PilotStatistics& flown() const { return by(Role::kFlown); }
};

// The samples with the names that they have in tables.
struct NamedSample {
  const char* name;
  Measured ThrowStatistics::*sample;
};
inline constexpr NamedSample kSamples[] = {
    {"detection_distance_m", &ThrowStatistics::detection_distance_m},
    {"time_to_contact_s", &ThrowStatistics::time_to_contact_s},
    {"view_to_detection_s", &ThrowStatistics::view_to_detection_s},
    {"image_to_detection_s", &ThrowStatistics::image_to_detection_s},
    {"detection_to_command_s", &ThrowStatistics::detection_to_command_s}};

// A flight that failed, and who flew it.
struct FailedFlight {
  const FlightResult* flight;
  std::string pilot;
};
// Of a throw; `pilot` is the flown one, whose flight counts once if it is none or the oracle. Where
// nobody could fly, the flown pilot's alone tells why.
std::vector<FailedFlight> failed_flights(const ThrowResult& result, const std::string& pilot);

using Results = std::vector<const ThrowResult*>;

// The throws of one value of the sweep, those that may be pooled: other values of the sweep meet
// the same throws again.
struct Part {
  int sweep = 0;
  std::vector<AxisValue> values;
  std::string pilot;  // who flew it
  Results results;
  std::optional<SequentialInterval> sequential = {};  // of its success rate, see Rate
};

// In the order of the sweep; one part without a sweep. `pilot` is the scenario's.
std::vector<Part> parts_of(const std::vector<ThrowResult>& results, const std::string& pilot);

// `pilot` is the flown one's name.
ThrowStatistics statistics_of(const Results& results, const std::string& pilot);

// Of all throws of the part, with the interval that holds for it.
ThrowStatistics statistics_of(const Part& part);

}  // namespace dodgesim
