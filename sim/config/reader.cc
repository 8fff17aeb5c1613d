#include "sim/config/reader.h"

#include <cmath>
#include <filesystem>
#include <type_traits>

#include "sim/base/contains.h"
#include "sim/base/joined.h"
#include "sim/base/names.h"
#include "sim/base/numbers.h"
#include "sim/base/utf8.h"
#include "sim/config/closest_name.h"
#include "sim/config/writer.h"

namespace dodgesim {

namespace {

using Kind = YamlNode::Kind;

constexpr std::size_t kLongestQuote = 60;  // of the user's text in a message

std::string quote(const std::string& text) {
  const std::string strange = beyond_ascii(text);
  const std::string behind = strange.empty() ? "" : " (with the character " + strange + ")";
  if (text.size() <= kLongestQuote) return in_quotes(text) + behind;
  std::size_t end = kLongestQuote;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80) --end;  // whole UTF-8
  return in_quotes(text.substr(0, end) + "...") + behind;
}

// "{mean: 3, sd: 1}", if it is short.
std::string describe_map(const YamlNode& node) {
  std::string text;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (node.items[i].kind != Kind::kScalar || text.size() > kLongestQuote) return "a map";
    text += (i > 0 ? ", " : "") + node.keys[i].name + ": " + node.items[i].text;
  }
  return text.size() > kLongestQuote ? "a map" : "{" + text + "}";
}

// What the user wrote, for "throw.size_m is <this>, but must be ...".
std::string describe(const YamlNode& node) {
  const std::string tag = node.tag.empty() ? "" : node.tag + " ";
  switch (node.kind) {
    case Kind::kNull:
      return tag + "empty";
    case Kind::kSequence:
      return (tag.empty() ? "" : tag + "with ") +
             (node.items.empty() ? "an empty list"
                                 : "a list of " + std::to_string(node.items.size()));
    case Kind::kMap:
      return tag.empty() ? "a map" : tag + describe_map(node);
    case Kind::kScalar:
      break;
  }
  const bool number = !node.quoted && node.text.size() <= kLongestQuote &&
                      number_form(node.text) != NumberForm::kNone;
  return tag + (number ? node.text : quote(node.text));
}

template <class Number>
std::string range_text(Number min, Number max) {
  return "between " + to_text(min) + " and " + to_text(max);
}

template <class Number>
std::optional<Number> parse_number(const std::string& text) {
  if constexpr (std::is_same_v<Number, double>) {
    return parse_double(text);
  } else {
    return parse_integer<Number>(text);
  }
}

}  // namespace

const YamlNode* Reader::take(const char* key) {
  known_.emplace_back(key);
  const YamlNode* node = map_.find(key);
  if (node != nullptr && node->taken_away) return nullptr;
  if (node != nullptr) context_.where[full(key)] = node->at;
  return node;
}

const YamlNode* Reader::take_map(const char* key) {
  const YamlNode* node = take(key);
  return node != nullptr && is_map(*node, full(key)) ? node : nullptr;
}

bool Reader::is_map(const YamlNode& node, const std::string& name) {
  if (node.kind == Kind::kMap && node.tag.empty()) return true;
  return refuse(node, name, "must be a map of keys");
}

const YamlNode* Reader::take_list(const char* key, const char* wanted, std::size_t most) {
  const YamlNode* node = take(key);
  if (node == nullptr) return nullptr;
  if (node->kind == Kind::kSequence && node->tag.empty() && !node->items.empty() &&
      node->items.size() <= most) {
    return node;
  }
  problem(*node, full(key),
          std::string("must be ") + wanted + ", 1 to " + std::to_string(most) + " of them");
  return nullptr;
}

void Reader::problem(const YamlNode& node, const std::string& name, const std::string& complaint) {
  if (node.alias) return;
  context_.problems.add(node.at, name + " is " + describe(node) + ", but " + complaint + ".");
}

template <class Number>
bool Reader::read_number(const YamlNode& node, const std::string& name, Number& value, Number min,
                         Number max) {
  const bool whole = !std::is_same_v<Number, double>;
  const std::string range = range_text(min, max);
  const std::string wanted =
      std::string("must be a ") + (whole ? "whole " : "") + "number " + range;
  if (node.kind != Kind::kScalar || node.quoted || !node.tag.empty()) {
    return refuse(node, name, wanted);
  }
  switch (number_form(node.text)) {
    case NumberForm::kNone:
      return refuse(node, name, wanted);
    case NumberForm::kNotFinite:
      return refuse(node, name, wanted + " (it must be finite)");
    case NumberForm::kLeadingZero:
      return refuse(node, name,
                    wanted + " without leading zeros (some readers take them as octal)");
    case NumberForm::kDecimal:
      if (whole) return refuse(node, name, wanted);
      break;
    case NumberForm::kInteger:
      break;
  }
  const std::optional<Number> parsed = parse_number<Number>(node.text);
  if (!parsed || *parsed < min || *parsed > max) return refuse(node, name, "must be " + range);
  // What is divided by less would not be finite.
  if constexpr (std::is_same_v<Number, double>) {
    if (*parsed != 0 && std::abs(*parsed) < 1e-300) {
      return refuse(node, name, "must be 0 or at least 1e-300");
    }
  }
  value = *parsed;
  return true;
}

template bool Reader::read_number(const YamlNode&, const std::string&, double&, double, double);
template bool Reader::read_number(const YamlNode&, const std::string&, int&, int, int);
template bool Reader::read_number(const YamlNode&, const std::string&, std::int64_t&, std::int64_t,
                                  std::int64_t);
template bool Reader::read_number(const YamlNode&, const std::string&, std::uint64_t&,
                                  std::uint64_t, std::uint64_t);

void Reader::operator()(const char* key, bool& value, const char*) {
  const YamlNode* node = take(key);
  if (node == nullptr) return;
  const bool plain = node->kind == Kind::kScalar && !node->quoted && node->tag.empty();
  if (!plain || (node->text != "true" && node->text != "false")) {
    return problem(*node, full(key), "must be true or false");
  }
  value = node->text == "true";
}

void Reader::operator()(const char* key, std::string& value,
                        std::initializer_list<const char*> allowed, const char*) {
  const YamlNode* node = take(key);
  if (node == nullptr) return;
  const std::vector<std::string> names(allowed.begin(), allowed.end());
  const bool text = node->kind == Kind::kScalar && node->tag.empty();
  if (text && contains(names, node->text)) {
    value = node->text;
    return;
  }
  std::string wanted = "must be " + joined(names, {}, " or ");
  const std::string near = text ? closest_name(node->text, names) : "";
  if (!near.empty()) wanted += " (did you mean " + near + "?)";
  problem(*node, full(key), wanted);
}

bool Reader::read_vector(const YamlNode& node, const std::string& name, Eigen::Vector3d& value,
                         double min, double max) {
  if (node.kind != Kind::kSequence || !node.tag.empty() || node.items.size() != 3) {
    return refuse(node, name, "must be [x, y, z], each a number " + range_text(min, max));
  }
  bool read = true;
  for (int i = 0; i < 3; ++i) {
    const YamlNode& item = node.items[static_cast<std::size_t>(i)];
    read = read_number(item, name + "[" + std::to_string(i) + "]", value[i], min, max) && read;
  }
  return read;
}

void Reader::operator()(const char* key, Eigen::Vector3d& value, double min, double max,
                        const char*) {
  if (const YamlNode* node = take(key)) read_vector(*node, full(key), value, min, max);
}

void Reader::operator()(const char* key, std::optional<Eigen::Vector3d>& value, double min,
                        double max, const char*) {
  const YamlNode* node = take(key);
  if (node == nullptr) return;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  if (read_vector(*node, full(key), vector, min, max)) value = vector;
}

void Reader::operator()(const char* key, std::vector<Eigen::Vector3d>& value, double min,
                        double max, const char*) {
  const YamlNode* list = take_list(key, "a list of [x, y, z]", kMostPoints);
  if (list == nullptr) return;
  value.assign(list->items.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < value.size(); ++i) {
    read_vector(list->items[i], full(key) + "[" + std::to_string(i) + "]", value[i], min, max);
  }
}

void Reader::operator()(const char* key, std::vector<double>& value, double min, double max,
                        const char*) {
  const YamlNode* list = take_list(key, "a list of numbers", kMostPoints);
  if (list != nullptr) read_numbers(*list, full(key), value, min, max);
}

namespace {

// The keys of !normal.
struct NormalKeys {
  double mean, sd, min, max;
  double key_min, key_max;

  template <class Visitor>
  void visit(Visitor& v) {
    v("mean", mean, key_min, key_max, "");
    v("sd", sd, 1e-12, key_max - key_min, "");
    v("min", min, key_min, key_max, "");
    v("max", max, key_min, key_max, "");
  }
};

}  // namespace

bool Reader::read_distribution(const YamlNode& node, const std::string& name, Distribution& value,
                               double min, double max) {
  if (node.tag == "!uniform") return read_uniform(node, name, value, min, max);
  if (node.tag == "!normal") return read_normal(node, name, value, min, max);
  if (node.tag == "!choice") return read_choice(node, name, value, min, max);
  if (!node.tag.empty() || node.kind != Kind::kScalar) {
    return refuse(node, name,
                  "must be a number " + range_text(min, max) +
                      ", !uniform [lowest, highest], !normal {mean, sd} or !choice [a, b, ...]");
  }
  double number = 0;
  if (!read_number(node, name, number, min, max)) return false;
  value = Distribution::constant(number);
  return true;
}

bool Reader::read_uniform(const YamlNode& node, const std::string& name, Distribution& value,
                          double min, double max) {
  if (node.kind != Kind::kSequence || node.items.size() != 2) {
    return refuse(node, name,
                  "must be !uniform [lowest, highest], each a number " + range_text(min, max));
  }
  std::vector<double> ends;
  if (!read_numbers(node, name, ends, min, max)) return false;
  if (ends[0] > ends[1]) {
    return refuse(node.items[0], name + "[0]",
                  "the lowest value must come first and be at most " + to_text(ends[1]));
  }
  value = Distribution::uniform(ends[0], ends[1]);
  return true;
}

bool Reader::read_normal(const YamlNode& node, const std::string& name, Distribution& value,
                         double min, double max) {
  if (node.kind != Kind::kMap || node.find("mean") == nullptr || node.find("sd") == nullptr) {
    return refuse(node, name, "must be !normal {mean: a, sd: b}, optionally with min and max");
  }
  NormalKeys keys{min, 1, min, max, min, max};
  read_nested(last_part(name), node, keys);
  if (keys.min >= keys.max || keys.mean < keys.min || keys.mean > keys.max) {
    return refuse(node, name, "must have min < max and its mean between them");
  }
  value = Distribution::normal(keys.mean, keys.sd, keys.min, keys.max);
  return true;
}

bool Reader::read_choice(const YamlNode& node, const std::string& name, Distribution& value,
                         double min, double max) {
  if (node.kind != Kind::kSequence || node.items.empty()) {
    return refuse(node, name, "must be !choice [a, b, ...], each a number " + range_text(min, max));
  }
  std::vector<double> values;
  if (!read_numbers(node, name, values, min, max)) return false;
  value = Distribution::choice(values);
  return true;
}

bool Reader::read_numbers(const YamlNode& list, const std::string& name,
                          std::vector<double>& values, double min, double max) {
  values.resize(list.items.size());
  bool read = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string item = name + "[" + std::to_string(i) + "]";
    read = read_number(list.items[i], item, values[i], min, max) && read;
  }
  return read;
}

void Reader::operator()(const char* key, Distribution& value, double min, double max, const char*) {
  if (const YamlNode* node = take(key)) read_distribution(*node, full(key), value, min, max);
}

void Reader::operator()(const char* key, Components& value, double min, double max, const char*) {
  const YamlNode* node = take(key);
  if (node == nullptr) return;
  if (node->kind != Kind::kSequence || !node->tag.empty()) {
    Distribution all;
    if (read_distribution(*node, full(key), all, min, max)) value.parts = {all};
    return;
  }
  const auto count = static_cast<std::size_t>(value.count);
  if (node->items.size() != count) {
    return problem(*node, full(key),
                   "must be one number or distribution, or a list of " + std::to_string(count));
  }
  std::vector<Distribution> parts(count);
  for (std::size_t i = 0; i < count; ++i) {
    read_distribution(node->items[i], full(key) + "[" + std::to_string(i) + "]", parts[i], min,
                      max);
  }
  value.parts = parts;
}

void Reader::text(const char* key, std::string& value, const char*) {
  const YamlNode* node = take(key);
  if (node == nullptr) return;
  if (node->kind != Kind::kScalar || !node->tag.empty()) {
    return problem(*node, full(key), "must be text");
  }
  value = node->text;
}

bool Reader::read_model(const YamlNode& node, const std::string& name, const char* folder,
                        std::string& value) {
  // Only a plain name: a path could lead out of the folder of models.
  if (node.kind != Kind::kScalar || !node.tag.empty() || !is_plain_name(node.text)) {
    return refuse(node, name,
                  std::string("must be the name of a file in models/") + folder +
                      " without .xml (letters, digits, _ and -)");
  }
  if (!context_.models_dir.empty()) {
    const std::filesystem::path file =
        std::filesystem::path(context_.models_dir) / folder / (node.text + ".xml");
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
      const std::vector<std::string> models = models_in(file.parent_path());
      const std::string near = closest_name(node.text, models);
      return refuse(node, name,
                    "there is no model file " + file.string() +
                        (models.empty() ? ", and no other in that folder: --models or "
                                          "DODGESIM_MODELS names the one of models"
                         : near.empty() ? " (there are " + joined(models) + ")"
                                        : " (did you mean " + near + "?)"));
    }
  }
  value = node.text;
  return true;
}

void Reader::model(const char* key, std::string& value, const char* folder, const char*) {
  if (const YamlNode* node = take(key)) read_model(*node, full(key), folder, value);
}

void Reader::model(const char* key, NameChoice& value, const char* folder, const char*) {
  const YamlNode* node = take(key);
  if (node == nullptr) return;
  std::vector<std::string> names(1);
  if (node->tag == "!choice" && node->kind == Kind::kSequence && !node->items.empty()) {
    names.resize(node->items.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string name = full(key) + "[" + std::to_string(i) + "]";
      if (!read_model(node->items[i], name, folder, names[i])) return;
    }
  } else if (node->kind != Kind::kScalar || !node->tag.empty()) {
    return problem(*node, full(key),
                   std::string("must be the name of a file in models/") + folder +
                       " without .xml, or !choice [a, b, ...] of such names");
  } else if (!read_model(*node, full(key), folder, names[0])) {
    return;
  }
  value.names = names;
}

}  // namespace dodgesim
