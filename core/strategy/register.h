#pragma once
#include <concepts>
#include <memory>
#include <type_traits>
#include <typeindex>

#include "catena/core/arithmetic/arithmetic_policy.h"
#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/strategy/composed.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/resident.h"

namespace catena {

/// How a strategy file registers itself: one object of one of these at namespace scope.
///
///     namespace {
///     template <class Arithmetic>
///     class CPU2 : public Traversal<HierarchyView<typename Arithmetic::Bound>> { ... };
///     const RegisterTraversal<CPU2, Robust, Literal, Double> registered{{"CPU2", "each sphere against
///     ..."}};
///     }
///
/// The class is made from the strategy's Parameters when it has such a constructor, else from nothing.
template <class Strategy, class Base>
std::unique_ptr<Base> make_strategy(const Parameters& parameters) {
  if constexpr (std::constructible_from<Strategy, const Parameters&>)
    return std::make_unique<Strategy>(parameters);
  else
    return std::make_unique<Strategy>();
}

/// What the registry says of an arithmetic.
template <ArithmeticPolicy Arithmetic>
ArithmeticInfo arithmetic_info() {
  return {Arithmetic::name, Arithmetic::exact};
}

/// Which tree type a stage has is read off its base.
template <class Tree>
StrategyRegistry::TreeType tree_type() {
  return {std::type_index(typeid(Tree)), Movable<Tree>,
          [](std::unique_ptr<Stage> build, Place build_place, std::unique_ptr<Stage> find, Place find_place,
             std::unique_ptr<Device> device) -> std::unique_ptr<Variant> {
            return std::make_unique<Composed<Tree>>(
                std::unique_ptr<Construction<Tree>>(static_cast<Construction<Tree>*>(build.release())),
                build_place, std::unique_ptr<Traversal<Tree>>(static_cast<Traversal<Tree>*>(find.release())),
                find_place, std::move(device));
          }};
}
template <class Tree>
StrategyRegistry::TreeType tree_type_of(const Construction<Tree>*) {
  return tree_type<Tree>();
}
template <class Tree>
StrategyRegistry::TreeType tree_type_of(const Traversal<Tree>*) {
  return tree_type<Tree>();
}

/// A first stage, in several arithmetics.
template <template <class> class Strategy, ArithmeticPolicy... Arithmetics>
struct RegisterConstruction {
  explicit RegisterConstruction(const StrategyInfo& info) {
    (StrategyRegistry::instance().add_construction(
         info, arithmetic_info<Arithmetics>(),
         tree_type_of(static_cast<const Strategy<Arithmetics>*>(nullptr)),
         make_strategy<Strategy<Arithmetics>, Stage>),
     ...);
  }
};

/// A second stage, in several arithmetics.
template <template <class> class Strategy, ArithmeticPolicy... Arithmetics>
struct RegisterTraversal {
  explicit RegisterTraversal(const StrategyInfo& info) {
    (StrategyRegistry::instance().add_traversal(
         info, arithmetic_info<Arithmetics>(),
         tree_type_of(static_cast<const Strategy<Arithmetics>*>(nullptr)),
         make_strategy<Strategy<Arithmetics>, Stage>),
     ...);
  }
};

/// A variant complete in itself, in several arithmetics.
template <template <class> class Whole, ArithmeticPolicy... Arithmetics>
struct RegisterVariant {
  explicit RegisterVariant(StrategyInfo info) {
    info.resident = (std::is_base_of_v<ResidentSearch, Whole<Arithmetics>> && ...);
    (StrategyRegistry::instance().add_variant(info, arithmetic_info<Arithmetics>(),
                                              make_strategy<Whole<Arithmetics>, Variant>),
     ...);
  }
};

}  // namespace catena
