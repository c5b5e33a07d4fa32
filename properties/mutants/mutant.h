#pragma once
#include <memory>
#include <string>

#include "catena/core/strategy/registry.h"
#include "catena/properties/mutants/faulty_tree.h"

namespace catena::properties {

/// One object of this at namespace scope puts a bug into the museum: hidden from every list, made by its name
/// "mutant:...", and killed by the suite (mutants_test.cpp). `imitates` says where the bug was real, or what
/// it is.
template <class Mutant>
struct RegisterMutant {
  RegisterMutant(const std::string& name, const std::string& imitates) {
    StrategyInfo info;
    info.name = "mutant:" + name;
    info.summary = imitates;
    StrategyRegistry::instance().add_variant(
        info, Robust::name, [](const Parameters&) { return std::make_unique<Mutant>(); }, true);
  }
};

}  // namespace catena::properties
