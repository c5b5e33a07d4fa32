#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "catena/properties/property.h"
#include "catena/properties/shown_bounds.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/statements/moved_frame.h"
#include "catena/reference/compare.h"
#include "catena/reference/enclosure.h"

namespace catena::properties {
namespace {

/// update(moved) gives what build(moved) would: the same pairs, which are the exact ones where they must be,
/// a tree of the same shape, and bounds that enclose; the same bounds bit for bit where the strategy promises
/// it. So does an update that is told which spheres moved, and the way back.
class Update final : public Property {
 public:
  std::string name() const override { return "update is build"; }

  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override {
    const auto fresh = subject.make();
    variant.build(test.chain);
    for (const Frame& frame : frames_of(test)) {
      const Moved moved = frame.whole ? Moved() : Moved(frame.ranges);
      variant.update(frame.moved.chain, moved);
      fresh->build(frame.moved.chain);
      if (auto difference = compare(subject, *fresh, variant, frame.moved))
        return (frame.whole ? "" : "told what moved: ") + *difference;
      variant.update(test.chain, moved);
      fresh->build(test.chain);
      if (auto difference = compare(subject, *fresh, variant, test)) return "on the way back: " + *difference;
    }
    return std::nullopt;
  }

 private:
  struct Frame {
    Case moved;
    bool whole;                       ///< the variant is told that everything may have moved
    std::vector<SphereRange> ranges;  ///< else these
  };

  const std::vector<Frame>& frames_of(const Case& test) {
    return frames_(test, [&] {
      std::vector<Frame> frames;
      for (const auto frame : {moved_frame, thinned_frame, anchored_frame, shaken_frame})
        frames.push_back({Case::of(frame(test.chain)), true, {}});
      auto [chain, ranges] = partly_moved_frame(test.chain);
      frames.push_back({Case::of(std::move(chain)), false, std::move(ranges)});
      frames.push_back({Case::of(test.chain), false, {}});  // nothing moved
      return frames;
    });
  }

  std::optional<std::string> compare(const Subject& subject, Variant& built, Variant& updated,
                                     const Case& frame) {
    const ShownBounds of_built(built), of_updated(updated);
    if (of_built.edges() != of_updated.edges())
      return "the tree after update has another shape than after build";
    if (subject.info.promises.same_bits && !of_built.same_bits(of_updated))
      return "a bound after update differs from that of build";
    if (subject.exact()) {
      reference::EnclosureChecker checker(frame.chain);
      updated.visit_bounds(checker);
      if (const auto report = checker.report(); report.violations > 0)
        return fmt::format("{} of {} bounds do not enclose after update", report.violations, report.bounds);
    }
    built.find(frame.chain, {}, built_);
    updated.find(frame.chain, {}, updated_);
    sort(built_.pairs);
    sort(updated_.pairs);
    if (subject.exact() && !reference::compare(frame.chain, frame.exact, updated_).right())
      return "after update the answer is not exact";
    if (built_.pairs != updated_.pairs || built_.count != updated_.count)
      return fmt::format("{} pairs after update, {} after build", updated_.pair_count, built_.pair_count);
    return std::nullopt;
  }

  DerivedFrom<std::vector<Frame>> frames_;
  Collisions built_, updated_;
};

const RegisterProperty<Update> registered;

}  // namespace
}  // namespace catena::properties
