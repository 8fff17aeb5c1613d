#include "sim/campaign/tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <set>

#include "sim/campaign/csv.h"
#include "sim/campaign/statistics.h"
#include "sim/config/expand.h"

namespace dodgesim {

namespace {

constexpr std::size_t kMostSingleValues = 6;  // more become bins
constexpr double kSizeBin_m = 0.1;
constexpr double kDistanceBin_m = 1;
constexpr double kSpeedBin_mps = 1;

std::string fixed(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3f", value);
  return text.data();
}

// A pilot of the tables and its flight through a throw.
struct Column {
  std::string pilot;
  const FlightResult& (*flight)(const ThrowResult&);
};

const FlightResult& flown(const ThrowResult& result) { return result.flown; }
const FlightResult& oracle(const ThrowResult& result) { return result.oracle; }
const FlightResult& none(const ThrowResult& result) { return result.none; }

using Select = std::function<bool(const ThrowResult&)>;

Tally tally(const std::vector<ThrowResult>& results, const Column& column, const Select& selected) {
  Tally sum;
  for (const ThrowResult& result : results) {
    if (result.thrown() && selected(result)) sum.add(column.flight(result), result.none);
  }
  return sum;
}

// The pilot none dodges nothing: its column says how many throws would have hit.
std::string cell(const Column& column, const Tally& sum) {
  const bool none = column.flight == &dodgesim::none;
  std::string text =
      none ? rate_text(sum.would_have_hit, sum.throws) : rate_text(sum.dodged, sum.would_have_hit);
  if (sum.errors > 0) text += ", " + std::to_string(sum.errors) + " errors";
  return text;
}

class TableWriter {
 public:
  TableWriter(const std::vector<ThrowResult>& results, std::vector<Column> columns)
      : results_(results), columns_(std::move(columns)) {
    csv_ =
        "sweep,size_m,distance_m,speed_mps,pilot,throws,would_have_hit,dodged,rate,rate_lo,rate_hi,"
        "errors\n";
  }

  void by_size_and_distance() {
    const std::vector<Bin> sizes = bins(&ThrowResult::size_m, kSizeBin_m);
    const std::vector<Bin> distances = bins(&ThrowResult::distance_m, kDistanceBin_m);
    markdown_ += "## By size and distance\n\n| size | pilot |";
    for (const Bin& distance : distances) markdown_ += " " + distance.text() + " m |";
    markdown_ += " all distances |\n|---|---|" + repeat("---|", distances.size() + 1) + "\n";
    for (const Bin& size : sizes) {
      size_row(size.text() + " m", size.text(), distances,
               [&](const ThrowResult& r) { return size.contains(r.size_m); });
    }
    size_row("all", "all", distances, [](const ThrowResult&) { return true; });
    markdown_ += "\n";
  }

  void by_speed() {
    markdown_ += "## By speed\n\n| speed |";
    for (const Column& column : columns_) markdown_ += " " + heading(column) + " |";
    markdown_ += "\n|---|" + repeat("---|", columns_.size()) + "\n";
    for (const Bin& speed : bins(&ThrowResult::speed_mps, kSpeedBin_mps)) {
      markdown_ += "| " + speed.text() + " m/s |";
      for (const Column& column : columns_) {
        const Tally sum = tally(results_, column,
                                [&](const ThrowResult& r) { return speed.contains(r.speed_mps); });
        markdown_ += " " + cell(column, sum) + " |";
        csv_row("all", "all", speed.text(), column, sum);
      }
      markdown_ += "\n";
    }
    markdown_ += "\n";
  }

  Tables take() { return {std::move(markdown_), std::move(csv_)}; }

 private:
  static std::string repeat(const std::string& text, std::size_t count) {
    std::string repeated;
    for (std::size_t i = 0; i < count; ++i) repeated += text;
    return repeated;
  }

  static std::string heading(const Column& column) {
    return column.flight == &none ? "none: would have hit" : column.pilot;
  }

  std::vector<Bin> bins(double ThrowResult::*key, double width) const {
    std::vector<double> values;
    for (const ThrowResult& result : results_) {
      if (result.thrown()) values.push_back(result.*key);
    }
    return make_bins(values, width);
  }

  void size_row(const std::string& label, const std::string& size,
                const std::vector<Bin>& distances, const Select& of_size) {
    for (const Column& column : columns_) {
      markdown_ += "| " + label + " | " + heading(column) + " |";
      for (const Bin& distance : distances) {
        const Tally sum = tally(results_, column, [&](const ThrowResult& r) {
          return of_size(r) && distance.contains(r.distance_m);
        });
        markdown_ += " " + cell(column, sum) + " |";
        csv_row(size, distance.text(), "all", column, sum);
      }
      const Tally sum = tally(results_, column, of_size);
      markdown_ += " " + cell(column, sum) + " |\n";
      csv_row(size, "all", "all", column, sum);
    }
  }

  void csv_row(const std::string& size, const std::string& distance, const std::string& speed,
               const Column& column, const Tally& sum) {
    const Interval interval = wilson(sum.dodged, sum.would_have_hit);
    const double rate = sum.would_have_hit == 0 ? 0 : double(sum.dodged) / sum.would_have_hit;
    csv_ += std::to_string(results_.front().sweep) + "," + size + "," + distance + "," + speed +
            "," + column.pilot + "," + std::to_string(sum.throws) + "," +
            std::to_string(sum.would_have_hit) + "," + std::to_string(sum.dodged) + ",";
    if (sum.would_have_hit > 0) csv_ += to_text(rate);
    csv_ += "," + to_text(interval.lo) + "," + to_text(interval.hi) + "," +
            std::to_string(sum.errors) + "\n";
  }

  const std::vector<ThrowResult>& results_;
  std::vector<Column> columns_;
  std::string markdown_, csv_;
};

std::string count_text(int count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// What a rate over the throws that would have hit does not show.
std::string asides(const std::vector<ThrowResult>& results, const std::string& pilot) {
  int quiet = 0, quiet_evaded = 0, would_miss = 0, miss_evaded = 0, walked_into = 0;
  std::string errors;
  int failed = 0;
  for (const ThrowResult& result : results) {
    for (const FlightResult* flight : {&result.flown, &result.none, &result.oracle}) {
      if (!flight->failed()) continue;
      ++failed;
      const char* who = flight == &result.flown  ? pilot.c_str()
                        : flight == &result.none ? "none"
                                                 : "oracle";
      errors += "- throw " + std::to_string(result.index) + ", pilot " + who + ": " +
                flight->error + "\n";
    }
    if (!result.flown.ok()) continue;
    if (!result.thrown()) {
      ++quiet;
      quiet_evaded += result.evaded ? 1 : 0;
    } else if (result.none.ok() && !result.none.hit) {
      ++would_miss;
      miss_evaded += result.evaded ? 1 : 0;
      walked_into += result.flown.hit ? 1 : 0;
    }
  }
  std::string text;
  if (quiet > 0) {
    text += "False alarms: " + pilot + " evaded in " + rate_text(quiet_evaded, quiet) +
            " flights in which nobody threw.\n\n";
  }
  if (would_miss > 0) {
    text += "Of " + count_text(would_miss, "throw") + " that would have missed, " + pilot +
            " evaded " + std::to_string(miss_evaded) + " and was hit by " +
            std::to_string(walked_into) + ".\n\n";
  }
  if (failed > 0) {
    text += "## Errors\n\n" + count_text(failed, "flight") +
            " failed and count as no success:\n\n" + errors + "\n";
  }
  return text;
}

// A value that somebody wrote, rather than one drawn from a continuous distribution.
bool is_round(double value) { return std::abs(value - std::round(value * 1e3) / 1e3) < 1e-12; }

}  // namespace

void Tally::add(const FlightResult& flight, const FlightResult& none) {
  if (flight.failed() || none.failed()) ++errors;
  if (!none.ok() || flight.status == "not flown") return;
  ++throws;
  if (!none.hit) return;
  ++would_have_hit;
  if (flight.unharmed()) ++dodged;
}

bool Bin::contains(double value) const {
  return lo == hi ? value == lo : value >= lo && value < hi;
}

std::string Bin::text() const {
  return lo == hi ? to_text(lo) : to_text(lo) + " to " + to_text(hi);
}

std::vector<Bin> make_bins(const std::vector<double>& values, double width) {
  const std::set<double> distinct(values.begin(), values.end());
  std::vector<Bin> bins;
  const bool all_round = std::all_of(distinct.begin(), distinct.end(), is_round);
  if (distinct.size() <= kMostSingleValues && all_round) {
    for (const double value : distinct) bins.push_back({value, value});
    return bins;
  }
  const auto cell_of = [&](double value) {
    return static_cast<std::int64_t>(std::floor(value / width));
  };
  // Multiples such as 3 * 0.1 would print as 0.30000000000000004.
  const auto edge = [&](std::int64_t k) {
    return std::round(static_cast<double>(k) * width * 1e9) / 1e9;
  };
  for (std::int64_t i = cell_of(*distinct.begin()); i <= cell_of(*distinct.rbegin()); ++i) {
    bins.push_back({edge(i), edge(i + 1)});
  }
  return bins;
}

std::string rate_text(int successes, int trials) {
  std::string text = std::to_string(successes) + " / " + std::to_string(trials);
  if (trials == 0) return text;
  const Interval interval = wilson(successes, trials);
  return text + " (" + fixed(double(successes) / trials) + ", " + fixed(interval.lo) + " to " +
         fixed(interval.hi) + ")";
}

namespace {

std::string pilot_of(const std::vector<AxisValue>& sweep_values, const std::string& otherwise) {
  for (const AxisValue& value : sweep_values) {
    if (value.key == "pilot") return value.value;
  }
  return otherwise;
}

// The tables of one value of the sweep, whose results may be pooled.
Tables pooled_tables(const std::vector<ThrowResult>& results, const std::string& pilot) {
  std::vector<Column> columns = {{pilot, &flown}};
  const bool with_oracle = std::any_of(results.begin(), results.end(), [](const ThrowResult& r) {
    return r.oracle.status != "not flown";
  });
  if (with_oracle) columns.push_back({"oracle", &oracle});
  columns.push_back({"none", &none});
  TableWriter writer(results, columns);
  const bool anything_thrown =
      std::any_of(results.begin(), results.end(), [](const ThrowResult& r) { return r.thrown(); });
  std::string head;
  if (anything_thrown) {
    const Tally all = tally(results, columns[0], [](const ThrowResult&) { return true; });
    head = "Dodged: " + rate_text(all.dodged, all.would_have_hit) + "\n\n";
    writer.by_size_and_distance();
    writer.by_speed();
  }
  Tables tables = writer.take();
  tables.markdown = head + tables.markdown + asides(results, pilot);
  return tables;
}

}  // namespace

Tables make_tables(const std::vector<ThrowResult>& results, const std::string& title,
                   const std::string& pilot) {
  std::map<int, std::vector<ThrowResult>> of_sweep;
  for (const ThrowResult& result : results) of_sweep[result.sweep].push_back(result);
  Tables tables;
  tables.markdown = "# " + title + "\n\n" + count_text(static_cast<int>(results.size()), "throw") +
                    ", pilot " + pilot + ". Cells: dodged / would have hit (rate, 95 % Wilson " +
                    "interval); for the pilot none: would have hit / throws.\n\n";
  for (const auto& [sweep, of_value] : of_sweep) {
    const std::vector<AxisValue>& values = of_value[0].sweep_values;
    if (!values.empty()) tables.markdown += "# " + label(values) + "\n\n";
    const Tables block = pooled_tables(of_value, pilot_of(values, pilot));
    tables.markdown += block.markdown;
    tables.csv += tables.csv.empty() ? block.csv : block.csv.substr(block.csv.find('\n') + 1);
  }
  return tables;
}

}  // namespace dodgesim
