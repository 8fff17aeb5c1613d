// The page of the report, its style and its program (sim/campaign/report/).
#pragma once

namespace dodgesim {

extern const char* const kReport_page;
extern const char* const kReport_style;
extern const char* const kReport_script;

}  // namespace dodgesim
