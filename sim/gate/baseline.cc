#include "sim/gate/baseline.h"

#include <algorithm>
#include <deque>
#include <set>
#include <stdexcept>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/campaign/campaign_files.h"
#include "sim/campaign/manifest.h"
#include "sim/files/directory.h"
#include "sim/files/json.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

constexpr const char* kCopied[] = {kThrowsFile, kObjectsFile, kScenarioFile, kTableFile};

const Json& value_at(const Json& manifest, const std::string& group, const std::string& key) {
  if (manifest.is_object() && manifest.contains(group) && manifest[group].is_object() &&
      manifest[group].contains(key)) {
    return manifest[group][key];
  }
  throw std::invalid_argument(group + "." + key + " is missing");
}

std::string text_at(const Json& manifest, const std::string& group, const std::string& key) {
  const Json& value = value_at(manifest, group, key);
  if (value.is_string()) return value.get<std::string>();
  throw std::invalid_argument(group + "." + key + " must be a text, not " + to_text(value));
}

double number_at(const Json& manifest, const std::string& group, const std::string& key) {
  const Json& value = value_at(manifest, group, key);
  if (value.is_number()) return value.get<double>();
  throw std::invalid_argument(group + "." + key + " must be a number, not " + to_text(value));
}

std::string kind_of(const Json& manifest) {
  return text_at(manifest, "machine", "cpu_flags") + "\n" +
         (manifest.contains("libraries") ? to_text(manifest["libraries"]) : "") + "\n" +
         text_at(manifest, "program", "compiler") + "\n" +
         text_at(manifest, "program", "build_type");
}

GateRules rules_of(const Json& manifest) {
  return {number_at(manifest, "gate", "margin"), number_at(manifest, "gate", "confidence"),
          text_at(manifest, "gate", "must_equal")};
}

// What `take` reads from a directory's manifest; a value that is missing or of a wrong type is an
// IoError.
template <class Take>
auto from_manifest(const fs::path& directory, Take take) {
  const Json manifest = read_manifest(directory);
  try {
    return take(manifest);
  } catch (const std::invalid_argument& error) {
    throw IoError((directory / kManifestFile).string() + ": " + error.what() + ".");
  }
}

void expect(bool right, const fs::path& directory, const std::string& key,
            const std::string& allowed) {
  if (right) return;
  throw IoError((directory / kManifestFile).string() + ": gate." + key + " must be " + allowed +
                ".");
}

void check(const GateRules& rules, const fs::path& directory) {
  expect(rules.margin >= 0 && rules.margin < 1, directory, "margin", "at least 0 and below 1");
  expect(rules.confidence > 0 && rules.confidence < 1, directory, "confidence", "between 0 and 1");
  const std::string& equal = rules.must_equal;
  expect(equal == "nothing" || equal == "physics" || equal == "all", directory, "must_equal",
         "nothing, physics or all");
}

// Pairing by number needs numbers that come once.
void check(const CsvTable& throws, const fs::path& directory) {
  std::set<std::string> numbers;
  for (std::size_t row = 0; row < throws.rows(); ++row) {
    const std::string& number = throws.at(row, "throw");
    if (numbers.insert(number).second && number == std::to_string(row)) continue;
    throw IoError((directory / kThrowsFile).string() + ":" + std::to_string(throws.line(row)) +
                  ": Throw " + number + " stands where throw " + std::to_string(row) +
                  " must; a baseline has every throw once, in order.");
  }
}

}  // namespace

std::string machine_kind(const fs::path& directory) { return from_manifest(directory, kind_of); }

Baseline read_baseline(const fs::path& directory) {
  Baseline baseline = {
      read_tables(directory), read_file(directory / kScenarioFile),
      from_manifest(directory, rules_of),
      from_manifest(directory,
                    [](const Json& manifest) { return text_at(manifest, "program", "commit"); }),
      machine_kind(directory)};
  check(baseline.rules, directory);
  check(baseline.tables.throws, directory);
  if (!baseline.tables.objects) {
    throw IoError((directory / kObjectsFile).string() + " is missing.");
  }
  return baseline;
}

bool holds_baseline_files(const fs::path& directory) {
  const auto is_there = [&](const char* name) { return fs::exists(directory / name); };
  return is_there(kManifestFile) || std::ranges::any_of(kCopied, is_there);
}

bool is_marked_as_baseline(const fs::path& directory) {
  try {
    return read_file(directory / kManifestFile).find("\"gate\":") != std::string::npos;
  } catch (const IoError&) {
    return false;
  }
}

GateRules rules_or_default(const fs::path& directory) {
  try {
    GateRules rules = from_manifest(directory, rules_of);
    check(rules, directory);
    return rules;
  } catch (const IoError&) {
    return {};
  }
}

void write_baseline(const fs::path& directory, const fs::path& campaign, const GateRules& rules) {
  make_directory(directory);
  Json manifest = read_manifest(campaign);
  manifest.erase("time");
  manifest["gate"] = {
      {"margin", rules.margin}, {"confidence", rules.confidence}, {"must_equal", rules.must_equal}};
  std::deque<OutputFile> files;  // none appears before all are written
  for (const char* name : kCopied) {
    files.emplace_back(directory / name).write(read_file(campaign / name));
  }
  files.emplace_back(directory / kManifestFile).write(to_text(manifest, 2) + "\n");
  for (OutputFile& file : files) file.finish();
  for (OutputFile& file : files) file.commit();
}

}  // namespace dodgesim
