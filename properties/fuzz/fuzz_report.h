#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "catena/properties/fuzz/fuzzer.h"

namespace catena::properties {

/// What `catena fuzz` prints of a finding, before it is stored: that may fail.
void tell(const Fuzzer::Counterexample& c, std::uint64_t seed);

/// What was drawn and reached without a finding.
void summarise(const Fuzzer& fuzzer, double seconds, bool interrupted);

/// Chains; long ones are left to their files.
void tell_chains(const std::vector<Chain>& chains);

/// Where they are stored, and the command that runs them again; with this variant alone, unless it is empty.
void tell_stored(const std::vector<std::filesystem::path>& stored, const std::string& variant);

}  // namespace catena::properties
