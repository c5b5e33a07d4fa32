#include "catena/core/readers/file_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <mutex>
#include <optional>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/executor/give_back_pages.h"
#include "catena/core/readers/compressed.h"
#include "catena/core/readers/open_input.h"

namespace catena {
namespace fs = std::filesystem;

bool is_standard_input(const fs::path& file) { return file == "-"; }

std::string shown_name(const fs::path& file) {
  return is_standard_input(file) ? "standard input" : file.string();
}

void require_regular_file(const fs::path& file) {
  if (is_standard_input(file)) return;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::status_known(status))  // a folder that may not be looked into, a name that is too long
    throw InputError(fmt::format("{}: cannot be read: {}", file.string(), error.message()));
  if (!fs::exists(status)) throw InputError(fmt::format("{}: there is no such file", file.string()));
  if (fs::is_directory(status))
    throw InputError(fmt::format("{}: is a directory; name a file in it", file.string()));
  // A pipe has no size to check the counts of a header against, and a device may never end.
  if (!fs::is_regular_file(status))
    throw InputError(
        fmt::format("{}: is not a regular file; what comes through a pipe is read from standard "
                    "input, as - with --format",
                    file.string()));
}

namespace {

std::string packed_bytes(const fs::path& file) {
  require_regular_file(file);
  OpenInput in(file);
  const std::size_t size = in.told_size();
  std::string bytes = in.read_all();
  if (bytes.size() < size)  // somebody writes it anew, perhaps
    throw InputError(
        fmt::format("{}: ends after {} of {}", shown_name(file), bytes.size(), counted(size, "byte")));
  if (bytes.empty()) throw InputError(fmt::format("{}: is empty", shown_name(file)));
  return bytes;
}

/// Of a command that opens its input again it is the same again, as a file is.
std::string bytes_of_standard_input() {
  // A command that reads it once keeps it for nothing.
  constexpr std::size_t most_kept = std::size_t{1} << 26;
  static std::mutex reading;
  static std::optional<std::string> kept;
  static bool was_read = false;
  static std::exception_ptr failed;  // what is left of it then is no input
  const std::lock_guard lock(reading);
  if (kept) return *kept;
  if (was_read)
    throw InputError(
        "standard input: can be read once where it has more than 64 MiB, and is needed again; give a file");
  if (failed) std::rethrow_exception(failed);
  try {
    std::string bytes = packed_bytes("-");
    was_read = true;
    if (bytes.size() <= most_kept) kept = bytes;
    return bytes;
  } catch (...) {
    failed = std::current_exception();
    throw;
  }
}

}  // namespace

std::string read_bytes(const fs::path& file) {
  std::string bytes = is_standard_input(file) ? bytes_of_standard_input() : packed_bytes(file);
  if (!is_gzip(bytes)) return bytes;
  bytes = gunzip(bytes, shown_name(file));
  if (bytes.empty()) throw InputError(fmt::format("{}: holds nothing when unpacked", shown_name(file)));
  return bytes;
}

std::string first_bytes(const fs::path& file, std::size_t size) {
  constexpr std::size_t longest_head = std::size_t{1} << 18;  // of gzip: a name, a comment and another 64 KiB
  std::string bytes(std::max(size, longest_head), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  if (is_gzip(bytes)) return gunzip_head(bytes, size);
  bytes.resize(std::min(bytes.size(), size));
  return bytes;
}

void release_pages(std::string& bytes, std::size_t begin, std::size_t end) {
  give_back_pages(bytes.data() + begin, end - begin);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::ranges::replace_if(
      shown, [](unsigned char c) { return c < 0x20 || c > 0x7E; }, '?');
  return fmt::format("'{}{}'", shown, text.size() > longest ? "..." : "");
}

}  // namespace catena
