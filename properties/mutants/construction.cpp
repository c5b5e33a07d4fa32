#include <bit>
#include <cstdint>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/executor/host_group.h"
#include "catena/core/policies/bGPU2.h"
#include "catena/properties/mutants/mutant.h"

// Bugs in building a tree over any number of leaves.
namespace catena::properties {
namespace {

/// A level of an odd number of nodes loses its last one.
class OddLeafDropped final : public FaultyTree {
  void construct() override {
    std::uint32_t first = 0, next = tree().leaves;
    for (std::uint32_t size = tree().leaves; size > 1; size /= 2, first = next - size)
      for (std::uint32_t p = 0; p < size / 2; ++p, ++next) join(next, {first + 2 * p, first + 2 * p + 1});
    tree().root = next == tree().leaves ? 0 : next - 1;
  }
};
const RegisterMutant<OddLeafDropped> odd{"odd-leaf-dropped", "the last node of an odd level gets no parent"};

/// floor(log2 n) levels for ceil(log2 n).
class WrongRoot final : public FaultyTree {
  void construct() override {
    FaultyTree::construct();
    const std::uint32_t n = tree().leaves;
    if (n > 2 && std::has_single_bit(n - 1)) tree().root = tree().links[tree().root].left;
  }
};
const RegisterMutant<WrongRoot> root{"wrong-root-after-a-power-of-two", "n = 2^k + 1: one level too few"};

/// The last block of 384 leaves has no threads unless it is full.
class PartialBlockIgnored final : public FaultyTree {
  void search(const ChainView& chain, std::uint32_t i) override {
    constexpr std::uint32_t block = 384;
    if (chain.size <= block || i < chain.size / block * block) FaultyTree::search(chain, i);
  }
};
const RegisterMutant<PartialBlockIgnored> block{"partial-block-ignored", "n / 384 blocks for ceil(n / 384)"};

/// bGPU2 that waits for its threads after every second level only. HostGroup runs the last thread first.
class MissingBarrier final : public FaultyTree {
  class Impatient {
   public:
    template <class Body>
    void parallel(std::uint32_t count, const Body& body) {
      group_.parallel(count, body);
    }
    void barrier() {
      if (++asked_ % 2 == 0) group_.barrier();
    }
    void wait() { group_.barrier(); }

   private:
    HostGroup group_{8};
    std::uint32_t asked_ = 0;
  };
  void construct() override {
    if (tree().leaves == 1) return FaultyTree::construct();
    tree().root = tree().size() - 1;
    Impatient group;
    policy::bGPU2<Robust>::build(group, tree(), Level::leaves(tree().leaves), tree().leaves, tree().root);
    group.wait();
  }
};
const RegisterMutant<MissingBarrier> barrier{"missing-barrier",
                                             "parents of parents that another thread still writes"};

/// The tree needs four leaves, so fewer are not looked at (genesis-world PR#1766: endless loop for few
/// boxes).
class FewSpheres final : public FaultyTree {
  void search(const ChainView& chain, std::uint32_t i) override {
    if (chain.size > 3) FaultyTree::search(chain, i);
  }
};
const RegisterMutant<FewSpheres> few{"few-spheres-unanswered", "genesis-world PR#1766: few boxes"};

}  // namespace
}  // namespace catena::properties
