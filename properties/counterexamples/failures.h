#pragma once
#include <optional>
#include <string>
#include <vector>

#include "catena/properties/counterexamples/observed.h"

namespace catena::properties {

/// One way in which the paper's formulas fail.
struct Failure {
  std::string name;  ///< "parent-does-not-enclose"
  std::string what;  ///< the same as a sentence
  /// Where on this chain, and by how much; nullopt when it does not fail like this.
  std::optional<std::string> (*on)(const Observed&);
};

/// All of them: first those of a parent, then those of a pair.
const std::vector<Failure>& failures();

}  // namespace catena::properties
