#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "catena/properties/generators/draft.h"

namespace catena::properties {

/// Chains a little simpler than a given one, the boldest first: runs of spheres taken out (the tube joined or cut there), the rule made
/// plainer, the whole moved to the origin or to scale 1, all numbers of one value or single ones made rounder. Each is simpler by one
/// measure (fewer spheres, then a plainer rule, then fewer significant bits and smaller exponents), so taking
/// any of them again and again comes to an end.
class Simplifications {
 public:
  explicit Simplifications(const Chain& chain);

  /// nullopt when there are no more. Each is a valid chain.
  std::optional<Chain> next();

 private:
  struct Edit {
    enum class Kind { remove, cut, rule, to_origin, to_scale, equal_numbers, number } kind;
    std::uint32_t at = 0,
                  how = 0;  ///< remove: first and count; rule: which; number: 4 * sphere + member, which
  };
  std::optional<Draft> apply(const Edit& edit) const;
  std::optional<Draft> plainer_rule(std::uint32_t how) const;
  std::optional<Draft> rounder_number(std::uint32_t at, std::uint32_t how, bool equal_too) const;

  Draft draft_;
  std::vector<Edit> edits_;
  std::size_t next_ = 0;
};

/// True when `a` is simpler than `b` by that measure.
bool simpler(const Chain& a, const Chain& b);

/// The simplest chain found that still fails: what a counterexample is reported as. `fails(chain)` holds at
/// the start; it is asked at most `tries` times.
Chain shrink(Chain chain, const std::function<bool(const Chain&)>& fails, std::uint32_t tries = 20'000);

}  // namespace catena::properties
