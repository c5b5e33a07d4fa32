#pragma once
#include <set>
#include <string>

#include "catena/properties/allocations.h"

namespace catena::properties {

/// What is wrong with a mutant: what it answers or says of itself, or that it allocates.
enum class Fault { answer, allocation };

/// The names of mutants of the second kind.
std::set<std::string>& allocating_mutants();

/// While it lives, allocations are counted for such a mutant only: no other one is to be killed by those that
/// are made around its fault.
class CountedFor {
 public:
  explicit CountedFor(const std::string& mutant);
  ~CountedFor() { Allocations::counter() = counter_; }
  CountedFor(const CountedFor&) = delete;
  CountedFor& operator=(const CountedFor&) = delete;

 private:
  const Allocations::Read counter_ = Allocations::counter();
};

}  // namespace catena::properties
