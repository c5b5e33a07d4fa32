#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/properties/counterexamples/failures.h"

namespace catena::properties {

/// The simplest chain found on which an arithmetic fails in one way.
struct Counterexample {
  std::string arithmetic;
  const Failure* failure;
  Chain chain;
  std::string where;            ///< what the failure says of the chain
  std::uint64_t witnesses = 0;  ///< chains drawn that fail like this
};

/// Draws `cases` chains of up to `size` spheres from every family, shrinks the first few that fail in each
/// way, and keeps the simplest of each: no simplification of it (generators/simplifications.h) fails in the
/// same way. The same for the same seed. Failures without a witness are left out. Throws std::logic_error
/// when robust arithmetic is not exact on one.
std::vector<Counterexample> smallest_counterexamples(const std::string& arithmetic, std::uint64_t cases,
                                                     std::uint64_t seed, std::uint32_t size = 8);

/// The chain with what fails as comments, as it is stored. `arithmetic-failure.chain` is the name of such a
/// file.
std::string text_of(const Counterexample& counterexample);
std::string file_name_of(const Counterexample& counterexample);

}  // namespace catena::properties
