#include "catena/properties/fuzz/failure_store.h"

#include <fmt/format.h>

#include <cctype>
#include <sstream>

#include "catena/core/error.h"
#include "catena/core/input/box_choice.h"
#include "catena/core/input/curve_input.h"
#include "catena/core/output_file.h"
#include "catena/core/readers/chain_format.h"
#include "catena/core/readers/reader.h"

namespace catena::properties {
namespace {

/// FNV-1a, 32 bits: a short name that stays the same.
std::uint32_t hash(const std::string& text) {
  std::uint32_t h = 2166136261u;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 16777619u;
  return h;
}

std::string as_file_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  return text;
}

}  // namespace

void require_folder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code none;
  std::error_code unknown;
  fs::path there = fs::absolute(folder, unknown);
  if (unknown)  // the folder that we are in was removed
    throw InputError(fmt::format("cannot make the folder {}: the working folder is not to be found ({})",
                                 folder.string(), unknown.message()));
  while (!fs::exists(there, none) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there, none))
    throw InputError(fmt::format("cannot make the folder {}: {} is none", folder.string(), there.string()));
  try {
    OutputFile probe(there / ".catena-probe");
  } catch (const InputError&) {
    throw InputError(fmt::format("cannot write into the folder {}; give another", folder.string()));
  }
}

std::filesystem::path store(const std::filesystem::path& folder, const Finding& finding,
                            const std::string& origin, const std::string& chain_file,
                            const std::string& suffix) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  const auto path = folder / fmt::format("{}-{}-{:08x}{}.chain", as_file_name(finding.property),
                                         as_file_name(finding.variant), hash(chain_file), suffix);
  write_file(path, fmt::format("# {}: {}\n# first seen: {}\n# {}\n{}", finding.variant, finding.property,
                               finding.what, origin, chain_file));
  return path;
}

std::vector<std::filesystem::path> store(const std::filesystem::path& folder, const Finding& finding,
                                         const std::string& origin, const std::vector<Chain>& shrunk) {
  std::vector<std::filesystem::path> paths;
  for (const Chain& chain : shrunk) {
    const bool alone = shrunk.size() == 1;
    paths.push_back(store(
        folder, finding,
        alone ? origin
              : fmt::format("{}; chain {} of {}, by one object", origin, paths.size() + 1, shrunk.size()),
        chain_file_of(chain), alone ? "" : fmt::format("-{}", paths.size() + 1)));
  }
  return paths;
}

std::vector<std::filesystem::path> store(const std::filesystem::path& folder, const Fuzzer::Counterexample& c,
                                         std::uint64_t seed) {
  return store(folder, c.finding,
               fmt::format("{}, shrunk from {} spheres", origin_of(c.family, seed, c.number), c.found.size()),
               c.shrunk);
}

std::string origin_of(const std::string& family, std::uint64_t seed, std::uint64_t number) {
  return fmt::format("family {}, seed {}, case {}", family, seed, number);
}

std::string chain_file_of(const Chain& chain) {
  std::ostringstream text;
  write_chain(text, chain);
  return text.str();
}

Chain load_chain(const std::filesystem::path& file) {
  CurveFile curves = ReaderRegistry::instance().read(file);
  if (!curves.has_radii)
    throw InputError(
        fmt::format("{}: the file has no radii, and a replay is of spheres; write one with catena export "
                    "FILE NEW.chain --radius R",
                    file.string()));
  if (!curves.later_frames.empty())
    throw InputError(
        fmt::format("{}: the file has several frames, and a replay is of one; write it with catena export "
                    "FILE NEW.chain --frame F",
                    file.string()));
  choose_boxes(curves, {}, file.string());  // a box that repeats space is refused: a replay is of a chain
  return make_chain(std::move(curves), {});
}

}  // namespace catena::properties
