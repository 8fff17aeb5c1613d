#include "sim/files/markup.h"

#include <cctype>

#include "sim/base/utf8.h"

namespace dodgesim {

namespace {

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
  const std::string valid = valid_utf8(text);
  std::string out;
  for (std::string_view left = valid; !left.empty();) {
    const std::string_view sequence = left.substr(0, utf8_length(left));
    if (sequence.size() == 1) {
      out += escaped(sequence.front());
    } else {
      out += is_no_character(sequence) ? kReplacement : sequence;
    }
    left.remove_prefix(sequence.size());
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
    const bool word_ends = text[i] == '_' && !(i > 0 && in_word(i - 1) && in_word(i + 1));
    if (word_ends || kMarkup.find(text[i]) != std::string_view::npos) out += '\\';
    out += text[i];
  }
  return out;
}

std::string markdown_cell(std::string_view markdown) {
  std::string out;
  for (const char c : markdown) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace dodgesim
