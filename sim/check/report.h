// The self-tests' report: one HTML page with its pictures in it.
#pragma once

#include <string>
#include <vector>

#include "sim/check/check.h"

namespace dodgesim {

// `subject` says which camera was tested and how, for the head of the page.
std::string html_report(const std::string& subject, const std::vector<Check>& checks);

}  // namespace dodgesim
