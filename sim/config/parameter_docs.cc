#include "sim/config/parameter_docs.h"

#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/base/numbers.h"
#include "sim/config/closest_name.h"
#include "sim/config/writer.h"
#include "sim/files/markup.h"

namespace dodgesim {

namespace {

std::string group_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string in_code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string paragraph(const ParameterDoc& doc) {
  std::string text = doc.path + "\n    " + doc.doc + "\n";
  if (doc.is_group()) return text;
  text += "    " + doc.type;
  if (!doc.range.empty()) text += ", " + doc.range;
  if (!doc.default_text.empty()) text += "; default " + doc.default_text;
  return text + "\n";
}

}  // namespace

void Documenter::add(const char* key, const std::string& type, const std::string& range,
                     const std::string& default_text, const char* doc) {
  docs_.push_back({prefix_ + key, type, range, default_text, doc});
}

void Documenter::operator()(const char* key, bool& value, const char* doc) {
  add(key, "true or false", "", value ? "true" : "false", doc);
}

void Documenter::operator()(const char* key, const std::string& value,
                            std::initializer_list<const char*> allowed, const char* doc) {
  add(key, joined(allowed, {}, " or "), "", value, doc);
}

void Documenter::operator()(const char* key, const Eigen::Vector3d& value, double min, double max,
                            const char* doc) {
  add(key, "[x, y, z]", range_text(min, max), to_yaml(value), doc);
}

void Documenter::operator()(const char* key, const std::optional<Eigen::Vector3d>& value,
                            double min, double max, const char* doc) {
  add(key, "[x, y, z]", range_text(min, max), value ? to_yaml(*value) : "", doc);
}

void Documenter::operator()(const char* key, const std::vector<Eigen::Vector3d>&, double min,
                            double max, const char* doc) {
  add(key, "list of [x, y, z]", range_text(min, max), "", doc);
}

void Documenter::operator()(const char* key, const Distribution& value, double min, double max,
                            const char* doc) {
  add(key, "number or distribution", range_text(min, max), to_yaml(value), doc);
}

void Documenter::operator()(const char* key, const Components& value, double min, double max,
                            const char* doc) {
  add(key, "number or distribution, or a list of " + std::to_string(value.count),
      range_text(min, max), to_yaml(value), doc);
}

void Documenter::text(const char* key, const std::string& value, const char* doc) {
  add(key, "text", "", value, doc);
}

void Documenter::model(const char* key, const std::string& value, const char* folder,
                       const char* doc) {
  add(key, std::string("name of a file in models/") + folder, "", value, doc);
}

void Documenter::model(const char* key, const NameChoice& value, const char* folder,
                       const char* doc) {
  add(key, std::string("name of a file in models/") + folder + ", or !choice of names", "",
      to_yaml(value), doc);
}

void Documenter::varied(const char* key, const VariedKeys&, const char* doc) {
  add(key, "map of keys to lists of values", "", "", doc);
}

void Documenter::file(const char* key, const char* doc) { add(key, "file", "", "", doc); }

std::string to_markdown(const std::vector<ParameterDoc>& docs) {
  std::vector<ParameterDoc> groups = {{"", "", "", "", "Keys at the top level."}};
  for (const ParameterDoc& doc : docs) {
    if (doc.is_group()) groups.push_back(doc);
  }
  std::string text;
  for (const ParameterDoc& group : groups) {
    if (!text.empty()) text += "\n";
    text += "### " + (group.path.empty() ? "Top level" : in_code(group.path)) + "\n\n" + group.doc +
            "\n\n| key | value | range | default | meaning |\n|---|---|---|---|---|\n";
    for (const ParameterDoc& doc : docs) {
      if (group_of(doc.path) != group.path) continue;
      const std::string key = in_code(last_part(doc.path));
      if (doc.is_group()) {
        text += "| " + key + " | map | | | see " + in_code(doc.path) + " below |\n";
      } else {
        text += "| " + key + " | " + markdown_cell(doc.type) + " | " + doc.range + " | " +
                markdown_cell(in_code(doc.default_text)) + " | " + markdown_cell(doc.doc) + " |\n";
      }
    }
  }
  return text;
}

std::string explain(const std::vector<ParameterDoc>& docs, const std::string& key) {
  std::string text;
  for (const ParameterDoc& doc : docs) {
    const bool wanted = key.empty() || doc.path == key || doc.path.starts_with(key + ".");
    if (wanted) text += paragraph(doc);
  }
  if (!text.empty()) return text;
  for (const ParameterDoc& named : docs) {
    if (last_part(named.path) != key) continue;
    for (const ParameterDoc& doc : docs) {
      if (doc.path == named.path || doc.path.starts_with(named.path + ".")) text += paragraph(doc);
    }
  }
  if (!text.empty()) return text;
  std::vector<std::string> names, with_word;
  for (const ParameterDoc& doc : docs) {
    names.push_back(doc.path);
    names.push_back(last_part(doc.path));
    if (!name_with(key, {last_part(doc.path)}).empty()) with_word.push_back(doc.path);
  }
  if (!with_word.empty()) {
    throw ScenarioError("There is no key " + key + " in a scenario, but " +
                        joined(with_word, {}, " and ") + ".");
  }
  throw ScenarioError("There is no key " + key + " in a scenario" +
                      did_you_mean(closest_name(key, names)));
}

}  // namespace dodgesim
