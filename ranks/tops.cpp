#include "catena/ranks/tops.h"

#include <algorithm>
#include <cstring>

#include "catena/ranks/bytes.h"

namespace catena::ranks {
namespace {

std::vector<Box> tops_of(const HeldPart& part) {
  const auto blocks = static_cast<std::uint32_t>(part.blocks().size());
  const std::uint32_t each = (blocks + Tops::most - 1) / Tops::most;
  std::vector<Box> tops;
  for (std::uint32_t first = 0; first < blocks; first += each) {
    Box box = part.boxes().box(first);
    for (std::uint32_t b = first + 1; b < std::min(blocks, first + each); ++b) box.join(part.boxes().box(b));
    tops.push_back(box);
  }
  if (tops.empty()) return tops;
  Box around = tops[0];
  for (const Box& box : tops) around.join(box);
  tops.insert(tops.begin(), around);
  return tops;
}

}  // namespace

Tops Tops::of_all(Communicator& ranks, const HeldPart& part) {
  const std::vector<Box> own = tops_of(part);
  return Tops(ranks.all_gather(ByteWriter().put_all(std::span<const Box>(own)).take()));
}

std::uint32_t Tops::boxes_of(unsigned rank) const {
  const std::size_t boxes = (*gathered_)[rank].size() / sizeof(Box);
  return boxes == 0 ? 0 : static_cast<std::uint32_t>(boxes - 1);
}

Box Tops::box(unsigned rank, std::uint32_t k) const {
  Box box;
  std::memcpy(&box, (*gathered_)[rank].data() + (k + 1) * sizeof box, sizeof box);
  return box;
}

bool Tops::meets(unsigned rank, const Box& box) const {
  const std::uint32_t boxes = boxes_of(rank);
  if (boxes == 0) return false;
  Box around;
  std::memcpy(&around, (*gathered_)[rank].data(), sizeof around);
  if (!around.meets(box)) return false;
  for (std::uint32_t k = 0; k < boxes; ++k)
    if (this->box(rank, k).meets(box)) return true;
  return false;
}

bool Tops::meet(unsigned a, unsigned b) const {
  for (std::uint32_t k = 0; k < boxes_of(a); ++k)
    if (meets(b, box(a, k))) return true;
  return false;
}

WideBoxTree Tops::tree(unsigned rank) const {
  WideBoxTree tree;
  tree.clear(boxes_of(rank));
  for (std::uint32_t k = 0; k < boxes_of(rank); ++k) tree.set(k, box(rank, k));
  tree.refresh(0, boxes_of(rank));
  return tree;
}

}  // namespace catena::ranks
