// Model files as lists of tags: enough to put several of them together into one, with names kept
// apart and objects scaled. MuJoCo 2.2.2 itself can only include a file once.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dodgesim {

// An opening, closing or self-closing tag. MJCF has no text between tags.
struct MjcfTag {
  enum class Kind { kOpen, kClose, kSelfClose };
  using Attribute = std::pair<std::string, std::string>;  // name and value

  Kind kind = Kind::kOpen;
  int line = 1;  // in its file; of a closing tag, that of the tag before it
  std::string name;
  std::vector<Attribute> attributes;

  const std::string* find(const std::string& attribute) const;
};

// The tags of `text` in order, without comments and the XML declaration. `label` names the file in
// errors. Throws ScenarioError, naming file and line, when the text is not valid XML, is more than
// 100 elements deep, or holds text, entities or a DOCTYPE.
std::vector<MjcfTag> parse_mjcf(const std::string& text, const std::string& label);
// Elements begin on the lines that they had, so that MuJoCo's messages name lines of the file.
std::string print_mjcf(const std::vector<MjcfTag>& tags);

// Numbers separated by blanks. Throws ScenarioError if one is not a finite number.
std::vector<double> parse_numbers(const std::string& text, const std::string& label);

// Reads the model file `directory`/`file` and returns what is inside its <mujoco> element.
// Asset paths are relative to `directory`. Throws ScenarioError, naming the file, when it is
// missing, too large, not MJCF, uses <include> or <compiler>, or names an asset that does not
// exist, lies outside `directory` or is larger than any model needs.
std::vector<MjcfTag> read_model_file(const std::string& directory, const std::string& file);

// Value of <numeric name=`name`>. Throws ScenarioError, naming `label`, when it is absent.
double find_numeric(const std::vector<MjcfTag>& tags, const std::string& name,
                    const std::string& label);

// Puts `prefix` before every name and reference to a name. A mesh or texture without a name has, as
// for MuJoCo, that of its file.
void prefix_names(std::vector<MjcfTag>& tags, const std::string& prefix);

// Scales a body: lengths by `scale`, mass by scale^mass_exponent, inertia by
// scale^(mass_exponent+2).
void scale_body(std::vector<MjcfTag>& tags, double scale, double mass_exponent,
                const std::string& label);

}  // namespace dodgesim
