#include "catena/core/ranks/block_message.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

namespace catena::ranks {

void put_blocks(ByteWriter& out, const HeldPart& part, std::span<const Block> blocks) {
  std::vector<Strand> strands;
  std::unordered_map<std::uint64_t, std::uint32_t> index;  // of a strand, by its number
  std::vector<FarBlocks::Header> headers;
  headers.reserve(blocks.size());
  std::uint64_t spheres = 0;
  for (const Block& block : blocks) {
    const Strand& strand = part.piece(block).strand;
    const auto [at, is_new] = index.try_emplace(strand.number, static_cast<std::uint32_t>(strands.size()));
    if (is_new) strands.push_back(strand);
    headers.push_back({part.id(block), at->second, block.size});
    spheres += block.size;
  }
  out.put_list(strands).put_list(headers);
  out.put(spheres);
  for (const Block& block : blocks) out.put_all(part.spheres(block));
  out.put(part.rule().kind == Exclusion::Rule::arc_window ? spheres : 0);
  for (const Block& block : blocks) out.put_all(part.arcs(block));
}

FarBlocks::FarBlocks(ByteReader& in, const Rule& rule)
    : strands_(in.get_list<Strand>()),
      headers_(in.get_list<Header>()),
      spheres_(in.get_list<Sphere>()),
      arcs_(in.get_list<double>()) {
  std::uint64_t spheres = 0;
  for (const Header& header : headers_) {
    if (header.size == 0 || header.size > Block::most || header.strand >= strands_.size())
      throw std::logic_error("a message holds no blocks");
    spheres += header.size;
  }
  const bool arcs = rule.kind == Exclusion::Rule::arc_window;
  if (spheres != spheres_.size() || arcs_.size() != (arcs ? spheres : 0))
    throw std::logic_error("a message holds no blocks");
}

FarBlock FarBlocks::next() {
  const Header& header = headers_.at(block_++);
  FarBlock block{header.first, strands_[header.strand], header.size, {}, {}};
  std::copy_n(spheres_.begin() + static_cast<std::ptrdiff_t>(sphere_), header.size, block.spheres.begin());
  if (!arcs_.empty())
    std::copy_n(arcs_.begin() + static_cast<std::ptrdiff_t>(sphere_), header.size, block.arcs.begin());
  sphere_ += header.size;
  return block;
}

}  // namespace catena::ranks
