#pragma once
#include <cstdint>
#include <deque>
#include <functional>
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
  /// Something that does not hold, and what shows it again.
  struct Counterexample {
    Finding finding;
    std::string family;    ///< what the chain was drawn from, "mutated", or "giants"
    std::uint64_t number;  ///< of the case, from 0
    Chain found;
    /// Shown again by one object, made anew, that meets these chains in this order: mostly by one chain.
    /// Shrunk.
    std::vector<Chain> shrunk;
    /// false: no new object shows it, not even after the chains before; `shrunk` is the one that was found.
    bool repeats = true;
  };
  /// Called before a chain is checked: what it was drawn from, the number of its case, the chain.
  using Watch = std::function<void(const std::string& family, std::uint64_t number, const Chain& chain)>;

  Fuzzer(std::vector<Subject> subjects, Options options);
  void watch(Watch each_chain, Suite::Watch each_check);

  /// The next case; nullopt when everything held. The giants come after the first hundred cases.
  std::optional<Counterexample> step();
  /// The giants, if no step had them yet: for the end of a short run.
  std::optional<Counterexample> giants_once();

  const Suite& suite() const { return suite_; }
  const Pool& pool() const { return pool_; }
  std::uint64_t cases() const { return cases_; }
  std::uint64_t long_cases() const { return long_cases_; }  ///< above `size` spheres, but for the giants
  const std::map<std::string, std::uint64_t>& by_family() const { return by_family_; }

 private:
  void begin(const std::string& family, std::uint64_t number, const Chain& chain) const;
  Counterexample counterexample(Finding finding, std::string family, std::uint64_t number, Chain chain) const;

  Options options_;
  Suite suite_;
  Watch watch_;
  Suite::Watch watch_check_;
  std::unique_ptr<Variant> tree_;
  InterestMeter meter_;
  Pool pool_;
  std::deque<Chain> before_;  // the last chains, but for giants
  bool had_giants_ = false;
  std::uint64_t cases_ = 0, long_cases_ = 0;
  std::map<std::string, std::uint64_t> by_family_;
};

}  // namespace catena::properties
