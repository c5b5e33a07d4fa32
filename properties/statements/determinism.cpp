#include <fmt/format.h>

#include "catena/properties/pair_set_hash.h"
#include "catena/properties/property.h"

namespace catena::properties {
namespace {

/// The same chain gives the same answer again: on a used object, on a fresh one, and after another chain;
/// counts and totals like pairs. The order of pairs is free (a device may give them as they come), so their
/// canonical hash is compared.
class Determinism final : public Property {
 public:
  std::string name() const override { return "same answer again"; }

  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override {
    const Answer used = answer(variant, test.chain);
    if (answer(variant, test.chain) != used) return "another answer in the second run";
    const auto fresh = subject.make();
    if (answer(*fresh, test.chain) != used) return "another answer from a fresh object";
    answer(variant, other_);
    if (answer(variant, test.chain) != used) return "another answer after another chain";
    return std::nullopt;
  }

 private:
  struct Answer {
    std::uint64_t pairs, pair_count;
    bool found;
    std::vector<std::uint32_t> count;
    bool operator==(const Answer&) const = default;
  };

  Answer answer(Variant& variant, const Chain& chain) {
    variant.build(chain);
    variant.find(chain, {}, found_);
    return {pair_set_hash(found_.pairs), found_.pair_count, found_.found, found_.count};
  }

  /// Three spheres at one place: what a stale buffer would remember.
  const Chain other_{std::vector<Sphere>(3, Sphere{0, 0, 0, 1})};
  Collisions found_;
};

const RegisterProperty<Determinism> registered;

}  // namespace
}  // namespace catena::properties
