#pragma once
#include "catena/core/strategy/register.h"

namespace catena::test {

/// One object of this at namespace scope lets tests name a variant of their own, which no list has.
template <class Whole>
struct RegisterHidden {
  explicit RegisterHidden(const StrategyInfo& info) {
    StrategyRegistry::instance().add_variant(info, arithmetic_info<Robust>(), make_strategy<Whole, Variant>,
                                             true);
  }
};

}  // namespace catena::test
