#include <catena/core/arithmetic/in_range.h>
#include <catena/core/arithmetic/robust.h>
#include <catena/core/executor/host_group.h>
#include <catena/core/policies/GPU2.h>
#include <catena/core/policies/bGPU2.h>
#include <catena/core/policies/visitor.h>

#include <cstdio>
#include <functional>

#include "bits.h"

namespace {

struct Hits : catena::Visitor {
  Hits(std::uint32_t sphere, std::vector<catena::Pair>& to) : i(sphere), pairs(to) {}
  void hit(std::uint32_t j) {
    if (i < j) pairs.push_back({i, j});
  }
  std::uint32_t i;
  std::vector<catena::Pair>& pairs;
};

/// bGPU2+GPU2 of the library's policies, compiled here, with this project's flags.
Bits own_bits(const catena::Chain& chain) {
  using catena::Robust;
  const std::uint32_t n = chain.size();
  catena::Hierarchy<catena::Sphere> storage;
  catena::HierarchyView<catena::Sphere> tree = storage.reset(n);
  tree.root = tree.size() - 1;
  tree.height = 1 + catena::halvings(n);
  catena::HostGroup group(768);
  catena::policy::copy_leaves<Robust>(group, tree, chain.spheres().data());
  group.barrier();
  catena::policy::bGPU2<Robust>::build(group, tree, catena::Level::leaves(n), n, tree.root);

  Bits bits;
  for (std::uint32_t slot = n; slot < tree.size(); ++slot) {
    const catena::Sphere& s = tree.bound[slot];
    bits.node(slot, {s.x, s.y, s.z, s.radius});
  }
  std::vector<catena::Pair> pairs;
  const catena::ChainView view = chain.view();
  catena::with_tests_for<Robust>(view, [&](auto tests) {
    for (std::uint32_t i = 0; i < n; ++i) {
      Hits hits(i, pairs);
      catena::policy::GPU2<decltype(tests)>::visit(i, view, tree, hits);
    }
  });
  bits.pairs(std::move(pairs));
  return bits;
}

}  // namespace

/// Prints the bits of the library's and of this program's trees and pairs; fails when they differ.
int main() {
  bool same = true;
  for (const float scale : {1.0f, 0x1p100f, 0x1p-100f}) {
    const catena::Chain chain = tangle(scale);
    const Bits library = bits_of("bGPU2@host+GPU2@host", chain), own = own_bits(chain);
    std::printf(
        "radii of about %g: library %016llx, %zu nodes, %zu pairs; compiled here %016llx, %zu nodes, %zu "
        "pairs\n",
        double{scale}, static_cast<unsigned long long>(library.hash()), library.nodes(), library.pairs(),
        static_cast<unsigned long long>(own.hash()), own.nodes(), own.pairs());
    same = same && library.hash() == own.hash() && library.nodes() == chain.size() - 1 && library.pairs() > 0;
  }
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  std::puts("this processor has fused multiply-add");
#endif
  return same ? 0 : 1;
}
