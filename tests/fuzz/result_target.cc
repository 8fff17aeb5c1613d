#include "sim/campaign/journal.h"
#include "sim/campaign/wire.h"
#include "sim/files/csv.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

bool result(Bytes bytes) {
  ThrowResult result;
  const bool is_result = accepts([&] { result = result_from_bytes(text_of(bytes)); });
  if (is_result) {
    const std::string again = to_bytes(result);
    require(to_bytes(result_from_bytes(again)) == again, "a result reads back as it was written");
    csv_row(result);
  }
  const bool is_identity = accepts([&] {
    const CampaignIdentity identity = identity_from_bytes(text_of(bytes));
    require(identity_from_bytes(to_bytes(identity)) == identity, "an identity reads back");
  });
  return is_result || is_identity;
}

}  // namespace dodgesim::fuzz
