// Columns of numbers in a file of text, line by line, as many programs write them.
//
// The cells of a line are separated by blanks or, where a first line names the columns, by commas
// or what stands between the names in their place, semicolons or tabs. Blanks and double quotes
// around a cell do not count, nor do empty lines, lines that begin with #, a byte order mark
// (UTF-8) and whether lines end in \n or \r\n. The line that names the columns may itself begin
// with #. Cells of columns that nobody asks for may hold anything, or be missing; beyond the
// columns that have names, cells must be empty.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace dodgesim {

struct Column {
  std::string name;
  std::size_t index = 0;
};

// All functions throw ScenarioError, one sentence that names the file and the line, for what is not
// as above, and IoError when reading fails.
class TextColumns {
 public:
  explicit TextColumns(const std::string& path);

  // Reads the first line, which must name all of these columns. They are found with column().
  void read_names(const std::vector<std::string>& required);
  bool has(const std::string& name) const;
  Column column(const std::string& name) const;  // Requires read_names().

  // Reads the next line; false at the end.
  bool next();
  std::size_t cells() const { return cells_.size(); }  // of the line
  // Of the line. A whole number may be written as 12, 12.0 or 1.2e1.
  std::string_view text(const Column& column) const;
  std::int64_t integer(const Column& column) const;
  double number(const Column& column) const;

  // "log.csv:12", the line.
  std::string place() const { return path_ + ":" + std::to_string(line_number_); }
  const std::string& path() const { return path_; }
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t bytes_read() const { return bytes_read_; }
  [[noreturn]] void refuse(const Column& column, const std::string& what) const;

 private:
  void expect_plain_text();
  void expect_empty_from(std::size_t index) const;  // the cells of the line
  bool read_line();
  void split(std::string_view line);
  bool is_remark() const { return !cells_.empty() && cells_.front().starts_with('#'); }

  std::string path_;
  std::ifstream file_;
  std::uint64_t bytes_ = 0, bytes_read_ = 0;
  std::string line_;
  std::int64_t line_number_ = 0;
  std::vector<std::string_view> cells_;  // in line_
  std::vector<std::string> names_;
  char separator_ = ' ';
};

}  // namespace dodgesim
