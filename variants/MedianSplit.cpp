#include <algorithm>

#include "catena/core/hierarchy/box_tree_builder.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// Median split: the spheres of a node are parted in halves across the longest side of the box of their
/// centres, from the top down. Every leaf but the last is full. O(n log n).
template <class Arithmetic>
class MedianSplit final : public Construction<BoxTree> {
 public:
  explicit MedianSplit(const Parameters& parameters) : builder_(parameters) {}

  void build(const ChainView& chain) override {
    BoxTree::Item* const items = builder_.items(chain).data();
    const std::uint32_t leaf = builder_.leaf();
    builder_.build([&](std::uint32_t begin, std::uint32_t end) {
      const std::uint32_t leaves = (end - begin - 1) / leaf + 1, middle = begin + leaves / 2 * leaf;
      float Sphere::*const axis = longest_side(items + begin, items + end);
      std::nth_element(
          items + begin, items + middle, items + end,
          [axis](const BoxTree::Item& a, const BoxTree::Item& b) { return a.sphere.*axis < b.sphere.*axis; });
      return middle;
    });
  }

  BoxTree hierarchy() const override { return builder_.tree(); }

 private:
  /// Of the box of all centres.
  static float Sphere::*longest_side(const BoxTree::Item* begin, const BoxTree::Item* end) {
    Sphere low = begin->sphere, high = low;
    for (const BoxTree::Item* item = begin + 1; item != end; ++item) {
      const Sphere& s = item->sphere;
      low.x = std::min(low.x, s.x), low.y = std::min(low.y, s.y), low.z = std::min(low.z, s.z);
      high.x = std::max(high.x, s.x), high.y = std::max(high.y, s.y), high.z = std::max(high.z, s.z);
    }
    const float x = high.x - low.x, y = high.y - low.y, z = high.z - low.z;
    return x >= y && x >= z ? &Sphere::x : y >= z ? &Sphere::y : &Sphere::z;
  }

  BoxTreeBuilder builder_;
};

const RegisterConstruction<MedianSplit, Robust> registered{
    {.name = "MedianSplit",
     .summary = "boxes, spheres halved across the longest side",
     .parameters = {BoxTreeBuilder::leaf_parameter()},
     .promises = {.same_bits = true}}};

}  // namespace
}  // namespace catena
