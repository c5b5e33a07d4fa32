#pragma once
#include <optional>
#include <string>
#include <vector>

#include "catena/properties/property.h"

namespace catena::properties {

/// The variant's name with these parameters set in each of its strategies that declares them and does not set
/// them yet: "aGPU2@host+CPU2" with subtree = 6 is "aGPU2@host(subtree=6)+CPU2". nullopt when no strategy
/// takes any.
std::optional<std::string> with_settings(const std::string& variant, const std::vector<Setting>& settings);

/// The subjects again with the smallest subtrees, blocks and crowds, and with what frames have in common used always,
/// where they have such parameters, so that short chains meet every stage and every declared limit. A strategy joins by
/// naming its parameters `subtree`, `block`, `crowd` or `frames`.
std::vector<Subject> in_small_blocks(const std::vector<Subject>& subjects);

}  // namespace catena::properties
