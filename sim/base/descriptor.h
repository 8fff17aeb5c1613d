// Bytes to other processes.
#pragma once

#include <string_view>

namespace dodgesim {

// Write all bytes to a file or pipe, or to a socket, of which a reader that has gone makes an error
// and no signal. Block. False, with errno, if not all could be written.
bool write_all(int file, std::string_view bytes);
bool send_all(int socket, std::string_view bytes);

}  // namespace dodgesim
