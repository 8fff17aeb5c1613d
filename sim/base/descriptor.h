// Bytes from and to files, pipes and sockets, as many as are asked for. All functions block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dodgesim {

// Write all bytes: to a file or pipe; to a file from the offset `at` on; to a socket, of which a
// reader that has gone makes an error and no signal. False, with errno, if not all could be
// written.
bool write_all(int file, std::string_view bytes);
bool pwrite_all(int file, std::string_view bytes, std::uint64_t at);
bool send_all(int socket, std::string_view bytes);

// Reads `size` bytes to `data`; false if there are fewer before the end, or reading fails.
bool read_all(int file, void* data, std::size_t size);

}  // namespace dodgesim
