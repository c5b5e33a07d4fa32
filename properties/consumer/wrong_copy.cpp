// A program that defines a function of catena's arithmetic wrongly, under its own symbol, and shows it to
// every library it loads. Its own code takes it; the library must not.
#include <cstdio>

#include "bits.h"

catena::Sphere own_parent(const catena::Sphere& a, const catena::Sphere& b);

namespace {
int calls = 0;
}

/// catena::Robust::parent_in_binary64(Sphere, Sphere)
extern "C" catena::Sphere wrong_parent(catena::Sphere, catena::Sphere) __asm__(
    "_ZN6catena6Robust18parent_in_binary64ENS_6SphereES1_");
extern "C" catena::Sphere wrong_parent(catena::Sphere, catena::Sphere) {
  ++calls;
  return {0, 0, 0, 0};
}

int main() {
  const catena::Chain chain = tangle(0x1p100f);  // every parent of it is made in binary64
  const Bits bits = bits_of("bGPU2@host+GPU2@host", chain);
  std::printf("library %016llx, %d calls of the wrong copy\n", static_cast<unsigned long long>(bits.hash()),
              calls);
  if (calls != 0) return 1;
  const catena::Sphere parent = own_parent(chain[0], chain[1]);
  std::printf("own parent: radius %g, %d calls of the wrong copy\n", double{parent.radius}, calls);
  return calls == 1 ? 0 : 2;  // 2: nobody takes the copy, so nothing was shown
}
