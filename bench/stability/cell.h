#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/variant.h"
#include "catena/core/strategy/variant_info.h"
#include "catena/reference/answer.h"
#include "catena/reference/verify.h"

namespace catena::bench {

/// What a variant makes of a chain, from best to worst.
enum class Outcome {
  exact,        ///< the right pairs, and every bound encloses
  unavailable,  ///< it cannot run on this machine
  refused,      ///< the chain is past a declared limit of the variant
  undecided,    ///< the machine had too little memory, or threads, to see what it answers
  unenclosed,   ///< the right pairs, by luck: some bounds do not enclose
  wrong,        ///< pairs missing or invented
  not_finite    ///< nodes that are not numbers, whatever the pairs
};
std::string name_of(Outcome outcome);

/// One cell of the stability matrix: a scene and a variant.
struct Cell {
  std::string scene, variant;
  std::string arithmetic;  ///< as in VariantInfo
  std::uint32_t spheres = 0;
  std::uint64_t exact_pairs = 0;
  Outcome outcome = Outcome::exact;
  bool defect = false;                 ///< a bug: what the variant's arithmetic does not excuse
  std::uint64_t not_finite_nodes = 0;  ///< see NotFiniteNodes
  reference::Verification found;
  bool answered = true;  ///< false: the exact answer was not asked for, `exact_pairs` says nothing
};

/// Runs a variant on a chain and holds it against the exact answer.
Cell measure(const std::string& scene, const VariantInfo& info, Variant& variant, const Chain& chain,
             const reference::Answer& exact);

/// A cell for a variant that cannot run here.
Cell unavailable(const std::string& scene, const VariantInfo& info, const Chain& chain,
                 const reference::Answer& exact, std::string why);

/// Every scene at n spheres: those that strain something in each of their settings, the others at their
/// defaults.
std::vector<std::string> stability_scenes(std::uint32_t n);

}  // namespace catena::bench
