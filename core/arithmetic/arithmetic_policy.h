#pragma once
#include <concepts>

#include "catena/core/hierarchy/radius_range.h"
#include "catena/core/sphere.h"

namespace catena {

/// The decisions of a search, static functions for host and device. `Bound` is what a sphere is compared as.
///
///     bound(sphere)             its bound, without rounding
///     separate(a, b)            true: they do not overlap, for certain; a cheap test before overlap()
///     overlap(a, b)             whether two spheres collide, as this arithmetic has it; touching counts
///     may_overlap(query, node)  false: the query overlaps no sphere below the node
template <class Tests>
concept OverlapTests = requires(const Sphere& sphere, const typename Tests::Bound& a,
                                const typename Tests::Bound& b) {
  { Tests::bound(sphere) } -> std::same_as<typename Tests::Bound>;
  { Tests::separate(a, b) } -> std::same_as<bool>;
  { Tests::overlap(a, b) } -> std::same_as<bool>;
  { Tests::may_overlap(a, b) } -> std::same_as<bool>;
};

/// How a strategy computes, its template parameter `Arithmetic`: Robust, Literal, Double, or one of your own.
///
///     name, exact      as in VariantInfo: what is written after the '/', whether nothing excuses its answer
///     parent(a, b)     the bound of two nodes' parent; when exact, it encloses all that they do
///     in_range(radii)  true: InRange decides the same as this arithmetic for a chain of such radii
///     InRange          the tests without range checks; the arithmetic itself when it has none
template <class Arithmetic>
concept ArithmeticPolicy = OverlapTests<Arithmetic> && OverlapTests<typename Arithmetic::InRange> &&
    std::same_as<typename Arithmetic::Bound, typename Arithmetic::InRange::Bound> &&
    requires(const typename Arithmetic::Bound& a, const typename Arithmetic::Bound& b,
             const RadiusRange& radii) {
  { Arithmetic::name } -> std::convertible_to<const char*>;
  { Arithmetic::exact } -> std::convertible_to<bool>;
  { Arithmetic::parent(a, b) } -> std::same_as<typename Arithmetic::Bound>;
  { Arithmetic::in_range(radii) } -> std::same_as<bool>;
};

}  // namespace catena
