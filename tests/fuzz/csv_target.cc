#include "sim/files/csv_table.h"

#include "sim/files/csv.h"
#include "sim/gate/comparison.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

bool csv(Bytes bytes) {
  return accepts([&] {
    const CsvTable table(text_of(bytes), "fuzz.csv");
    std::size_t cells = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      for (const std::string& column : table.columns()) cells += table.at(row, column).size();
    }
    require(cells <= bytes.size(), "cells hold no more than the file");
    const auto all = outcomes({table, table});
    compare(all, all);
  });
}

}  // namespace dodgesim::fuzz
