// Text for HTML, XML and Markdown.
#pragma once

#include <string>
#include <string_view>

namespace dodgesim {

// The text as content or attribute: nothing of it is taken for markup. Control characters that XML
// does not allow become question marks, and what is no character of UTF-8 becomes U+FFFD.
std::string markup_escaped(std::string_view text);

// The text, a line, as Markdown shows it: backslashes before what would be markup.
std::string markdown_escaped(std::string_view text);

// Markdown, a line, as a cell of a table, which a bar would end.
std::string markdown_cell(std::string_view markdown);

}  // namespace dodgesim
