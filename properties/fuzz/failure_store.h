#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "catena/properties/fuzz/fuzzer.h"

namespace catena::properties {

/// Throws InputError where nothing can be stored in this folder, which need not exist, before the search for
/// what is to be stored. Leaves nothing.
void require_folder(const std::filesystem::path& folder);

/// Writes a chain, as the text of its file, as DIR/<property>-<variant>-<hash><suffix>.chain with what failed
/// and where it comes from as comments, and returns the path. The same chain for the same finding gets the
/// same name. Throws InputError when it cannot be written.
std::filesystem::path store(const std::filesystem::path& folder, const Finding& finding,
                            const std::string& origin, const std::string& chain_file,
                            const std::string& suffix = "");

/// The shrunk chain, or of a sequence each in its order.
std::vector<std::filesystem::path> store(const std::filesystem::path& folder, const Finding& finding,
                                         const std::string& origin, const std::vector<Chain>& shrunk);
std::vector<std::filesystem::path> store(const std::filesystem::path& folder,
                                         const Fuzzer::Counterexample& counterexample, std::uint64_t seed);

/// Where the chain of a case comes from, in words.
std::string origin_of(const std::string& family, std::uint64_t seed, std::uint64_t number);

std::string chain_file_of(const Chain& chain);

/// The chain of a .chain file, or of any file whose radii are its own. Throws InputError.
Chain load_chain(const std::filesystem::path& file);

}  // namespace catena::properties
