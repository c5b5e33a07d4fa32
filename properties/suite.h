#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catena/properties/property.h"

namespace catena::properties {

/// One property that does not hold for one variant on one chain.
struct Finding {
  std::string variant, property, what;
};

/// Properties over variants. Each variant is made once and meets all chains, as in use; so do the properties'
/// scratch buffers. One thread at a time.
class Suite {
 public:
  struct Tally {
    std::uint64_t chains = 0, checks = 0, refusals = 0;  ///< a refusal is a CapacityError: a declared limit
  };

  /// All registered properties, on these subjects. Throws what their `make` throws.
  explicit Suite(std::vector<Subject> subjects);

  /// Every property on every variant it applies to; the first that does not hold, or throws. All-pairs
  /// variants are left out above 600 spheres.
  std::optional<Finding> check(const Case& test);
  /// The same, but of the properties that are not for every chain only the one whose `turn` it is, and
  /// rounded arithmetic one time in four: what fuzzing has time for.
  std::optional<Finding> check_some(const Case& test, std::uint64_t turn);
  /// Every property on every variant it applies to; everything that does not hold.
  std::vector<Finding> check_all(const Case& test);
  /// True when that property still does not hold for that variant on this chain; the variant is made afresh.
  bool repeats(const Finding& finding, const Chain& chain) const;

  /// What is asked of every chain, of the exact variants alone: for the giants. The first that does not hold.
  std::optional<Finding> check_always(const Case& test);

  /// Called before each check: this variant is about to be held against this property.
  using Watch = std::function<void(const Subject&, const Property&)>;
  void watch(Watch watch) { watch_ = std::move(watch); }

  const Tally& tally() const { return tally_; }
  std::vector<std::string> variants() const;
  Subject subject(const std::string& variant) const;  ///< one of them

 private:
  struct Runner {
    Subject subject;
    std::unique_ptr<Variant> variant;
  };
  std::optional<Finding> check(Property& property, Runner& runner, const Case& test);
  static std::optional<std::string> failure(Property& property, const Subject& subject, Variant& variant,
                                            const Case& test);

  std::vector<Runner> runners_;
  std::vector<std::unique_ptr<Property>> always_, in_turn_;
  Tally tally_;
  Watch watch_;
};

}  // namespace catena::properties
