#pragma once
#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/strategy/register.h"
#include "catena/properties/mutants/counted_for.h"
#include "catena/properties/mutants/faulty_tree.h"

namespace catena::properties {

template <class Whole>
void register_hidden(StrategyInfo info) {
  if (std::derived_from<Whole, FaultyTree>) info.has_tree = true, info.promises = {true, true};
  StrategyRegistry::instance().add_variant(info, arithmetic_info<Robust>(), make_strategy<Whole, Variant>,
                                           true);
}

template <class Base>
bool base_is_registered = false;

/// One object of this at namespace scope puts a bug into the museum: hidden from every list, made by its name
/// "mutant:...", and killed by the suite (mutants_test.cpp). `imitates` says where the bug was real, or what
/// it is. Mutant::Base is what it is made of, right without the bug: the first mutant of each registers it,
/// by the name "base:..." of that mutant, and the suite must find nothing wrong with it.
template <class Mutant>
struct RegisterMutant {
  RegisterMutant(const std::string& name, const std::string& imitates,
                 const std::vector<ParameterInfo>& parameters = {}, Fault fault = Fault::answer) {
    using Base = typename Mutant::Base;
    static_assert(std::derived_from<Mutant, Base> && !std::same_as<Mutant, Base>);
    register_hidden<Mutant>({.name = "mutant:" + name, .summary = imitates, .parameters = parameters});
    if (fault == Fault::allocation) allocating_mutants().insert("mutant:" + name);
    if (!std::exchange(base_is_registered<Base>, true))
      register_hidden<Base>({.name = "base:" + name, .summary = "no mutant", .parameters = parameters});
  }
};

}  // namespace catena::properties
