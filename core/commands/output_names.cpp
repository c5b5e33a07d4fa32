#include "catena/core/commands/output_names.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/output_file.h"
#include "catena/core/readers/reader.h"

namespace catena {
namespace {

namespace fs = std::filesystem;

/// Where a file that is yet to be made will lie. Of a relative name of which nothing exists weakly_canonical
/// alone makes no absolute one, and a link to what is not there it takes for a file. Nothing where that
/// cannot be told: whoever writes there will say why.
std::optional<fs::path> place_of(const fs::path& name) {
  std::error_code unknown;
  const fs::path absolute = fs::absolute(OutputFile::target(name), unknown);
  if (unknown) return std::nullopt;
  fs::path place = fs::weakly_canonical(absolute, unknown);
  return unknown ? std::nullopt : std::optional(std::move(place));
}

/// Two names of one file, which may be yet to be made.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code none;
  const fs::file_status status = fs::status(a, none);
  if (fs::exists(status)) return fs::is_regular_file(status) && fs::equivalent(a, b, none);
  const auto place = place_of(a);
  return place && place == place_of(b);
}

}  // namespace

void require_apart(const std::vector<std::string>& read, const std::vector<std::string>& written) {
  for (std::size_t k = 0; k < written.size(); ++k) {
    if (written[k].empty()) continue;
    if (written[k] == "-") throw InputError("-: is no file to write; /dev/stdout is the output");
    for (const std::string& input : read)
      if (std::error_code none; fs::exists(input, none) && same_file(written[k], input))
        throw InputError(
            fmt::format("{}: is read, and would be lost; name another file to write", written[k]));
    for (std::size_t other = 0; other < k; ++other)
      if (!written[other].empty() && same_file(written[k], written[other]))
        throw InputError(fmt::format("{}: is to be written twice; name another file", written[k]));
  }
}

void require_apart(const std::string& input, const ReadOptions& reading,
                   const std::vector<std::string>& written) {
  std::vector<std::string> read;
  for (const fs::path& file : ReaderRegistry::instance().files_of(input, reading))
    read.push_back(file.string());
  require_apart(read, written);
}

}  // namespace catena
