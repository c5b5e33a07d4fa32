#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/draft.h"

namespace catena::properties {

/// One class of chains worth testing, self-registered by the file that makes them.
struct Family {
  std::string name, summary;
  /// Spheres, strands and rule of one chain of 1 to `size` spheres, size >= 1. Every number finite, radii >=
  /// 0.
  Draft (*draw)(Dice&, std::uint32_t size);
  /// True when the family is about strands or the exclusion rule itself: then `generate` leaves them alone.
  bool sets_rule = false;
};

class FamilyRegistry {
 public:
  static FamilyRegistry& instance();
  void add(Family family) { families_.push_back(std::move(family)); }
  std::vector<Family> families() const;        ///< sorted by name
  Family family(std::string_view name) const;  ///< throws InputError that names those there are

 private:
  std::vector<Family> families_;
};

/// One chain of a family with at most `size` spheres (at least 1), the same for the same dice. One chain in
/// four of a family that does not set them gets other strands, neighbours or extra pairs, so that shapes meet
/// rules. Microseconds for n <= 64.
Chain generate(const Family& family, Dice& dice, std::uint32_t size);

/// One object of this at namespace scope registers a family.
struct RegisterFamily {
  RegisterFamily(std::string name, std::string summary, Draft (*draw)(Dice&, std::uint32_t),
                 bool sets_rule = false) {
    FamilyRegistry::instance().add({std::move(name), std::move(summary), draw, sets_rule});
  }
};

}  // namespace catena::properties
