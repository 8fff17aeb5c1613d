// Which rows go with which columns, so that the sum of the costs is least: the Hungarian method
// with potentials (Kuhn 1955, Munkres 1957), row by row.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace dodge {

class Assignment {
 public:
  // Memory is allocated here, and later only for more rows or columns than `most`.
  explicit Assignment(std::size_t most);

  // `costs`: rows x columns, row-major. Returns the column of each row, or -1: to leave a row
  // without a column costs `limit`, and no pair costs more. The same input gives the same output,
  // also where several assignments are as good. Valid until the next call.
  std::span<const int> solve(std::span<const double> costs, std::size_t rows, std::size_t columns,
                             double limit);

 private:
  // Of a row and a column, which count from 1; the columns behind the true ones stand for none.
  double cost(std::size_t row, std::size_t column) const;
  void add_row(std::size_t row);

  std::span<const double> costs_;
  std::size_t true_columns_ = 0, columns_ = 0;
  double limit_ = 0;
  std::vector<double> row_potential_, column_potential_, slack_;
  std::vector<std::size_t> row_of_, before_;  // of a column; 0: none
  std::vector<bool> reached_;                 // columns
  std::vector<int> column_of_;                // the result
};

}  // namespace dodge
