#pragma once
#include <filesystem>

#include "catena/properties/fuzz/fuzzer.h"

namespace catena::properties {

/// Writes the shrunk chain as DIR/<property>-<variant>-<hash>.chain with what failed as comments, and returns
/// the path. The same chain for the same finding gets the same name. Throws InputError when it cannot be
/// written.
std::filesystem::path store(const std::filesystem::path& folder, const Fuzzer::Counterexample& counterexample,
                            std::uint64_t seed);

/// The chain of a .chain file, or of any file whose radii are its own. Throws InputError.
Chain load_chain(const std::filesystem::path& file);

}  // namespace catena::properties
