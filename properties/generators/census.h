#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "catena/properties/property.h"

namespace catena::properties {

/// What is special about a chain, told from the chain itself and not from how it was drawn.
enum class Trait : std::uint8_t {
  colliding,        ///< at least one pair
  free,             ///< two spheres or more, no pair
  dense,            ///< more pairs than spheres
  touching,         ///< two spheres that are no neighbours touch exactly
  nearly_touching,  ///< ... miss touching by less than 2^-20 of (rA + rB)^2
  coincident,       ///< two centres at one place
  zero_radius,      ///< a point
  denormal,         ///< a number below the normal range
  huge,             ///< a number above 2^100
  separated,        ///< numbers more than 1e30 apart in scale
  several_strands,
  closed,
  wide_window,
  arc_window,
  extra_pairs,
  power_of_two,  ///< n >= 4 is one, or one off
  block_limit,   ///< n is 384, 768 or 1,536, or one off
  count
};
std::string_view name_of(Trait);

/// How often each family and each trait was hit, and whether that is enough.
class Census {
 public:
  void add(const std::string& family, const Case& test);

  std::uint64_t chains() const { return chains_; }
  std::uint64_t of(Trait trait) const { return traits_[static_cast<std::size_t>(trait)]; }
  /// A small table, one line a family or trait.
  std::string report() const;
  /// Every trait seen in fewer chains than its quota, every registered family never drawn; empty when all is
  /// well.
  std::vector<std::string> missed() const;

 private:
  std::uint64_t chains_ = 0;
  std::map<std::string, std::uint64_t> families_;
  std::array<std::uint64_t, static_cast<std::size_t>(Trait::count)> traits_{};
};

}  // namespace catena::properties
