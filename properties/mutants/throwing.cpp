#include <stdexcept>

#include "catena/properties/mutants/mutant.h"

// Bugs that end in an exception: whoever runs a variant must say whose it is.
namespace catena::properties {
namespace {

class ThrowsOnLong final : public FaultyTree {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (chain.size() > 32) throw std::out_of_range("stack slot 32 of 32");
    FaultyTree::find(chain, request, result);
  }
};
const RegisterMutant<ThrowsOnLong> throws_on_long{"throws-past-32-spheres",
                                                  "a checked container in place of a stack that overflows"};

class ThrowsANumber final : public FaultyTree {
  void build(const Chain& chain) override {
    if (chain.strand_count() > 1) throw 7;
    FaultyTree::build(chain);
  }
};
const RegisterMutant<ThrowsANumber> throws_a_number{
    "throws-a-number", "an error code thrown as it is, which no std::exception catches"};

}  // namespace
}  // namespace catena::properties
