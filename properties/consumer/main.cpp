#include <catena/core/strategy/registry.h>

#include <cstdio>
#include <vector>

/// Usage: consumer [VARIANT...]: a closed zigzag whose collisions are known, by each variant.
int main(int argc, char** argv) {
  std::vector<catena::Sphere> spheres;
  for (int i = 0; i < 100; ++i) spheres.push_back({float(i % 10) * 3, float(i / 10) * 1.5f, 0, 1});
  const catena::Chain chain(spheres, catena::Strands::one_closed(100));
  catena::Collisions found;
  for (int k = 1; k < argc; ++k) {
    const auto variant = catena::StrategyRegistry::instance().make(argv[k]);
    variant->build(chain);
    variant->find(chain, {}, found);
    std::printf("%s: %llu pairs\n", argv[k], static_cast<unsigned long long>(found.pair_count));
    if (found.pair_count != 90) return 1;  // 9 gaps between rows of 10, all vertical neighbours touch
  }
  return 0;
}
