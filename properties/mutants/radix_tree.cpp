#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "catena/properties/mutants/mutant.h"

// Bugs of radix trees over Morton codes (Karras 2012), as LBVH libraries build them.
namespace catena::properties {
namespace {

/// A radix tree over 63-bit Morton codes, built as Karras does: each inner node finds its range on its own,
/// so that a prefix that is not monotone gives a graph that is no tree. Depth is bounded by the bits of code
/// and tie-break only.
class RadixTree : public FaultyTree {
 public:
  using Base = RadixTree;

 protected:
  void construct() override {
    sort_by_code();
    const std::uint32_t n = tree().leaves, kept = static_cast<std::uint32_t>(order_.size());
    for (std::uint32_t k = 0; k + 1 < kept; ++k) tree().links[n + k] = children_of(k, kept);
    tree().root = kept == 1 ? order_[0].leaf : n;
    fitted_.assign(tree().size(), 0);
    fit(tree().root);
  }

  /// Like that of the base, but what is no tree is left in the end.
  void search(const ChainView& chain, std::uint32_t i) override {
    std::uint64_t visits = 2 * std::uint64_t{tree().size()};
    stack_.assign(1, tree().root);
    while (!stack_.empty() && visits-- > 0) {
      const std::uint32_t slot = stack_.back();
      stack_.pop_back();
      if (tree().is_leaf(slot))
        leaf(chain, i, slot);
      else if (descend(tree().bound[i], tree().bound[slot]))
        push(stack_, tree().links[slot]);
    }
  }
  virtual void push(std::vector<std::uint32_t>& stack, const Links& children) const {
    stack.insert(stack.end(), {children.right, children.left});
  }

  struct Coded {
    std::uint64_t code;
    std::uint32_t leaf;
    friend auto operator<=>(const Coded&, const Coded&) = default;
  };
  std::vector<Coded>& order() { return order_; }
  virtual void sorted() {}  ///< order() is there

  /// Length of the common prefix of leaves p and q of one code.
  virtual int tie_break(std::uint32_t p, std::uint32_t q) const { return 64 + std::countl_zero(p ^ q); }

 private:
  void sort_by_code() {
    Sphere low = tree().bound[0], high = low;
    for (std::uint32_t i = 0; i < tree().leaves; ++i) {
      const Sphere& s = tree().bound[i];
      low = {std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z), 0};
      high = {std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z), 0};
    }
    order_.clear();
    for (std::uint32_t i = 0; i < tree().leaves; ++i) {
      const Sphere& s = tree().bound[i];
      order_.push_back(
          {spread(s.x, low.x, high.x) << 2 | spread(s.y, low.y, high.y) << 1 | spread(s.z, low.z, high.z),
           i});
    }
    std::ranges::sort(order_);
    sorted();
  }
  /// A coordinate as 21 bits, two zeros before each.
  static std::uint64_t spread(float at, float low, float high) {
    const double span = double{high} - low, part = span > 0 ? (double{at} - low) / span : 0;
    const auto cell = static_cast<std::uint64_t>(std::min(part * 0x1p21, 0x1p21 - 1));
    std::uint64_t bits = 0;
    for (int k = 0; k < 21; ++k) bits |= (cell >> k & 1) << (3 * k);
    return bits;
  }

  int common_prefix(std::int64_t p, std::int64_t q) const {
    if (q < 0 || q >= static_cast<std::int64_t>(order_.size())) return -1;
    const std::uint64_t differ = order_[p].code ^ order_[q].code;
    return differ != 0 ? std::countl_zero(differ)
                       : tie_break(static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(q));
  }
  /// Karras 2012, Section 4, with his names: direction d, length l, split gamma.
  Links children_of(std::int64_t i, std::uint32_t kept) const {
    const std::int64_t d = common_prefix(i, i + 1) > common_prefix(i, i - 1) ? 1 : -1;
    const int least = common_prefix(i, i - d);
    std::int64_t most = 2, l = 0;
    while (common_prefix(i, i + most * d) > least) most *= 2;
    for (std::int64_t t = most / 2; t >= 1; t /= 2)
      if (common_prefix(i, i + (l + t) * d) > least) l += t;
    const std::int64_t j = i + l * d;
    const int whole = common_prefix(i, j);
    std::int64_t s = 0;
    for (std::int64_t t = std::int64_t{1} << 32; t >= 1; t /= 2)
      if (s + t < l && common_prefix(i, i + (s + t) * d) > whole) s += t;
    const std::int64_t gamma = std::min<std::int64_t>(i + s * d + std::min<std::int64_t>(d, 0), kept - 2);
    return {child(std::min(i, j), gamma, gamma), child(std::max(i, j), gamma + 1, gamma + 1)};
  }
  std::uint32_t child(std::int64_t end, std::int64_t gamma, std::int64_t place) const {
    return end == gamma ? order_[place].leaf : tree().leaves + static_cast<std::uint32_t>(place);
  }

  void fit(std::uint32_t slot) {
    if (tree().is_leaf(slot) || std::exchange(fitted_[slot], std::uint8_t{1})) return;
    const Links children = tree().links[slot];
    fit(children.left);
    fit(children.right);
    join(slot, children);
  }

  std::vector<std::uint32_t> stack_;
  std::vector<Coded> order_;
  std::vector<std::uint8_t> fitted_;
};

/// Not enough slots, and nobody looks: 35 spheres suffice.
class SmallStack final : public RadixTree {
  void push(std::vector<std::uint32_t>& stack, const Links& children) const override {
    for (const std::uint32_t child : {children.right, children.left})
      if (stack.size() < 32) stack.push_back(child);
  }
};
const RegisterMutant<SmallStack> stack{"32-slot-stack",
                                       "KittenGpuLBVH and Warp: a 32-slot stack on a deeper tree"};

/// A tie counts as fewer equal bits than neighbouring codes have.
class ShortTieBreak final : public RadixTree {
  int tie_break(std::uint32_t p, std::uint32_t q) const override { return 32 + std::countl_zero(p ^ q); }
};
const RegisterMutant<ShortTieBreak> tie{"tie-break-of-32-bits",
                                        "ipc-toolkit PR#260: tie-break 32 with 64-bit codes"};

/// One leaf a code.
class DuplicateCodes final : public RadixTree {
  void sorted() override {
    const auto same = [](const Coded& p, const Coded& q) { return p.code == q.code; };
    order().erase(std::unique(order().begin(), order().end(), same), order().end());
  }
};
const RegisterMutant<DuplicateCodes> duplicates{"duplicate-codes-dropped",
                                                "DataTransferKit PR#373: null parents"};

}  // namespace
}  // namespace catena::properties
