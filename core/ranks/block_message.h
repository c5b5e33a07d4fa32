#pragma once
#include <span>
#include <vector>

#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/held_part.h"

namespace catena::ranks {

/// Some blocks in one message: first what is alike of many, then their spheres and arcs, each in a row.
void put_blocks(ByteWriter& out, const HeldPart& part, std::span<const Block> blocks);

/// Blocks of other ranks.
class FarBlocks {
 public:
  /// Adds what put_blocks wrote, on a rank of the same rule, and a mark to each block.
  void take(ByteReader& in, const Rule& rule, std::uint32_t mark);
  void clear();

  std::uint32_t blocks() const { return static_cast<std::uint32_t>(headers_.size()); }
  const std::vector<Sphere>& spheres() const { return spheres_; }
  std::uint32_t begin(std::uint32_t block) const { return headers_[block].begin; }  ///< its first sphere
  std::span<const Sphere> spheres(std::uint32_t block) const {
    const std::size_t end = block + 1 < blocks() ? begin(block + 1) : spheres_.size();
    return std::span(spheres_).subspan(begin(block), end - begin(block));
  }
  std::uint32_t block_of(std::uint32_t sphere) const { return block_of_[sphere]; }
  std::uint32_t mark(std::uint32_t block) const { return headers_[block].mark; }
  SphereId id(std::uint32_t sphere) const {
    const Header& block = headers_[block_of_[sphere]];
    return block.first + (sphere - block.begin);
  }
  Place place(std::uint32_t sphere) const {
    const Header& block = headers_[block_of_[sphere]];
    return {id(sphere), strands_[block.strand], arcs_.empty() ? 0 : arcs_[sphere], spheres_[sphere].radius};
  }

 private:
  struct Sent {
    SphereId first;
    std::uint32_t strand, size;
  };
  struct Header {
    SphereId first;
    std::uint32_t strand, begin, mark;
  };
  friend void put_blocks(ByteWriter& out, const HeldPart& part, std::span<const Block> blocks);

  std::vector<Strand> strands_;
  std::vector<Header> headers_;
  std::vector<std::uint32_t> block_of_;  // [sphere]
  std::vector<Sphere> spheres_;
  std::vector<double> arcs_;
};

}  // namespace catena::ranks
