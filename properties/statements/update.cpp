#include <fmt/format.h>

#include <vector>

#include "catena/properties/property.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/statements/moved_frame.h"
#include "catena/reference/compare.h"

namespace catena::properties {
namespace {

/// update(moved) gives what build(moved) would: the same bounds bit for bit, the same pairs, which are the
/// exact ones where they must be; and back again.
class Update final : public Property {
 public:
  std::string name() const override { return "update is build"; }

  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override {
    const auto fresh = subject.make();
    variant.build(test.chain);
    for (const Case& moved : frames_of(test)) {
      variant.update(moved.chain);
      fresh->build(moved.chain);
      if (auto difference = compare(*fresh, variant, moved, subject.exact())) return difference;
      variant.update(test.chain);
      fresh->build(test.chain);
      if (auto difference = compare(*fresh, variant, test, subject.exact()))
        return "on the way back: " + *difference;
    }
    return std::nullopt;
  }

 private:
  /// Every bound of a hierarchy as shown.
  class Bounds final : public BoundsVisitor {
   public:
    void sphere(std::uint32_t parent, const Sphere64& of_parent, std::uint32_t child,
                const Sphere64& of_child) override {
      shown.push_back({parent, child, of_parent, of_child});
    }
    struct Bound {
      std::uint32_t parent, child;
      Sphere64 of_parent, of_child;
    };
    std::vector<Bound> shown;
  };

  const std::vector<Case>& frames_of(const Case& test) {
    return frames_(test, [&] {
      std::vector<Case> frames;
      for (const auto frame : {moved_frame, thinned_frame, anchored_frame})
        frames.push_back(Case::of(frame(test.chain)));
      return frames;
    });
  }

  std::optional<std::string> compare(Variant& built, Variant& updated, const Case& frame, bool exact) {
    Bounds of_built, of_updated;
    built.visit_bounds(of_built);
    updated.visit_bounds(of_updated);
    if (of_built.shown.size() != of_updated.shown.size())
      return fmt::format("{} bounds after update, {} after build", of_updated.shown.size(),
                         of_built.shown.size());
    for (std::size_t k = 0; k < of_built.shown.size(); ++k)
      if (!same(of_built.shown[k], of_updated.shown[k]))
        return fmt::format("bound {} of {} differs from that of build", of_updated.shown[k].parent,
                           of_updated.shown[k].child);
    built.find(frame.chain, {}, built_);
    updated.find(frame.chain, {}, updated_);
    sort(built_.pairs);
    sort(updated_.pairs);
    if (exact && !reference::compare(frame.chain, frame.exact, updated_).right())
      return "after update the answer is not exact";
    if (built_.pairs != updated_.pairs || built_.count != updated_.count)
      return fmt::format("{} pairs after update, {} after build", updated_.pair_count, built_.pair_count);
    return std::nullopt;
  }

  /// NaN of a literal parent equals NaN.
  static bool same(const Bounds::Bound& a, const Bounds::Bound& b) {
    const auto number = [](double p, double q) { return p == q || (p != p && q != q); };
    const auto sphere = [&](const Sphere64& p, const Sphere64& q) {
      return number(p.x, q.x) && number(p.y, q.y) && number(p.z, q.z) && number(p.radius, q.radius);
    };
    return a.parent == b.parent && a.child == b.child && sphere(a.of_parent, b.of_parent) &&
           sphere(a.of_child, b.of_child);
  }

  DerivedFrom<std::vector<Case>> frames_;
  Collisions built_, updated_;
};

const RegisterProperty<Update> registered;

}  // namespace
}  // namespace catena::properties
