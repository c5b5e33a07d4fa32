#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace catena {

/// Data compressed by zlib. Without zlib in the build each throws InputError that says so.

/// True for the first bytes of a gzip file.
bool is_gzip(std::string_view bytes);

/// The content of a gzip file: of all its members, one after the other, as `gzip` and `bgzip` write them.
/// Throws InputError, naming `file`, for data that is damaged or cut off. O(content) time and memory.
std::string gunzip(std::string_view bytes, const std::string& file);

/// At most `size` bytes of that content, from the first of those bytes on; fewer where they end before, are
/// damaged, or there is no zlib.
std::string gunzip_head(std::string_view bytes, std::size_t size);

/// One zlib stream (RFC 1950) that holds exactly `size` bytes, appended to `content`. False when it does not.
bool append_inflated(std::string_view stream, std::uint64_t size, std::string& content);

}  // namespace catena
