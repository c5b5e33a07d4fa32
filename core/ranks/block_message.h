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

  Place place(std::uint32_t k) const { return {first + k, strand, arcs[k], spheres[k].radius}; }
};

/// Some blocks in one message: first all that is alike of many, then their spheres and arcs, each in a row.
void put_blocks(ByteWriter& out, const HeldPart& part, std::span<const Block> blocks);

/// Reads what put_blocks wrote, on a rank of the same rule, block by block. The bytes must outlive it.
class FarBlocks {
 public:
  FarBlocks(ByteReader& in, const Rule& rule);

  std::size_t size() const { return headers_.size(); }
  FarBlock next();

 private:
  struct Header {
    SphereId first;
    std::uint32_t strand, size;
  };
  friend void put_blocks(ByteWriter& out, const HeldPart& part, std::span<const Block> blocks);

  std::vector<Strand> strands_;
  std::vector<Header> headers_;
  std::vector<Sphere> spheres_;
  std::vector<double> arcs_;
  std::size_t block_ = 0, sphere_ = 0;
};

}  // namespace catena::ranks
