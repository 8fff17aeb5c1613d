#include "sim/config/writer.h"

#include "sim/base/formatted.h"
#include "sim/base/joined.h"

namespace dodgesim {

namespace {

constexpr std::size_t kIndent = 2;

std::string list(const std::vector<std::string>& items) { return "[" + joined(items) + "]"; }

std::string list(const std::vector<double>& values) {
  return "[" + joined(values, [](double value) { return to_text(value); }) + "]";
}

// Names of models are letters, digits, _ and -, but YAML reads some of those as something else.
std::string name_text(const std::string& name) {
  const bool letter = (name[0] >= 'a' && name[0] <= 'z') || (name[0] >= 'A' && name[0] <= 'Z');
  const bool null = name == "null" || name == "Null" || name == "NULL";
  return letter && !null ? name : in_quotes(name);
}

// A character within quotes; one of the control characters as \x07.
std::string quoted_character(char c) {
  const bool control = (c >= 0 && c < 0x20) || c == 0x7f;
  if (!control) return {c};
  return formatted("\\x%02x", static_cast<unsigned>(c));
}

}  // namespace

std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
      case '\\':
        quoted += '\\';
        quoted += c;
        break;
      case '\n':
        quoted += "\\n";
        break;
      case '\r':
        quoted += "\\r";
        break;
      case '\t':
        quoted += "\\t";
        break;
      default:
        quoted += quoted_character(c);
    }
  }
  return quoted + "\"";
}

std::string to_yaml(const Distribution& distribution) {
  const std::vector<double>& values = distribution.values;
  switch (distribution.kind) {
    case Distribution::Kind::kConstant:
      return to_text(values[0]);
    case Distribution::Kind::kUniform:
      return "!uniform " + list(values);
    case Distribution::Kind::kChoice:
      return "!choice " + list(values);
    case Distribution::Kind::kNormal:
      break;
  }
  return "!normal {mean: " + to_text(values[0]) + ", sd: " + to_text(values[1]) +
         ", min: " + to_text(distribution.lo) + ", max: " + to_text(distribution.hi) + "}";
}

std::string to_yaml(const Components& components) {
  if (components.parts.size() == 1) return to_yaml(components.parts[0]);
  std::vector<std::string> items;
  for (const Distribution& part : components.parts) items.push_back(to_yaml(part));
  return list(items);
}

std::string to_yaml(const NameChoice& choice) {
  if (choice.names.size() == 1) return name_text(choice.names[0]);
  std::vector<std::string> items;
  for (const std::string& name : choice.names) items.push_back(name_text(name));
  return "!choice " + list(items);
}

std::string to_yaml(const Eigen::Vector3d& vector) {
  return list(std::vector<double>{vector.x(), vector.y(), vector.z()});
}

void Writer::line(const char* key, const std::string& value) {
  yaml_.append(kIndent * static_cast<std::size_t>(level_), ' ');
  if (item_) yaml_.replace(yaml_.size() - kIndent, kIndent, "- ");
  item_ = false;
  yaml_ += key;
  yaml_ += ":";
  if (!value.empty()) yaml_ += " " + value;
  yaml_ += "\n";
}

void Writer::operator()(const char* key, const std::vector<Eigen::Vector3d>& value, double, double,
                        const char*) {
  if (value.empty()) return;
  std::vector<std::string> items;
  items.reserve(value.size());
  for (const Eigen::Vector3d& vector : value) items.push_back(to_yaml(vector));
  line(key, list(items));
}

void Writer::varied(const char* key, const VariedKeys& axes, const char*) {
  if (axes.empty()) return;
  line(key, "");
  ++level_;
  for (const VariedKey& axis : axes) {
    std::vector<std::string> values;
    for (const YamlNode& value : axis.values) values.push_back(to_text(value));
    line(axis.key.c_str(), list(values));
  }
  --level_;
}

}  // namespace dodgesim
