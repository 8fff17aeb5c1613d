// A result as bytes, for the way from a worker process to the campaign and for the journal, on
// machines of one kind.
#pragma once

#include <string>
#include <string_view>

#include "sim/campaign/identity.h"
#include "sim/outcome/result.h"

namespace dodgesim {

std::string to_bytes(const ThrowResult& result);

std::string to_bytes(const CampaignIdentity& identity);

// Throw IoError when the bytes are not those of one whole result or identity.
ThrowResult result_from_bytes(std::string_view bytes);
CampaignIdentity identity_from_bytes(std::string_view bytes);

}  // namespace dodgesim
