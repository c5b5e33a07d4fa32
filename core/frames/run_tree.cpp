#include "catena/core/frames/run_tree.h"

#include <algorithm>
#include <limits>

namespace catena {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Box nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

}  // namespace

void RunTree::refresh(const Sphere* row, std::uint32_t window_begin, std::uint32_t window_end,
                      std::uint32_t first, std::uint32_t end) {
  for (std::uint32_t r = first; r < end; ++r) {
    Box box = nothing;
    for (std::uint32_t p = std::max(r * run, window_begin); p < std::min((r + 1) * run, window_end); ++p)
      box.join(Box::around(row[p]));
    tree_.set(r, box);
  }
  tree_.refresh(first, end);
}

}  // namespace catena
