// Lists in sentences and tables.
#pragma once

#include <functional>
#include <iterator>
#include <string>
#include <string_view>

namespace dodgesim {

// The items' texts with ", " between them, and `last` before the last one: "a, b or c".
template <class Items, class TextOf = std::identity>
std::string joined(const Items& items, const TextOf& text_of = {}, std::string_view last = ", ") {
  std::string text;
  for (auto item = std::begin(items); item != std::end(items); ++item) {
    const bool is_last = std::next(item) == std::end(items);
    if (item != std::begin(items)) text += is_last ? last : ", ";
    text += std::invoke(text_of, *item);
  }
  return text;
}

}  // namespace dodgesim
