// Reader: what is said of keys that are none.

#include "sim/base/contains.h"
#include "sim/base/joined.h"
#include "sim/base/utf8.h"
#include "sim/config/closest_name.h"
#include "sim/config/reader.h"

namespace dodgesim {

namespace {

constexpr std::size_t kLongestValue = 60;  // that is repeated in a message

// "throw: {size_m: 0.2}" of throw.size_m.
std::string nested(const std::string& dotted_key, const YamlNode& value) {
  const std::string text = to_text(value);
  std::string before, after;
  for (const char c : dotted_key) {
    before += c == '.' ? ": {" : std::string(1, c);
    if (c == '.') after += '}';
  }
  return before + ": " + (text.size() > kLongestValue ? "..." : text) + after;
}

// Of a name that may look like a known one.
std::string strange_character(const std::string& name) {
  const std::string character = beyond_ascii(name);
  return character.empty() ? "" : " (it has the character " + character + ")";
}

}  // namespace

// What the user may have meant by a key that is none.
std::string Reader::hint(const std::string& unknown_key, const YamlNode& value) const {
  const auto& all = context_.all_keys;
  if (contains(all, full(unknown_key))) {
    return "; write " + nested(unknown_key, value) + " or use --set " + full(unknown_key) +
           "=VALUE.";
  }
  const std::string longer = name_with(unknown_key, known_);
  if (!longer.empty()) return did_you_mean(full(longer));
  std::vector<std::string> elsewhere, below;
  for (const std::string& path : context_.all_keys) {
    if (last_part(path) == unknown_key) elsewhere.push_back(path);
    if (path.starts_with(full(""))) below.push_back(path);
  }
  if (!elsewhere.empty()) {
    return "; " + joined(elsewhere, {}, " and ") + (elsewhere.size() == 1 ? " is." : " are.");
  }
  const std::string near = closest_name(unknown_key, known_);
  if (!near.empty()) return did_you_mean(full(near));
  return did_you_mean(closest_key(unknown_key, below));
}

void Reader::finish() {
  for (std::size_t i = 0; i < map_.keys.size(); ++i) {
    const YamlNode::Key& key = map_.keys[i];
    if (contains(known_, key.name)) continue;
    if (key.name == "<<") continue;  // already a problem of the parser
    context_.problems.add(key.at, full(key.name) + " is not a known key" +
                                      strange_character(key.name) + hint(key.name, map_.items[i]));
  }
}

}  // namespace dodgesim
