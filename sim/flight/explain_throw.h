// What a throw's flights say about each other: false alarms, times to contact and to escape, and
// why the flown pilot was hit or crashed.
#pragma once

#include "sim/flight/flight.h"

namespace dodgesim {

// Fills in first_in_view_us, time_to_contact_us, false_alarm, cause, escape_left_s and
// escape_needed_s from the records of the pilots that flew (`none` may be null). Requires
// everything else of the result.
void explain_throw(const FlightPlan& plan, const FlightRecord* none, const FlightRecord& flown,
                   ThrowResult& result);

}  // namespace dodgesim
