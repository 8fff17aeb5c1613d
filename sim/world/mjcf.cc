#include "sim/world/mjcf.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/base/names.h"

namespace dodgesim {

namespace {

constexpr std::uintmax_t kMaxModelBytes = 1 << 20;
constexpr std::uintmax_t kMaxAssetBytes = 32 << 20;
constexpr std::ptrdiff_t kMaxAttributes = 20000;  // tinyxml2 compares those of an element pairwise

[[noreturn]] void fail(const std::string& label, int line, const std::string& what) {
  throw ScenarioError(label + ":" + std::to_string(line) + ": " + what);
}

std::vector<MjcfTag::Attribute> attributes_of(const tinyxml2::XMLElement& element,
                                              const std::string& label) {
  std::vector<MjcfTag::Attribute> attributes;
  for (const auto* each = element.FirstAttribute(); each != nullptr; each = each->Next()) {
    const std::string name = each->Name(), value = each->Value();
    // Entities would let a value mean something else than what is checked here.
    if (value.find_first_of("<&\"") != std::string::npos) {
      fail(label, each->GetLineNum(),
           "The value of '" + name + "' holds a character that model files must not use.");
    }
    attributes.emplace_back(name, value);
  }
  return attributes;
}

// As deep as tinyxml2 reads: 100 elements.
void add_tags(const tinyxml2::XMLNode& parent, const std::string& label,
              std::vector<MjcfTag>& tags) {
  for (const auto* node = parent.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr || node->ToDeclaration() != nullptr) continue;
    const tinyxml2::XMLElement* element = node->ToElement();
    if (element == nullptr) {
      fail(label, node->GetLineNum(), "A model file holds elements and comments, nothing else.");
    }
    const bool closed = element->ClosingType() == tinyxml2::XMLElement::CLOSED;
    tags.push_back({closed ? MjcfTag::Kind::kSelfClose : MjcfTag::Kind::kOpen,
                    element->GetLineNum(), element->Name(), attributes_of(*element, label)});
    if (closed) continue;
    add_tags(*element, label, tags);
    tags.push_back({MjcfTag::Kind::kClose, tags.back().line, element->Name(), {}});
  }
}

// A path stays inside the models folder if it is relative and never goes up.
bool leaves_folder(const std::string& path) {
  const std::filesystem::path p(path);
  return p.is_absolute() || path.find('\\') != std::string::npos ||
         contains(p, std::filesystem::path(".."));
}

// Neither may a link lead out of it.
bool is_inside(const std::string& path, const std::string& directory) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(path, error);
  const std::filesystem::path folder = std::filesystem::canonical(directory, error);
  return !error && is_below(file, folder);
}

// <compiler> could move the folders of assets, and change the meaning of angles in other files.
void check_paths(const std::vector<MjcfTag>& tags, const std::string& directory,
                 const std::string& label) {
  for (const MjcfTag& tag : tags) {
    const std::string where = label + ":" + std::to_string(tag.line) + ": ";
    if (tag.name == "include" || tag.name == "compiler") {
      throw ScenarioError(where + "A model file must not use <" + tag.name + ">.");
    }
    for (const auto& [name, value] : tag.attributes) {
      if (name.compare(0, 4, "file") != 0) continue;
      if (leaves_folder(value)) {
        throw ScenarioError(where + "The path '" + value + "' leaves the models folder.");
      }
      std::error_code error;
      if (!std::filesystem::is_regular_file(directory + "/" + value, error)) {
        throw ScenarioError(where + "The file " + directory + "/" + value + " does not exist.");
      }
      if (!is_inside(directory + "/" + value, directory)) {
        throw ScenarioError(where + "The path '" + value + "' leaves the models folder.");
      }
      if (std::filesystem::file_size(directory + "/" + value, error) > kMaxAssetBytes && !error) {
        throw ScenarioError(where + "The file " + directory + "/" + value +
                            " is larger than 32 MB.");
      }
    }
  }
}

bool is_numeric(const MjcfTag& tag, const std::string& name) {
  const std::string* tag_name = tag.find("name");
  return tag.name == "numeric" && tag_name && *tag_name == name;
}

std::string print_numbers(const std::vector<double>& numbers) {
  std::ostringstream out;
  out.precision(17);
  for (std::size_t i = 0; i < numbers.size(); ++i) out << (i ? " " : "") << numbers[i];
  return out.str();
}

}  // namespace

const std::string* MjcfTag::find(const std::string& attribute) const {
  for (const auto& [name, value] : attributes) {
    if (name == attribute) return &value;
  }
  return nullptr;
}

std::vector<MjcfTag> parse_mjcf(const std::string& text, const std::string& label) {
  if (text.find('\0') != std::string::npos) fail(label, 1, "The model holds a zero byte.");
  if (std::ranges::count(text, '=') > kMaxAttributes) {
    fail(label, 1, "The model has more than " + std::to_string(kMaxAttributes) + " attributes.");
  }
  tinyxml2::XMLDocument document(false);  // entities stay as they are, to be refused
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    fail(label, std::max(1, document.ErrorLineNum()),
         std::string("The model is not valid XML (") + document.ErrorName() + ").");
  }
  std::vector<MjcfTag> tags;
  add_tags(document, label, tags);
  return tags;
}

std::string print_mjcf(const std::vector<MjcfTag>& tags) {
  std::string out;
  int line = 1;
  for (const MjcfTag& tag : tags) {
    for (; line < tag.line; ++line) out += '\n';
    out += tag.kind == MjcfTag::Kind::kClose ? "</" : "<";
    out += tag.name;
    for (const auto& [name, value] : tag.attributes) out += " " + name + "=\"" + value + "\"";
    out += tag.kind == MjcfTag::Kind::kSelfClose ? "/>" : ">";
  }
  return out;
}

std::vector<double> parse_numbers(const std::string& text, const std::string& label) {
  std::vector<double> numbers;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(number)) {
      throw ScenarioError(label + ": '" + word + "' is not a finite number.");
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<MjcfTag> read_model_file(const std::string& directory, const std::string& file) {
  const std::string path = directory + "/" + file;
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error)) {
    throw ScenarioError("There is no folder of models " + directory +
                        " (--models, DODGESIM_MODELS).");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw ScenarioError("The model file " + path + " does not exist.");
  }
  if (std::filesystem::file_size(path, error) > kMaxModelBytes && !error) {
    throw ScenarioError("The model file " + path + " is larger than 1 MB.");
  }
  std::vector<MjcfTag> tags = parse_mjcf(read_file(path), path);
  if (tags.size() < 2 || tags.front().name != "mujoco" || tags.back().name != "mujoco" ||
      tags.front().kind != MjcfTag::Kind::kOpen || tags.back().kind != MjcfTag::Kind::kClose) {
    throw ScenarioError(path + ": the model file must hold one <mujoco> element.");
  }
  check_paths(tags, directory, path);
  return {tags.begin() + 1, tags.end() - 1};
}

double find_numeric(const std::vector<MjcfTag>& tags, const std::string& name,
                    const std::string& label) {
  for (const MjcfTag& tag : tags) {
    if (!is_numeric(tag, name)) continue;
    const std::string* data = tag.find("data");
    const std::vector<double> numbers = parse_numbers(data ? *data : "", label);
    if (numbers.size() == 1) return numbers[0];
  }
  throw ScenarioError(label + ": the model must have <numeric name=\"" + name +
                      "\"> with one number.");
}

void prefix_names(std::vector<MjcfTag>& tags, const std::string& prefix) {
  constexpr std::array<const char*, 4> kNames = {"name", "material", "texture", "mesh"};
  for (MjcfTag& tag : tags) {
    const std::string* file = tag.find("file");
    if ((tag.name == "mesh" || tag.name == "texture") && file && !tag.find("name")) {
      tag.attributes.emplace_back("name", std::filesystem::path(*file).stem().string());
    }
    for (auto& [name, value] : tag.attributes) {
      if (contains(kNames, name)) value = prefix + value;
    }
  }
}

void scale_body(std::vector<MjcfTag>& tags, double scale, double mass_exponent,
                const std::string& label) {
  for (MjcfTag& tag : tags) {
    if (tag.kind == MjcfTag::Kind::kClose) continue;
    if (tag.name == "mesh" && !tag.find("scale")) tag.attributes.emplace_back("scale", "1 1 1");
    const bool is_length_tag = tag.name == "geom" || tag.name == "site" || tag.name == "body" ||
                               tag.name == "camera" || tag.name == "inertial";
    for (auto& [name, value] : tag.attributes) {
      double factor = 1;
      if (is_length_tag && (name == "pos" || name == "size" || name == "fromto")) factor = scale;
      if (tag.name == "mesh" && name == "scale") factor = scale;
      if (is_numeric(tag, "frontal_area_m2") && name == "data") factor = scale * scale;
      if (tag.name == "inertial" && name == "mass") factor = std::pow(scale, mass_exponent);
      if (tag.name == "inertial" && (name == "diaginertia" || name == "fullinertia")) {
        factor = std::pow(scale, mass_exponent + 2);
      }
      if (factor == 1) continue;
      std::vector<double> numbers = parse_numbers(value, label);
      for (double& number : numbers) number *= factor;
      value = print_numbers(numbers);
    }
  }
}

}  // namespace dodgesim
