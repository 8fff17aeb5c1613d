#include "sim/files/csv_table.h"

#include <utility>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/base/joined.h"
#include "sim/base/numbers.h"

namespace dodgesim {

namespace {

// Splits a text into rows of cells.
class Splitter {
 public:
  Splitter(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  bool done() const { return rest_.empty(); }
  int line() const { return line_; }  // of the row that next() has returned

  std::vector<std::string> next() {
    line_ = next_line_;
    std::vector<std::string> cells = {cell()};
    while (!rest_.empty() && rest_.front() == ',') {
      rest_.remove_prefix(1);
      cells.push_back(cell());
    }
    end_row();
    return cells;
  }

  [[noreturn]] void fail(const std::string& complaint) const {
    throw IoError(name_ + ":" + std::to_string(line_) + ": " + complaint);
  }

 private:
  std::string cell() { return !rest_.empty() && rest_.front() == '"' ? quoted() : plain(); }

  std::string plain() {
    const std::string_view text = rest_.substr(0, rest_.find_first_of(",\r\n"));
    if (text.find('"') != std::string_view::npos) fail("A quote stands within a cell.");
    rest_.remove_prefix(text.size());
    return std::string(text);
  }

  std::string quoted() {
    std::string text;
    for (std::size_t i = 1; i < rest_.size(); ++i) {
      if (rest_[i] == '\n') ++next_line_;
      if (rest_[i] != '"') {
        text += rest_[i];
      } else if (i + 1 < rest_.size() && rest_[i + 1] == '"') {
        text += rest_[i++];
      } else {
        rest_.remove_prefix(i + 1);
        return text;
      }
    }
    fail("A quote is not closed.");
  }

  void end_row() {
    if (!rest_.empty() && rest_.front() == '\r') rest_.remove_prefix(1);
    ++next_line_;
    if (rest_.empty()) return;
    if (rest_.front() != '\n') fail("Text stands behind a closed quote.");
    rest_.remove_prefix(1);
  }

  std::string_view rest_;
  const std::string& name_;
  int line_ = 0, next_line_ = 1;
};

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path) : CsvTable(read_file(path), path.string()) {}

CsvTable::CsvTable(std::string_view text, std::string name) : name_(std::move(name)) {
  Splitter splitter(text, name_);
  columns_ = splitter.next();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!index_.emplace(columns_[i], i).second) {
      splitter.fail("The column \"" + columns_[i] + "\" comes twice.");
    }
  }
  while (!splitter.done()) {
    rows_.push_back(splitter.next());
    lines_.push_back(splitter.line());
    if (rows_.back().size() == columns_.size()) continue;
    splitter.fail("There are " + std::to_string(rows_.back().size()) + " cells, not " +
                  std::to_string(columns_.size()) + ".");
  }
}

const std::string& CsvTable::at(std::size_t row, const std::string& column) const {
  const auto found = index_.find(column);
  if (found == index_.end()) throw IoError(name_ + " has no column \"" + column + "\".");
  return rows_[row][found->second];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  if (const auto value = as_number(at(row, column))) return *value;
  refuse(row, column, "a number");
}

int CsvTable::integer(std::size_t row, const std::string& column) const {
  const std::string& text = at(row, column);
  if (number_form(text) == NumberForm::kInteger) {
    if (const auto value = parse_integer<int>(text)) return *value;
  }
  refuse(row, column, "an integer");
}

bool CsvTable::boolean(std::size_t row, const std::string& column) const {
  const std::string& text = at(row, column);
  if (text != "0" && text != "1") refuse(row, column, "0 or 1");
  return text == "1";
}

const std::string& CsvTable::one_of(std::size_t row, const std::string& column,
                                    std::initializer_list<std::string_view> words) const {
  const std::string& text = at(row, column);
  if (contains(words, text)) return text;
  refuse(row, column, joined(words, {}, " or "));
}

void CsvTable::refuse(std::size_t row, const std::string& column, const std::string& what) const {
  throw IoError(name_ + ":" + std::to_string(line(row)) + ": " + column + " is \"" +
                at(row, column) + "\", not " + what + ".");
}

}  // namespace dodgesim
