#include "catena/properties/mutants/counted_for.h"

namespace catena::properties {

std::set<std::string>& allocating_mutants() {
  static std::set<std::string> names;
  return names;
}

CountedFor::CountedFor(const std::string& mutant) {
  if (!allocating_mutants().contains(mutant)) Allocations::counter() = nullptr;
}

}  // namespace catena::properties
