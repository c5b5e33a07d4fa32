#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "catena/properties/fuzz/fuzzer.h"

namespace catena::properties {

/// What `catena fuzz` prints of a finding that is stored in these files. `variants`: those asked for, none
/// when all.
void tell(const Fuzzer::Counterexample& c, std::uint64_t seed,
          const std::vector<std::filesystem::path>& stored, const std::vector<std::string>& variants);

/// What was drawn and reached without a finding.
void summarise(const Fuzzer& fuzzer, double seconds, bool interrupted);

/// Its end: the chains (long ones are left to their files), where they are stored, and the command that runs
/// them again.
void tell_chains(const std::vector<Chain>& chains, const std::vector<std::filesystem::path>& stored,
                 const std::string& variant);

}  // namespace catena::properties
