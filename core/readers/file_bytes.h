#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace catena {

/// True for `-`, which names standard input.
bool is_standard_input(const std::filesystem::path& file);

/// How errors name it: the path, or "standard input".
std::string shown_name(const std::filesystem::path& file);

/// The whole file, or all of standard input, unpacked where it is gzip's; the same again where it is read
/// again. Throws InputError, naming the file, unless it is a readable regular file (or standard input) of at
/// least one byte.
std::string read_bytes(const std::filesystem::path& file);

/// The first bytes of what read_bytes gives, at most `size`; fewer where it has no more, or cannot be read or
/// unpacked, of which read_bytes tells. Not of standard input, which is there once.
std::string first_bytes(const std::filesystem::path& file, std::size_t size);

/// The part of read_bytes that does not open the file: throws InputError unless there is a regular file.
void require_regular_file(const std::filesystem::path& file);

/// Gives the whole pages of memory between two places of a text back to the system, where that can be done;
/// nothing there may be read again.
void release_pages(std::string& bytes, std::size_t begin, std::size_t end);

/// Text of a file as it may be shown inside an error of one line: in quotes, at most 40 characters,
/// everything that does not print as '?'.
std::string in_quotes(std::string_view text);

}  // namespace catena
