#include "sim/preflight/placed.h"

namespace dodgesim {

std::string place_named_in(const std::string& message, const Scenario& campaign) {
  std::size_t first = std::string::npos;
  std::string named;
  for (const auto& [key, place] : campaign.places) {
    if (key.find('.') == std::string::npos) continue;
    const std::size_t at = message.find(key);
    if (at > first || at == std::string::npos) continue;
    if (at < first || key.size() > named.size()) named = key;
    first = at;
  }
  return named.empty() ? "" : campaign.places.at(named);
}

std::string place_of_key(const std::string& key, const Scenario& campaign) {
  const auto at = campaign.places.find(key);
  return at == campaign.places.end() ? "" : at->second;
}

std::string placed(const std::string& message, const std::string& place) {
  return place.empty() ? message : place + ": " + message;
}

}  // namespace dodgesim
