#pragma once
#include <concepts>
#include <memory>

#include "catena/core/strategy/registry.h"

namespace catena {

/// How a strategy file registers itself: one object of one of these at namespace scope.
///
///     namespace {
///     template <class Arithmetic> class CPU2 : public Traversal<typename Arithmetic::Bound> { ... };
///     const RegisterTraversal<CPU2, Robust, Literal, Double> registered{{"CPU2", "each sphere against
///     ..."}};
///     }
///
/// The class is made from the strategy's Parameters when it has such a constructor, else from nothing.
template <class Stage, class Base>
std::unique_ptr<Base> make_strategy(const Parameters& parameters) {
  if constexpr (std::constructible_from<Stage, const Parameters&>)
    return std::make_unique<Stage>(parameters);
  else
    return std::make_unique<Stage>();
}

template <template <class> class Stage, class... Arithmetics>
struct RegisterConstruction {
  explicit RegisterConstruction(const StrategyInfo& info) {
    (StrategyRegistry::instance().add_construction<Arithmetics>(
         info, make_strategy<Stage<Arithmetics>, Construction<typename Arithmetics::Bound>>),
     ...);
  }
};

template <template <class> class Stage, class... Arithmetics>
struct RegisterTraversal {
  explicit RegisterTraversal(const StrategyInfo& info) {
    (StrategyRegistry::instance().add_traversal<Arithmetics>(
         info, make_strategy<Stage<Arithmetics>, Traversal<typename Arithmetics::Bound>>),
     ...);
  }
};

/// A variant complete in itself, in several arithmetics.
template <template <class> class Whole, class... Arithmetics>
struct RegisterVariant {
  explicit RegisterVariant(const StrategyInfo& info) {
    (StrategyRegistry::instance().add_variant(info, Arithmetics::name,
                                              make_strategy<Whole<Arithmetics>, Variant>),
     ...);
  }
};

}  // namespace catena
