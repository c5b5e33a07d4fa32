#pragma once
#include <optional>
#include <string>
#include <vector>

#include "catena/properties/property.h"

namespace catena::properties {

/// A chain made from another, and the pairs that it must have if the other's are right.
struct Image {
  Chain chain;
  std::vector<Pair> pairs;  ///< in any order
};

/// A metamorphic relation: it says how the pairs change with the chain, in exact arithmetic, and asks no
/// reference about the changed chain. For exact variants only.
class Relation : public Property {
 public:
  bool applies_to(const Subject& subject) const override { return subject.exact(); }
  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override;

  /// nullopt where the relation says nothing: a number would round, say. The same for the same chain.
  virtual std::optional<Image> image(const Case& test) const = 0;

 private:
  DerivedFrom<std::optional<Image>> expected_;
  Collisions found_;
};

}  // namespace catena::properties
