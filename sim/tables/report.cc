#include "sim/tables/report.h"

#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "sim/base/contains.h"
#include "sim/base/shell.h"
#include "sim/files/base64.h"
#include "sim/files/json.h"
#include "sim/files/markup.h"
#include "sim/outcome/collision_cause.h"
#include "sim/outcome/fate.h"
#include "sim/tables/axis.h"
#include "sim/tables/statistics_table.h"

namespace dodgesim {

// The page, its style and its program: sim/tables/report/, which embed.cmake has put into C++.
extern const char* const kReport_page;
extern const char* const kReport_style;
extern const char* const kReport_script;

namespace {

static_assert(std::endian::native == std::endian::little, "The page reads its numbers so.");

constexpr std::uint8_t kNowhere = 255;

// What is true of a throw, as bits of the column "flags".
struct Flag {
  const char* name;
  bool (*of)(const ThrowResult& result);
};
constexpr Flag kFlags[] = {{"thrown", [](const ThrowResult& r) { return r.thrown(); }},
                           {"failed", [](const ThrowResult& r) { return r.flown.failed(); }},
                           {"none_hit", [](const ThrowResult& r) { return r.none.hit; }},
                           {"false_alarm", [](const ThrowResult& r) { return r.false_alarm; }}};

std::uint8_t flags_of(const ThrowResult& result) {
  unsigned flags = 0;
  for (std::size_t i = 0; i < std::size(kFlags); ++i) flags |= kFlags[i].of(result) ? 1U << i : 0U;
  return static_cast<std::uint8_t>(flags);
}

float number(std::optional<double> value) {
  return static_cast<float>(value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

float time(std::optional<TimeUs> value) {
  return value ? static_cast<float>(seconds(*value)) : number(std::nullopt);
}

std::uint8_t place(std::optional<std::size_t> at) {
  return at && *at < kNowhere ? static_cast<std::uint8_t>(*at) : kNowhere;
}

// A grid may have more rows than `place` can tell apart.
std::uint32_t heat_place(std::optional<std::size_t> at) {
  return at ? static_cast<std::uint32_t>(*at) : std::numeric_limits<std::uint32_t>::max();
}

// Why a throw's flights failed; empty: none did. `pilot` is the flown one.
std::string errors_of(const ThrowResult& r, const std::string& pilot) {
  std::string text;
  for (const auto& [flight, who] : failed_flights(r, pilot)) {
    if (!text.empty()) text += " ";
    if (flight != &r.flown) text += "The flight of the pilot " + who + " failed: ";
    text += flight->error;
  }
  return text;
}

std::uint8_t cause_of(const ThrowResult& result) {
  for (std::size_t i = 0; i < kCollisionCauses.size(); ++i) {
    if (to_text(kCollisionCauses[i]) == result.cause) return static_cast<std::uint8_t>(i);
  }
  return kNowhere;
}

using Values = std::vector<std::string>;

struct ReportAxes {
  explicit ReportAxes(const std::vector<ThrowResult>& results)
      : grid(grid_axes(results)), speed("speed_mps", results) {
    for (const ThrowResult& result : results) {
      if (result.thrown() && !contains(objects, result.object)) objects.push_back(result.object);
    }
    for (const Axis& axis : grid) {
      if (!axis.middles().empty() && heat.size() < 2) heat.push_back(axis);
    }
    if (heat.size() < 2) heat = {Axis("size_m", results), Axis("distance_m", results)};
    if (grid.empty()) return;
    cells.emplace_back();
    for (const Axis& axis : grid) {
      std::vector<Values> longer;
      for (const Values& cell : cells) {
        for (const std::string& value : axis.values()) {
          longer.push_back(cell);
          longer.back().push_back(value);
        }
      }
      cells = std::move(longer);
    }
  }

  // Where in `cells` a throw stands.
  std::uint32_t cell_of(const ThrowResult& result) const {
    std::size_t place = 0;
    for (const Axis& axis : grid)
      place = place * axis.values().size() + axis.of(result).value_or(0);
    return static_cast<std::uint32_t>(place);
  }

  // Where in `objects` its first one stands; nothing where nobody threw.
  std::optional<std::size_t> object_of(const ThrowResult& result) const {
    return result.thrown() ? index_of(objects, result.object) : std::nullopt;
  }

  std::vector<Axis> grid;
  std::vector<Axis> heat;  // rows and columns of the heat map: the first two numeric keys of the
                           // grid, or size and distance
  Axis speed;
  std::vector<std::string> objects;  // that were thrown first, whatever a cell of the grid says
  std::vector<Values> cells;         // of the grid, the values of its last key changing fastest
};

// Numbers of all throws as base64, by name.
class Columns {
 public:
  explicit Columns(const std::vector<ThrowResult>& results) : results_(results) {}

  template <class Of>
  void add(const char* name, Of of) {
    using T = decltype(of(results_.front()));
    std::string bytes(results_.size() * sizeof(T), '\0');
    for (std::size_t i = 0; i < results_.size(); ++i) {
      const T value = of(results_[i]);
      std::memcpy(bytes.data() + i * sizeof(T), &value, sizeof(T));
    }
    const char* type = std::is_same_v<T, float> ? "f32"
                       : sizeof(T) == 1         ? "u8"
                       : sizeof(T) == 2         ? "u16"
                                                : "u32";
    json_[name] = {{"type", type}, {"values", base64(bytes)}};
  }
  Json take() { return std::move(json_); }

 private:
  const std::vector<ThrowResult>& results_;
  Json json_ = Json::object();
};

Json columns_of(const std::vector<ThrowResult>& results, const ReportAxes& axes) {
  using R = ThrowResult;
  Columns columns(results);
  columns.add("number", [](const R& r) { return static_cast<std::uint32_t>(r.index); });
  columns.add("sweep", [](const R& r) { return static_cast<std::uint16_t>(r.sweep); });
  columns.add("fate", [](const R& r) { return static_cast<std::uint8_t>(fate_of(r)); });
  columns.add("flags", flags_of);
  columns.add("cause", cause_of);
  columns.add("heat_row", [&](const R& r) { return heat_place(axes.heat[0].of(r)); });
  columns.add("heat_column", [&](const R& r) { return heat_place(axes.heat[1].of(r)); });
  columns.add("cell", [&](const R& r) { return axes.cell_of(r); });
  columns.add("objects", [](const R& r) { return static_cast<std::uint8_t>(r.objects); });
  columns.add("object", [&](const R& r) { return place(axes.object_of(r)); });
  columns.add("size", [](const R& r) { return number(r.size_m); });
  columns.add("distance", [](const R& r) { return number(r.distance_m); });
  columns.add("speed", [](const R& r) { return number(r.speed_mps); });
  columns.add("clearance", [](const R& r) { return number(r.flown.clearance_m); });
  columns.add("oracle_clearance", [](const R& r) { return number(r.oracle.clearance_m); });
  columns.add("detection_distance",
              [](const R& r) { return number(r.first_detection_distance_m); });
  columns.add("contact", [](const R& r) { return time(r.time_to_contact_us); });
  columns.add("left", [](const R& r) { return number(r.escape_left_s); });
  columns.add("needed", [](const R& r) { return number(r.escape_needed_s); });
  columns.add("launch", [](const R& r) {
    return time(r.thrown() ? std::optional(r.launch_us) : std::nullopt);
  });
  columns.add("in_view", [](const R& r) { return time(r.first_in_view_us); });
  columns.add("detected", [](const R& r) { return time(r.first_detection_us); });
  columns.add("command", [](const R& r) { return time(r.first_command_us); });
  columns.add("hit", [](const R& r) { return time(r.flown.hit_us); });
  columns.add("closest", [](const R& r) { return time(r.flown.closest_us); });
  columns.add("real_time_factor", [](const R& r) {
    return number(r.wall_s > 0 ? std::optional(seconds(r.duration_us) / r.wall_s) : std::nullopt);
  });
  std::uint32_t at = 0;
  columns.add("track_at", [&](const R& r) {
    const std::uint32_t start = at;
    at += static_cast<std::uint32_t>(r.trajectory.size());
    return start;
  });
  columns.add("track_size",
              [](const R& r) { return static_cast<std::uint32_t>(r.trajectory.size()); });
  return columns.take();
}

// [count, of, lo, hi], and the name of the interval if it is not Wilson's
Json rate_of(const Rate& rate) {
  Json json = {rate.count, rate.of, rate.interval().lo, rate.interval().hi};
  if (rate.sequential) json.push_back(rate.interval_name());
  return json;
}

// What the charts show of one pilot.
Json pilot_rate(const StatisticsTable::Row* row, Role role) {
  if (row == nullptr) return rate_of({});
  return rate_of(row->statistics.by(role).tally.shown(role));
}

Json section_of(const Part& part, const ReportAxes& axes) {
  const StatisticsTable by_heat = group_by(part, axes.heat);
  const StatisticsTable by_speed = group_by(part, {axes.speed});
  const StatisticsTable by_cell = group_by(part, axes.grid);
  const ThrowStatistics& all = by_heat.rows.back().statistics;
  Json pilots = Json::array();
  for (const Role role : shown_pilots(by_heat)) {
    Json heat = Json::array(), speeds = Json::array(), cells = Json::array();
    for (const std::string& row_value : axes.heat[0].values()) {
      Json row = Json::array();
      for (const std::string& value : axes.heat[1].values()) {
        row.push_back(pilot_rate(find_row(by_heat, {row_value, value}), role));
      }
      heat.push_back(std::move(row));
    }
    for (const std::string& speed : axes.speed.values()) {
      speeds.push_back(pilot_rate(find_row(by_speed, {speed}), role));
    }
    for (const Values& cell : axes.cells)
      cells.push_back(pilot_rate(find_row(by_cell, cell), role));
    pilots.push_back({{"role", role_name(role)},
                      {"name", all.by(role).pilot},
                      {"total", pilot_rate(&by_heat.rows.back(), role)},
                      {"heat", std::move(heat)},
                      {"by_speed", std::move(speeds)},
                      {"by_cell", std::move(cells)}});
  }
  Json values = Json::array();
  for (const AxisValue& value : part.values) values.push_back(value.value);
  return {{"label", label(part.values)},       {"sweep", part.sweep},
          {"values", std::move(values)},       {"pilots", std::move(pilots)},
          {"detected", rate_of(all.detected)}, {"false_alarms", rate_of(all.false_alarms)}};
}

Json data_of(const LoadedCampaign& campaign, const std::string& directory) {
  const Scenario& scenario = campaign.scenario;
  const std::vector<ThrowResult>& results = campaign.results;
  const ReportAxes axes(results);
  double simulated_s = 0, computing_s = 0;
  Json errors = Json::object();
  for (const ThrowResult& result : results) {
    simulated_s += seconds(result.duration_us);
    computing_s += result.wall_s;
  }
  const std::vector<Part> parts = parts_of(campaign);
  for (const Part& part : parts) {
    for (const ThrowResult* const result : part.results) {
      const std::string error = errors_of(*result, part.pilot);
      if (!error.empty()) errors[std::to_string(result->index)] = error;
    }
  }
  Json sections = Json::array();
  for (const Part& part : parts) sections.push_back(section_of(part, axes));
  Json heat = Json::array(), grid_keys = Json::array(), sweep_keys = Json::array();
  for (const Axis& axis : axes.heat)
    heat.push_back({{"key", axis.name()}, {"values", axis.values()}});
  for (const Axis& axis : axes.grid) grid_keys.push_back(axis.name());
  for (const AxisValue& value : parts.front().values) sweep_keys.push_back(value.key);
  Json fates = Json::array(), causes = Json::array(), flags = Json::object();
  for (const Fate fate : kFates) fates.push_back(to_text(fate));
  for (const CollisionCause cause : kCollisionCauses) causes.push_back(to_text(cause));
  for (std::size_t i = 0; i < std::size(kFlags); ++i) flags[kFlags[i].name] = 1U << i;
  return {{"title", scenario.name},
          {"description", scenario.description},
          {"seed", std::to_string(scenario.seed)},
          {"program", "dodgesim " + campaign.program},
          {"wanted", campaign.wanted()},
          {"stop", campaign.stop ? campaign.stop->text() : ""},
          {"losses", campaign.losses()},
          {"replay", replay_line(directory, scenario)},
          {"real_time_factor", computing_s > 0 ? simulated_s / computing_s : 0.0},
          {"heat", std::move(heat)},
          {"cells", {{"keys", std::move(grid_keys)}, {"values", axes.cells}}},
          {"speed", {{"values", axes.speed.values()}, {"middles", axes.speed.middles()}}},
          {"objects", axes.objects},
          {"fates", std::move(fates)},
          {"causes", std::move(causes)},
          {"flags", std::move(flags)},
          {"errors", std::move(errors)},
          {"sweep_keys", std::move(sweep_keys)},
          {"sections", std::move(sections)},
          {"columns", columns_of(results, axes)}};
}

// No text of a JSON document may end the element that it stands in.
std::string script_safe(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

}  // namespace

std::string replay_line(const std::string& directory, const Scenario& scenario) {
  std::string line = "dodgesim replay " + shell_quoted(directory);
  if (!scenario.models_dir.empty()) line += " --models " + shell_quoted(scenario.models_dir);
  const std::string& plugin = scenario.plugin.file;
  if (flies_plugin(scenario))
    line += " --plugin " + (plugin.empty() ? "FILE.so" : shell_quoted(plugin));
  return line + " --throw ";
}

std::string report_html(const LoadedCampaign& campaign, const std::string& directory) {
  const std::string data = script_safe(to_text(data_of(campaign, directory)));
  std::string tracks;
  for (const ThrowResult& result : campaign.results) tracks += result.trajectory;

  // The page's placeholders, in their order.
  const std::pair<std::string, std::string> parts[] = {
      {"@TITLE@", markup_escaped(campaign.scenario.name)},
      {"@STYLE@", kReport_style},
      {"@DATA@", data},
      {"@TRACKS@", base64(tracks)},
      {"@SCRIPT@", kReport_script}};
  std::string_view page = kReport_page;
  std::string html;
  for (const auto& [placeholder, text] : parts) {
    const std::size_t at = page.find(placeholder);
    html += page.substr(0, at);
    html += text;
    page.remove_prefix(at + placeholder.size());
  }
  return html + std::string(page);
}

}  // namespace dodgesim
