#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "catena/properties/property.h"

// What the properties about calls in any order draw from, and what each call is to be answered.
namespace catena::properties {

/// A chain that a script of calls may take, with its answer.
struct Shot {
  Case test;
  int film;  ///< those of one number are frames of one another
  std::optional<std::int64_t>
      along;  ///< this many spheres on along the film's first frame, where it is no other
};

/// The chain, frames of it, another chain and its frame, and one of no spheres; answered by `solve`.
std::vector<Shot> shots_of(const Chain& chain, const std::function<Case(Chain)>& solve = Case::of);

/// The same numbers for the same chain, so that a failure shows again.
std::uint64_t seed_of(const Chain& chain);

/// Where two frames differ, and sometimes a sphere more on either side.
std::vector<SphereRange> changes(const Chain& from, const Chain& to, bool wider);

const char* word(Request::Want want);

/// What a request for some spheres is to be answered.
struct Expected {
  std::vector<std::uint32_t> count;
  std::vector<Pair> pairs;
};
Expected expected(const Case& test, const SphereRange& queries);

/// What is wrong with an answer, if anything is; sorts its pairs.
std::optional<std::string> fault_of(Collisions& found, Request::Want want, const Expected& right);

}  // namespace catena::properties
