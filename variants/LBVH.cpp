#include <array>
#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "catena/core/hierarchy/box_tree_builder.h"
#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// LBVH (Lauterbach et al. 2009): spheres in order of the Morton codes of their centres, 21 bits an axis, a
/// node parted where the highest bit of its codes changes. Equal codes stay in chain order and are halved.
/// O(n) but for log n steps to find where a node is parted.
template <class Arithmetic>
class LBVH final : public Construction<BoxTree> {
 public:
  explicit LBVH(const Parameters& parameters) : builder_(parameters) {}

  void build(const ChainView& chain) override {
    sort_codes(chain);
    std::vector<BoxTree::Item>& items = builder_.items(chain);
    for (std::uint32_t at = 0; at < chain.size; ++at) {
      const std::uint32_t i = keys_[at].id;
      items[at] = {chain.spheres[i], i};
    }
    builder_.build([&](std::uint32_t begin, std::uint32_t end) {
      const std::uint64_t differ = keys_[begin].code ^ keys_[end - 1].code;
      if (differ == 0) return begin + (end - begin) / 2;
      const std::uint64_t highest = std::bit_floor(differ);
      const auto second = std::partition_point(keys_.begin() + begin, keys_.begin() + end,
                                               [&](const Key& key) { return (key.code & highest) == 0; });
      return static_cast<std::uint32_t>(second - keys_.begin());
    });
  }

  BoxTree hierarchy() const override { return builder_.tree(); }

 private:
  static constexpr int digit_bits = 8, digits = 3 * MortonGrid::bits / digit_bits + 1;
  struct Key {
    std::uint64_t code;
    std::uint32_t id;
  };

  /// Fills keys_, sorted: by radix from the lowest digit, which keeps the order of equal codes. A digit that
  /// all codes share is left out.
  void sort_codes(const ChainView& chain) {
    keys_.resize(chain.size);
    sorted_.resize(chain.size);
    std::array<std::array<std::uint32_t, 1 << digit_bits>, digits> count{};
    const MortonGrid grid(std::span(chain.spheres, chain.size));
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      keys_[i] = {grid.code(chain.spheres[i]), i};
      for (int d = 0; d < digits; ++d) ++count[d][digit(keys_[i], d)];
    }
    for (int d = 0; d < digits && chain.size > 0; ++d) {
      if (count[d][digit(keys_[0], d)] == chain.size) continue;
      std::uint32_t next = 0;
      for (std::uint32_t& place : count[d]) next += std::exchange(place, next);
      for (const Key& key : keys_) sorted_[count[d][digit(key, d)]++] = key;
      keys_.swap(sorted_);
    }
  }
  static std::size_t digit(const Key& key, int d) {
    return key.code >> d * digit_bits & ((1 << digit_bits) - 1);
  }

  BoxTreeBuilder builder_;
  std::vector<Key> keys_, sorted_;
};

const RegisterConstruction<LBVH, Robust> registered{{.name = "LBVH",
                                                     .summary = "boxes, spheres in order of Morton codes",
                                                     .parameters = {BoxTreeBuilder::leaf_parameter()},
                                                     .promises = {.same_bits = true}}};

}  // namespace
}  // namespace catena
