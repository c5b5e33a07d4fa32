#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "catena/properties/suite.h"

namespace catena::properties {

/// Whether the property fails on one of these chains when one new object of the subject meets them in this
/// order, with every property asked of each: what `catena fuzz --replay` does.
bool fails_in_sequence(const Subject& subject, const std::string& property, const std::vector<Chain>& chains,
                       const Suite::Watch& watch = {});

/// The fewest and simplest chains found of which `fails` still holds; nullopt when it does not of `chains`.
/// Some hundred tries.
std::optional<std::vector<Chain>> shortest_sequence(
    std::vector<Chain> chains, const std::function<bool(const std::vector<Chain>&)>& fails);

/// The fewest and simplest chains found that still fail so; nullopt when `chains` themselves do not. For
/// errors that depend on what an object met before. Some hundred tries.
std::optional<std::vector<Chain>> shortest_sequence(const Subject& subject, const std::string& property,
                                                    std::vector<Chain> chains,
                                                    const Suite::Watch& watch = {});

}  // namespace catena::properties
