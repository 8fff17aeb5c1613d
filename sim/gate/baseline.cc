#include "sim/gate/baseline.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/base/error.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kCopied[] = {"throws.csv", "scenario.resolved.yaml", "table.md"};

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || !text) throw IoError(path.string() + " could not be read.");
  return text.str();
}

Json read_manifest(const fs::path& directory) {
  const fs::path path = directory / "manifest.json";
  try {
    return Json::parse(contents(path));
  } catch (const Json::exception& error) {
    throw IoError(path.string() + " is no manifest of a campaign: " + error.what() + ".");
  }
}

std::string kind_of(const Json& manifest) {
  return manifest.at("machine").at("cpu_flags").get<std::string>() + "\n" +
         manifest.at("libraries").dump() + "\n" +
         manifest.at("program").at("compiler").get<std::string>() + "\n" +
         manifest.at("program").at("build_type").get<std::string>();
}

GateRules rules_of(const Json& manifest) {
  const Json& gate = manifest.at("gate");
  return {gate.at("margin").get<double>(), gate.at("confidence").get<double>(),
          gate.at("must_equal").get<std::string>()};
}

// What `take` reads from a directory's manifest; a value that is missing or of a wrong type is an
// IoError.
template <class Take>
auto from_manifest(const fs::path& directory, Take take) {
  const Json manifest = read_manifest(directory);
  try {
    return take(manifest);
  } catch (const Json::exception& error) {
    throw IoError((directory / "manifest.json").string() + " lacks a value: " + error.what() + ".");
  }
}

void move_to(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw IoError(to.string() + " could not be written: " + error.message() + ".");
}

}  // namespace

std::string machine_kind(const fs::path& directory) { return from_manifest(directory, kind_of); }

Baseline read_baseline(const fs::path& directory) {
  return {CsvTable(directory / "throws.csv"), contents(directory / "scenario.resolved.yaml"),
          from_manifest(directory, rules_of),
          from_manifest(directory,
                        [](const Json& manifest) {
                          return manifest.at("program").at("commit").get<std::string>();
                        }),
          machine_kind(directory)};
}

void write_baseline(const fs::path& directory, const fs::path& campaign, const GateRules& rules) {
  const fs::path whole = fs::absolute(directory).lexically_normal();
  fs::path fresh = whole, old = whole;
  fresh += ".new";
  old += ".old";
  Json manifest = read_manifest(campaign);
  manifest.erase("time");
  manifest["gate"] = {
      {"margin", rules.margin}, {"confidence", rules.confidence}, {"must_equal", rules.must_equal}};
  std::error_code error;
  fs::remove_all(fresh, error);
  fs::create_directories(fresh, error);
  if (error) throw IoError(fresh.string() + " could not be made: " + error.message() + ".");
  for (const char* name : kCopied) write_file(fresh / name, contents(campaign / name));
  write_file(fresh / "manifest.json", manifest.dump(2) + "\n");
  fs::remove_all(old, error);
  if (fs::exists(whole)) move_to(whole, old);
  move_to(fresh, whole);
  fs::remove_all(old, error);
}

}  // namespace dodgesim
