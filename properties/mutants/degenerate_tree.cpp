#include <cstdint>
#include <vector>

#include "catena/properties/mutants/mutant.h"

// Bugs that show on trees far deeper than log2 n.
namespace catena::properties {
namespace {

/// A tree grown by insertion in chain order: sphere i beside all before it, so n levels. The last child is
/// pushed first, so a search that overlaps everything fills a slot a level.
class Vine : public FaultyTree {
 public:
  using Base = Vine;

 private:
  static constexpr std::uint32_t most = 4096;  ///< leaves; a search takes their square

  void construct() override {
    if (tree().leaves > most) return FaultyTree::construct();
    std::uint32_t so_far = 0;
    for (std::uint32_t i = 1; i < tree().leaves; ++i, so_far = tree().leaves + i - 2)
      join(tree().leaves + i - 1, {so_far, i});
    tree().root = tree().leaves == 1 ? 0 : tree().size() - 1;
  }

 protected:
  /// A mutant decides what happens when both children do not fit.
  virtual void push(std::vector<std::uint32_t>& stack, const Links& children) const {
    stack.insert(stack.end(), {children.right, children.left});
  }

  void search(const ChainView& chain, std::uint32_t i) override {
    stack_.assign(1, tree().root);
    while (!stack_.empty()) {
      const std::uint32_t slot = stack_.back();
      stack_.pop_back();
      if (tree().is_leaf(slot))
        leaf(chain, i, slot);
      else if (descend(tree().bound[i], tree().bound[slot]))
        push(stack_, tree().links[slot]);
    }
  }

 private:
  std::vector<std::uint32_t> stack_;
};

class DropsBoth final : public Vine {
  void push(std::vector<std::uint32_t>& stack, const Links& children) const override {
    if (stack.size() + 2 <= 64) Vine::push(stack, children);
  }
};
const RegisterMutant<DropsBoth> both{"full-stack-drops-both-children", "Box2D's query with asserts off"};

/// A ring buffer of tasks: the oldest is overwritten.
class Overrun final : public Vine {
  void push(std::vector<std::uint32_t>& stack, const Links& children) const override {
    Vine::push(stack, children);
    if (stack.size() > 128) stack.erase(stack.begin());
  }
};
const RegisterMutant<Overrun> overrun{"task-stack-overrun",
                                      "tinybvh PR#164: a degenerate tree overruns the task stack"};

}  // namespace
}  // namespace catena::properties
