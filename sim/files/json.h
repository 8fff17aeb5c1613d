// JSON, as manifests, tables, reports and recordings have it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace dodgesim {

using Json = nlohmann::ordered_json;  // members keep the order in which they were added

// On one line, or with a line for each member. Bytes that are not UTF-8, which a command line may
// have, become replacement characters.
std::string to_text(const Json& json, int indent = -1);

// Throws std::invalid_argument that says where `text` is no JSON.
Json parse_json(std::string_view text);

}  // namespace dodgesim
