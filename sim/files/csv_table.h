// A CSV file (RFC 4180) as text, such as the throws.csv of a campaign.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dodgesim {

class CsvTable {
 public:
  // The first row names the columns. Throws IoError, with file and line, if the file cannot be read
  // or a row has another number of cells, a column's name comes twice or a quote is not closed.
  explicit CsvTable(const std::filesystem::path& path);
  // `name` opens the messages about `text`.
  CsvTable(std::string_view text, std::string name);

  std::size_t rows() const { return rows_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  bool has(const std::string& column) const { return index_.count(column) > 0; }
  // Throws IoError if there is no such column. Requires row < rows().
  const std::string& at(std::size_t row, const std::string& column) const;
  // at() as a number. Also throws IoError if it is none, or none of that type.
  double number(std::size_t row, const std::string& column) const;
  int integer(std::size_t row, const std::string& column) const;
  bool boolean(std::size_t row, const std::string& column) const;  // 0 or 1
  // at(). Also throws IoError if it is none of the words.
  const std::string& one_of(std::size_t row, const std::string& column,
                            std::initializer_list<std::string_view> words) const;
  // The line of the file in which a row begins. Requires row < rows().
  int line(std::size_t row) const { return lines_[row]; }
  // `name` or the file's path.
  const std::string& name() const { return name_; }

 private:
  [[noreturn]] void refuse(std::size_t row, const std::string& column,
                           const std::string& what) const;

  std::string name_;
  std::vector<std::string> columns_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<int> lines_;  // where each row begins
};

}  // namespace dodgesim
