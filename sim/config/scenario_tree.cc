#include "sim/config/scenario_tree.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "sim/base/contains.h"
#include "sim/base/names.h"
#include "sim/config/layers.h"
#include "sim/config/writer.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBases = 8;
constexpr std::size_t kMostFoldersUp = 2;
constexpr std::size_t kLongestShown = 100;
constexpr std::size_t kDeepestKey = 16;

// Follows `extends` from one file to the next.
class Bases {
 public:
  Bases(const fs::path& file, Problems& problems) : problems_(problems) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(file, error);
    chain_.push_back(error ? file : whole);
    highest_ = chain_.front().parent_path();
    for (std::size_t i = 0; i < kMostFoldersUp; ++i) highest_ = highest_.parent_path();
  }

  // `node`, which stands in `file`, laid over its bases.
  YamlNode complete(YamlNode node, const fs::path& file) {
    const std::optional<YamlNode> extends = node.take("extends");
    if (!extends) return node;
    const fs::path base = file.parent_path() / named_file(*extends);
    chain_.push_back(checked(base, *extends));
    const int source = problems_.add_source(base.lexically_normal().string());
    YamlNode below = parse_yaml(read_scenario_text(base.string()), problems_, source);
    below = complete(std::move(below), base);
    for (const char* own : {"name", "description"}) below.take(own);
    lay_over(below, node);
    return below;
  }

 private:
  [[noreturn]] void refuse(const YamlNode& extends, const std::string& complaint) {
    problems_.fail(extends.at,
                   "extends is " + in_quotes(extends.text) + ", but " + complaint + ".");
  }

  fs::path named_file(const YamlNode& extends) {
    if (extends.kind != YamlNode::Kind::kScalar || !extends.tag.empty()) {
      problems_.fail(extends.at, "extends is " + to_text(extends) +
                                     ", but must be the name of a scenario's file.");
    }
    fs::path name = extends.text;
    if (name.is_absolute()) refuse(extends, "must be relative to the folder of this file");
    if (name.extension() != ".yaml" && name.extension() != ".yml") {
      refuse(extends, "must end in .yaml or .yml");
    }
    return name;
  }

  // The path of a base without links, if it may be read.
  fs::path checked(const fs::path& base, const YamlNode& extends) {
    std::error_code error;
    fs::path path = fs::canonical(base, error);
    if (error || !fs::is_regular_file(path, error)) refuse(extends, "there is no such file");
    if (!is_below(path, highest_)) {
      refuse(extends,
             "leads more than " + std::to_string(kMostFoldersUp) + " folders up from the scenario");
    }
    if (contains(chain_, path)) {
      refuse(extends, "leads back to where it came from");
    }
    if (chain_.size() > kMostBases) {
      refuse(extends, "this is base number " + std::to_string(kMostBases + 1) + " in a row; " +
                          std::to_string(kMostBases) + " are enough");
    }
    return path;
  }

  Problems& problems_;
  std::vector<fs::path> chain_;
  fs::path highest_;
};

void apply(const Setting& setting, YamlNode& root, Problems& problems) {
  std::string shown = setting.shown.substr(0, kLongestShown);
  if (shown.size() < setting.shown.size()) shown += "...";
  const int source = problems.add_source(shown);
  const auto depth = std::ranges::count(setting.key, '.');
  if (setting.key.empty() || static_cast<std::size_t>(depth) >= kDeepestKey) {
    problems.fail({0, 0, source}, "A key is needed before =, such as throw.speed_mps.");
  }
  if (setting.key == "extends") {
    problems.fail({0, 0, source}, "extends can stand in a file only.");
  }
  set_value(root, setting.key, parse_yaml_value(setting.value, problems, source));
}

}  // namespace

YamlNode scenario_tree(const std::string& text, const std::string& file,
                       const std::vector<Setting>& settings, Problems& problems) {
  YamlNode root = Bases(file, problems).complete(parse_yaml(text, problems), file);
  for (const Setting& setting : settings) apply(setting, root, problems);
  return root;
}

}  // namespace dodgesim
