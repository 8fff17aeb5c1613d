#include "sim/config/yaml_tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/names.h"
#include "sim/base/utf8.h"
#include "sim/config/writer.h"

namespace dodgesim {

namespace {

constexpr std::size_t kMostBytes = 256 * 1024;  // a long scenario has 10 kB
constexpr std::size_t kDeepest = 16;

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// What yaml-cpp makes of !! in front of a tag.
constexpr std::string_view kYamlTags = "tag:yaml.org,2002:";

// What the positions of a text say.
struct Place {
  int source = 0;
  bool lines = true;  // whether they name line and column
  std::size_t most_values = kMostValues;

  Position whole() const { return {0, 0, source}; }
  Position at(const YAML::Mark& mark) const {
    return lines && !mark.is_null() ? Position{mark.line + 1, mark.column + 1, source} : whole();
  }
};

// Whether the value that begins there is a null that was written, not one that is missing.
bool says_null(std::string_view text) {
  for (const std::string_view word : {"~", "null", "Null", "NULL"}) {
    if (!text.starts_with(word)) continue;
    const std::string_view rest = text.substr(word.size());
    return rest.empty() || !is_name_character(rest.front());
  }
  return false;
}

// Raised inside yaml-cpp's parser to leave it; never seen by the caller.
struct Stop {
  Position at;
  std::string sentence;
};

class TreeBuilder : public YAML::EventHandler {
 public:
  // `text` is what is parsed, and outlives this.
  TreeBuilder(std::string_view text, Problems& problems, const Place& place)
      : text_(text), problems_(problems), place_(place) {}

  YamlNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode node = make(YamlNode::Kind::kNull, mark, "", anchor);
    const std::size_t begin = mark.is_null() ? text_.size() : static_cast<std::size_t>(mark.pos);
    node.taken_away = says_null(text_.substr(std::min(begin, text_.size())));
    add(std::move(node));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    problems_.add(position(mark), "Aliases (*name) are not supported; write the value out.");
    YamlNode node = make(YamlNode::Kind::kNull, mark, "", 0);
    node.alias = true;
    add(std::move(node));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    // yaml-cpp marks a plain scalar "?" and a quoted one "!".
    YamlNode node =
        make(YamlNode::Kind::kScalar, mark, tag == "?" || tag == "!" ? "" : tag, anchor);
    node.quoted = tag == "!";
    node.text = value;
    add(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(YamlNode::Kind::kSequence, mark, tag == "?" ? "" : tag, anchor));
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(make(YamlNode::Kind::kMap, mark, tag == "?" ? "" : tag, anchor));
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlNode node;
    bool expects_value = false;  // a key of this map has been read, its value not yet
  };

  YamlNode make(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
                YAML::anchor_t anchor) {
    if (++nodes_ > place_.most_values) {
      throw Stop{position(mark), "There are more than " + std::to_string(place_.most_values) +
                                     " values, which no such file needs."};
    }
    if (anchor != 0) {
      problems_.add(position(mark), "Anchors (&name) are not supported; write the value out.");
    }
    YamlNode node;
    node.kind = kind;
    node.at = position(mark);
    node.tag = tag.starts_with(kYamlTags) ? "!!" + tag.substr(kYamlTags.size()) : tag;
    return node;
  }

  void open(YamlNode node) {
    if (!open_.empty()) require_key_if_due(node);
    if (open_.size() >= kDeepest) {
      throw Stop{node.at, "This is nested more than " + std::to_string(kDeepest) +
                              " levels deep, which no such file needs."};
    }
    open_.push_back({std::move(node)});
  }

  void close() {
    YamlNode node = std::move(open_.back().node);
    open_.pop_back();
    place(std::move(node));
  }

  void add(YamlNode node) {
    if (!open_.empty() && open_.back().node.kind == YamlNode::Kind::kMap &&
        !open_.back().expects_value) {
      add_key(node);
    } else {
      place(std::move(node));
    }
  }

  void require_key_if_due(const YamlNode& node) {
    const Open& top = open_.back();
    if (top.node.kind == YamlNode::Kind::kMap && !top.expects_value) {
      throw Stop{node.at,
                 "A key must be a plain word, not a list or a map; or a bracket is not closed."};
    }
  }

  void add_key(const YamlNode& node) {
    if (node.kind != YamlNode::Kind::kScalar || node.text.empty()) {
      throw Stop{node.at, "A key must be a plain word."};
    }
    Open& top = open_.back();
    if (node.text == "<<") {
      problems_.add(node.at, "Merge keys (<<) are not supported; write the keys out.");
    }
    for (const YamlNode::Key& key : top.node.keys) {
      if (key.name != node.text) continue;
      const std::string line = std::to_string(key.at.line);
      problems_.add(node.at, path() + node.text + " is given twice" +
                                 (place_.lines ? "; it is already in line " + line + "." : "."));
      break;
    }
    top.node.keys.push_back({node.text, node.at});
    top.expects_value = true;
  }

  void place(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    YamlNode& parent = open_.back().node;
    // The parser notices a missing value only where the next key stands.
    if (node.kind == YamlNode::Kind::kNull && !parent.keys.empty()) node.at = parent.keys.back().at;
    // A list has no key that could be taken away, and !normal needs its own.
    if (parent.kind != YamlNode::Kind::kMap || !parent.tag.empty()) node.taken_away = false;
    parent.items.push_back(std::move(node));
    open_.back().expects_value = false;
  }

  // "throw." inside the map under the key `throw`.
  std::string path() const {
    std::string path;
    for (const Open& level : open_) {
      if (level.expects_value) path += level.node.keys.back().name + ".";
    }
    return path;
  }

  Position position(const YAML::Mark& mark) const { return place_.at(mark); }

  std::string_view text_;
  Problems& problems_;
  Place place_;
  YamlNode root_;
  std::vector<Open> open_;
  std::size_t nodes_ = 0;
};

// Control characters other than tab and line ends do not belong into a text file.
bool is_control(char c) {
  return (c >= 0 && c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
}

void check_encoding(std::string_view text, Problems& problems, const Place& place) {
  Position at{1, 1, place.source};
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0 || is_control(text[i])) {
      const int byte = static_cast<unsigned char>(text[i]);
      problems.fail(place.lines ? at : place.whole(),
                    (byte < 0x80 ? "This is a control character" : "This is not UTF-8 text") +
                        std::string(" (byte ") + std::to_string(byte) + ").");
    }
    if (text[i] == '\n') {
      at = {at.line + 1, 1, place.source};
    } else {
      ++at.column;
    }
    i += length;
  }
}

// yaml-cpp's own messages seldom say that a tab is the cause.
std::string hint_of_tab(std::string_view text) {
  int line = 1;
  bool indenting = true;
  for (const char c : text) {
    if (c == '\t' && indenting) {
      return " Line " + std::to_string(line) + " is indented with a tab; YAML takes spaces only.";
    }
    line += c == '\n' ? 1 : 0;
    indenting = c == '\n' || (indenting && c == ' ');
  }
  return "";
}

// A quote that does not end takes all that follows into its value, but yaml-cpp notices the end of
// the text only if no line break comes before it.
void check_quotes(std::string_view text, Problems& problems, const Place& place) {
  const std::size_t size = text.find_last_not_of("\r\n") + 1;
  if (size == text.size() || text.find_first_of("\"'") == std::string_view::npos) return;
  std::istringstream stream{std::string(text.substr(0, size))};
  YAML::Parser parser(stream);
  Problems of_the_tree("");
  TreeBuilder builder(text, of_the_tree, place);
  try {
    parser.HandleNextDocument(builder);
  } catch (const Stop&) {
    return;  // whatever is wrong is found again
  } catch (const YAML::Exception& error) {
    if (error.msg != YAML::ErrorMsg::EOF_IN_SCALAR) return;
    problems.fail(place.at(error.mark), "A quote that was opened before this does not end.");
  }
}

// The only document of the text.
YamlNode parse_document(std::string_view text, Problems& problems, const Place& place) {
  if (text.size() > kMostBytes) {
    problems.fail(place.whole(), "The file has " + std::to_string(text.size()) +
                                     " bytes; at most " + std::to_string(kMostBytes) +
                                     " are read.");
  }
  while (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  check_encoding(text, problems, place);
  try {
    check_quotes(text, problems, place);
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    TreeBuilder builder(text, problems, place);
    if (!parser.HandleNextDocument(builder)) {
      YamlNode nothing;
      nothing.at = place.whole();
      return nothing;
    }
    YamlNode root = builder.take_root();
    TreeBuilder second(text, problems, place);
    if (parser.HandleNextDocument(second)) {
      problems.fail(second.take_root().at, "This is more than one YAML document (---).");
    }
    return root;
  } catch (const Stop& stop) {
    problems.fail(stop.at, stop.sentence);
  } catch (const YAML::Exception& error) {
    problems.fail(place.at(error.mark),
                  "This is not valid YAML (" + error.msg + ")." + hint_of_tab(text));
  }
}

// Whether a scalar can stand without quotes wherever a value may stand.
bool is_plain(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return is_name_character(c) || c == '.' || c == '+';
  });
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto named = std::ranges::find(keys, key, &Key::name);
  return named == keys.end() ? nullptr : &items[static_cast<std::size_t>(named - keys.begin())];
}

void YamlNode::erase(std::size_t i) {
  keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(i));
  items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
}

std::optional<YamlNode> YamlNode::take(std::string_view key) {
  const YamlNode* const found = find(key);
  if (found == nullptr) return std::nullopt;
  const auto i = static_cast<std::size_t>(found - items.data());
  std::optional<YamlNode> value = std::move(items[i]);
  erase(i);
  return value;
}

YamlNode parse_yaml(std::string_view text, Problems& problems, int source,
                    std::size_t most_values) {
  const Place place{source, true, most_values};
  YamlNode root = parse_document(text, problems, place);
  if (root.kind == YamlNode::Kind::kNull) problems.fail(place.whole(), "The file is empty.");
  if (root.kind != YamlNode::Kind::kMap) {
    const std::string strange = beyond_ascii(root.text);
    problems.fail(root.at,
                  "The file must be a map of keys, one a line, such as \"seed: 1\"" +
                      (strange.empty() ? "." : "; this has the character " + strange + "."));
  }
  return root;
}

YamlNode parse_yaml_value(std::string_view text, Problems& problems, int source) {
  return parse_document(text, problems, {source, false});
}

std::string to_text(const YamlNode& node) {
  using Kind = YamlNode::Kind;
  std::string text = node.tag.empty() ? "" : node.tag + " ";
  switch (node.kind) {
    case Kind::kNull:
      return text + "~";
    case Kind::kScalar:
      return text + (node.quoted || !is_plain(node.text) ? in_quotes(node.text) : node.text);
    case Kind::kSequence:
    case Kind::kMap:
      break;
  }
  const bool map = node.kind == Kind::kMap;
  text += map ? "{" : "[";
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (map) text += node.keys[i].name + ": ";
    text += to_text(node.items[i]);
  }
  return text + (map ? "}" : "]");
}

std::string read_scenario_text(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw ScenarioError(path + ": There is no such file.");
  }
  if (error) throw IoError(path + " could not be read: " + error.message() + ".");
  // To open a pipe may take for ever.
  if (!std::filesystem::is_regular_file(status)) {
    const bool directory = std::filesystem::is_directory(status);
    throw ScenarioError(path + ": This is " + (directory ? "a directory" : "not a regular file") +
                        "; a YAML file is needed.");
  }
  const auto fail = [&path] {
    throw IoError(path + " could not be read: " + std::strerror(errno) + ".");
  };
  std::ifstream file(path, std::ios::binary);
  if (!file) fail();
  // One byte beyond the limit is enough to know that it is exceeded.
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) fail();
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMostBytes) {
    throw ScenarioError(path + ": The file has more than " + std::to_string(kMostBytes) +
                        " bytes, which no such file needs.");
  }
  return text;
}

}  // namespace dodgesim
