#include "catena/properties/fuzz/failure_store.h"

#include <fmt/format.h>

#include <cctype>
#include <sstream>

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

std::filesystem::path store(const std::filesystem::path& folder, const Fuzzer::Counterexample& counterexample,
                            std::uint64_t seed) {
  const Finding& f = counterexample.finding;
  std::ostringstream chain;
  write_chain(chain, counterexample.shrunk);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  const auto path = folder / fmt::format("{}-{}-{:08x}.chain", as_file_name(f.property),
                                         as_file_name(f.variant), hash(chain.str()));
  write_file(path,
             fmt::format("# {}: {}\n# first seen: {}\n# family {}, seed {}, case {}, shrunk from {} spheres\n{}",
                         f.variant, f.property, f.what, counterexample.family, seed, counterexample.number,
                         counterexample.found.size(), chain.str()));
  return path;
}

Chain load_chain(const std::filesystem::path& file) {
  CurveFile curves = ReaderRegistry::instance().read(file);
  return Chain(std::move(curves.spheres), {std::move(curves.strand_first), std::move(curves.strand_closed)},
               std::move(curves.exclusion));
}

}  // namespace catena::properties
