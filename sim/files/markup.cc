#include "sim/files/markup.h"

#include <cctype>

#include "sim/base/utf8.h"

namespace dodgesim {

namespace {

constexpr const char* kReplacement = "\xef\xbf\xbd";  // U+FFFD

// XML knows neither U+FFFE nor U+FFFF.
bool is_no_character(std::string_view sequence) {
  return sequence == "\xef\xbf\xbe" || sequence == "\xef\xbf\xbf";
}

std::string escaped(char c) {
  if (c == '&') return "&amp;";
  if (c == '<') return "&lt;";
  if (c == '>') return "&gt;";
  if (c == '"') return "&quot;";
  const bool text = static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t';
  return text ? std::string(1, c) : "?";
}

}  // namespace

std::string markup_escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view sequence = text.substr(0, length);
    if (length == 1) {
      out += escaped(text.front());
    } else if (length == 0 || is_no_character(sequence)) {
      out += kReplacement;
    } else {
      out += sequence;
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string markdown_escaped(std::string_view text) {
  constexpr std::string_view kMarkup = "\\`*<>[]|~";
  const auto in_word = [text](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0);
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool word_ends = text[i] == '_' && !(in_word(i - 1) && in_word(i + 1));
    if (word_ends || kMarkup.find(text[i]) != std::string_view::npos) out += '\\';
    out += text[i];
  }
  return out;
}

}  // namespace dodgesim
