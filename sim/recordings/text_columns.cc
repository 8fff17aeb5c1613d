#include "sim/recordings/text_columns.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/base/joined.h"
#include "sim/base/numbers.h"
#include "sim/base/utf8.h"

namespace dodgesim {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Where a cell that begins with a quote ends: behind the quote that closes it. Two quotes within it
// stand for one.
std::size_t end_of_quoted(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] != '"') continue;
    if (i + 1 == text.size() || text[i + 1] != '"') return i + 1;
    ++i;
  }
  return text.size();
}

std::string_view without_quotes(std::string_view cell) {
  const bool quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
  return quoted ? cell.substr(1, cell.size() - 2) : cell;
}

}  // namespace

TextColumns::TextColumns(const std::string& path)
    : path_(path), file_(open_file(path)), bytes_(std::filesystem::file_size(path)) {
  expect_plain_text();
}

void TextColumns::expect_plain_text() {
  std::string begin(2, ' ');
  file_.read(begin.data(), 2);
  file_.clear();
  file_.seekg(0);
  if (begin == "\x1f\x8b") {
    throw ScenarioError(path_ + " is compressed by gzip: unpack it first (gunzip).");
  }
  if (begin == "\xff\xfe" || begin == "\xfe\xff") {
    throw ScenarioError(path_ + " is text in UTF-16, but must be in ASCII or UTF-8.");
  }
}

void TextColumns::split(std::string_view line) {
  const std::string_view blanks = separator_ == '\t' ? " \r" : " \t\r";
  const std::string_view separators = separator_ == ' ' ? blanks : std::string_view(&separator_, 1);
  cells_.clear();
  for (;;) {
    const std::size_t first = line.find_first_not_of(blanks);
    if (first == line.npos) break;
    line.remove_prefix(first);
    const std::size_t from = line.front() == '"' ? end_of_quoted(line) : 0;
    const std::size_t end = line.find_first_of(separators, from);
    std::string_view cell = line.substr(0, end);
    cell = cell.substr(0, cell.find_last_not_of(blanks) + 1);
    cells_.push_back(without_quotes(cell));
    if (end == line.npos) break;
    line.remove_prefix(end + 1);
  }
}

bool TextColumns::read_line() {
  if (!std::getline(file_, line_)) {
    if (file_.bad()) throw IoError(path_ + " cannot be read to its end.");
    return false;
  }
  ++line_number_;
  bytes_read_ += line_.size() + 1;
  if (line_number_ == 1 && line_.starts_with(kByteOrderMark)) line_.erase(0, kByteOrderMark.size());
  split(line_);
  return true;
}

bool TextColumns::next() {
  while (read_line()) {
    if (cells_.empty() || is_remark()) continue;
    if (!names_.empty() && cells_.size() > names_.size()) expect_empty_from(names_.size());
    return true;
  }
  return false;
}

void TextColumns::expect_empty_from(std::size_t index) const {
  const auto is_empty = [](std::string_view cell) { return cell.empty(); };
  if (std::all_of(cells_.begin() + static_cast<std::ptrdiff_t>(index), cells_.end(), is_empty)) {
    return;
  }
  throw ScenarioError(place() + ": the line has " + std::to_string(cells_.size()) + " cells, but " +
                      std::to_string(names_.size()) + " columns have names" +
                      (separator_ == ',' ? ": are there commas in place of decimal points?" : "."));
}

void TextColumns::read_names(const std::vector<std::string>& required) {
  while (read_line()) {
    if (cells_.empty()) continue;
    const bool remark = is_remark();
    if (remark) line_.erase(0, line_.find('#') + 1);
    const std::size_t first = line_.find_first_of(",;\t");
    separator_ = first == line_.npos ? ',' : line_[first];
    split(line_);
    names_.assign(cells_.begin(), cells_.end());
    const auto named = [this](const std::string& name) { return has(name); };
    if (!remark || std::ranges::all_of(required, named)) break;
    names_.clear();
  }
  if (names_.empty()) throw ScenarioError(path_ + " is empty: not even its columns have names.");
  for (const std::string& name : required) {
    if (has(name)) continue;
    throw ScenarioError(place() + ": there is no column " + name + "; the first line must name " +
                        joined(required, {}, " and ") + ".");
  }
}

bool TextColumns::has(const std::string& name) const { return contains(names_, name); }

Column TextColumns::column(const std::string& name) const {
  if (std::ranges::count(names_, name) > 1) {
    throw ScenarioError(place() + ": the column " + name + " comes twice.");
  }
  const auto place = index_of(names_, name);
  if (!place) throw ScenarioError(path_ + " has no column " + name + ".");
  return {name, *place};
}

std::string_view TextColumns::text(const Column& column) const {
  if (column.index < cells_.size()) return cells_[column.index];
  throw ScenarioError(place() + ": " + column.name + " is missing; the line has " +
                      std::to_string(cells_.size()) + (cells_.size() == 1 ? " cell." : " cells."));
}

std::int64_t TextColumns::integer(const Column& column) const {
  constexpr double kMost = 9e15;  // the whole numbers up to here are doubles
  const std::string_view cell = text(column);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc{} && end == cell.data() + cell.size()) return value;
  const std::optional<double> number = as_number(cell);
  if (number && *number == std::floor(*number) && std::abs(*number) < kMost) {
    return static_cast<std::int64_t>(*number);
  }
  refuse(column, "a whole number");
}

double TextColumns::number(const Column& column) const {
  if (const std::optional<double> value = as_number(text(column))) return *value;
  refuse(column, "a number");
}

void TextColumns::refuse(const Column& column, const std::string& what) const {
  constexpr std::size_t kLongestQuote = 40;
  throw ScenarioError(place() + ": " + column.name + " is \"" +
                      printable(text(column).substr(0, kLongestQuote)) + "\", but must be " + what +
                      ".");
}

}  // namespace dodgesim
