#include "dodge/detect/assignment.h"

#include <limits>

namespace dodge {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

Assignment::Assignment(std::size_t most) {
  for (auto* of_columns : {&column_potential_, &slack_}) of_columns->reserve(2 * most + 1);
  for (auto* of_columns : {&row_of_, &before_}) of_columns->reserve(2 * most + 1);
  reached_.reserve(2 * most + 1);
  row_potential_.reserve(most + 1);
  column_of_.reserve(most);
}

double Assignment::cost(std::size_t row, std::size_t column) const {
  if (column > true_columns_) return limit_;
  const double cost = costs_[(row - 1) * true_columns_ + column - 1];
  return cost <= limit_ ? cost : kNever;
}

std::span<const int> Assignment::solve(std::span<const double> costs, std::size_t rows,
                                       std::size_t columns, double limit) {
  costs_ = costs;
  true_columns_ = columns;
  columns_ = columns + rows;
  limit_ = limit;
  row_potential_.assign(rows + 1, 0);
  column_potential_.assign(columns_ + 1, 0);
  row_of_.assign(columns_ + 1, 0);
  before_.assign(columns_ + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row) add_row(row);
  column_of_.assign(rows, -1);
  for (std::size_t column = 1; column <= columns; ++column) {
    if (row_of_[column] > 0) column_of_[row_of_[column] - 1] = static_cast<int>(column) - 1;
  }
  return column_of_;
}

// Looks for the cheapest way to a free column, on which rows that have one may change theirs.
void Assignment::add_row(std::size_t row) {
  slack_.assign(columns_ + 1, kNever);
  reached_.assign(columns_ + 1, false);
  row_of_[0] = row;
  std::size_t at = 0;
  do {
    reached_[at] = true;
    double step = kNever;
    std::size_t next = 0;
    for (std::size_t j = 1; j <= columns_; ++j) {
      if (reached_[j]) continue;
      const double reduced =
          cost(row_of_[at], j) - row_potential_[row_of_[at]] - column_potential_[j];
      if (reduced < slack_[j]) {
        slack_[j] = reduced;
        before_[j] = at;
      }
      if (slack_[j] < step) {
        step = slack_[j];
        next = j;
      }
    }
    for (std::size_t j = 0; j <= columns_; ++j) {
      if (reached_[j]) {
        row_potential_[row_of_[j]] += step;
        column_potential_[j] -= step;
      } else {
        slack_[j] -= step;
      }
    }
    at = next;
  } while (row_of_[at] != 0);
  for (; at != 0; at = before_[at]) row_of_[at] = row_of_[before_[at]];
}

}  // namespace dodge
