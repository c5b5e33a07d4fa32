#pragma once
#include <array>
#include <vector>

#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/held_part.h"

namespace catena::ranks {

/// A block of another rank.
struct FarBlock {
  SphereId first;
  Strand strand;
  std::uint32_t size;
  std::array<Sphere, Block::most> spheres;
  std::array<double, Block::most> arcs;  ///< under an arc window
  std::vector<IdPair> extra;             ///< where they were sent: rows of these spheres

  Place place(std::uint32_t k) const { return {first + k, strand, arcs[k], spheres[k].radius}; }
};

enum class ExtraPairs { left_out, sent };

void put_block(ByteWriter& out, const HeldPart& part, const Block& block, ExtraPairs extra);
/// What put_block wrote, on a rank of the same rule.
FarBlock get_block(ByteReader& in, const Rule& rule);

}  // namespace catena::ranks
