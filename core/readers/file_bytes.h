#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace catena {

/// The whole file. Throws InputError, naming the file, unless it is a readable regular file of at least one
/// byte.
std::string read_bytes(const std::filesystem::path& file);

/// The part of read_bytes that does not open the file: throws InputError unless there is a regular file.
void require_regular_file(const std::filesystem::path& file);

/// Text of a file as it may be shown inside an error of one line: in quotes, at most 40 characters,
/// everything that does not print as '?'.
std::string in_quotes(std::string_view text);

}  // namespace catena
