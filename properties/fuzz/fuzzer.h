#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "catena/properties/fuzz/interest.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/suite.h"

namespace catena::properties {

/// Draws chains of every family, or mutates the most interesting ones so far, and asks the suite of each. The
/// chain of a case depends on seed and case number, and for mutated ones on those before.
class Fuzzer {
 public:
  struct Options {
    std::uint64_t seed = 1;
    std::uint32_t size = 64;            ///< most spheres a chain
    std::uint32_t long_size = 640;      ///< of one chain in 200; no more than `size`: there are none
    std::vector<Family> families = {};  ///< none: all
    bool shrink = true;                 ///< false: a counterexample is left as it was found
  };
  struct Counterexample {
    Finding finding;
    std::string family;    ///< what it was drawn from, or "mutated"
    std::uint64_t number;  ///< of the case, from 0
    Chain found, shrunk;
  };

  Fuzzer(std::vector<Subject> subjects, Options options);

  /// The next case; nullopt when everything held.
  std::optional<Counterexample> step();

  const Suite& suite() const { return suite_; }
  const Pool& pool() const { return pool_; }
  std::uint64_t cases() const { return cases_; }
  std::uint64_t long_cases() const { return long_cases_; }  ///< above `size` spheres
  const std::map<std::string, std::uint64_t>& by_family() const { return by_family_; }

 private:
  Counterexample counterexample(Finding finding, std::string family, Chain chain) const;

  Options options_;
  Suite suite_;
  std::unique_ptr<Variant> tree_;
  InterestMeter meter_;
  Pool pool_;
  std::uint64_t cases_ = 0, long_cases_ = 0;
  std::map<std::string, std::uint64_t> by_family_;
};

}  // namespace catena::properties
