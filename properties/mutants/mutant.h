#pragma once
#include <concepts>
#include <memory>
#include <string>
#include <vector>

#include "catena/core/strategy/register.h"
#include "catena/properties/mutants/faulty_tree.h"

namespace catena::properties {

/// One object of this at namespace scope puts a bug into the museum: hidden from every list, made by its name
/// "mutant:...", and killed by the suite (mutants_test.cpp). `imitates` says where the bug was real, or what
/// it is.
template <class Mutant>
struct RegisterMutant {
  RegisterMutant(const std::string& name, const std::string& imitates,
                 const std::vector<ParameterInfo>& parameters = {}) {
    StrategyInfo info;
    info.name = "mutant:" + name;
    info.summary = imitates;
    info.parameters = parameters;
    if (std::derived_from<Mutant, FaultyTree>) info.has_tree = true, info.promises = {true, true};  // as their base keeps
    StrategyRegistry::instance().add_variant(info, arithmetic_info<Robust>(), make_strategy<Mutant, Variant>, true);
  }
};

}  // namespace catena::properties
