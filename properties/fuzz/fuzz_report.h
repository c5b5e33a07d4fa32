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

/// A chain as it is printed: long ones are left to their file.
std::string printed(const Chain& chain);

}  // namespace catena::properties
