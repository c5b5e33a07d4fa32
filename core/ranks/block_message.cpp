#include "catena/core/ranks/block_message.h"

#include <stdexcept>
#include <unordered_map>

namespace catena::ranks {

void put_blocks(ByteWriter& out, const HeldPart& part, std::span<const Block> blocks) {
  std::vector<Strand> strands;
  std::unordered_map<std::uint64_t, std::uint32_t> index;  // of a strand, by its number
  std::vector<FarBlocks::Sent> sent;
  sent.reserve(blocks.size());
  std::uint64_t spheres = 0;
  std::uint32_t at = 0;  // of the last block's strand, which mostly is the next one's
  for (const Block& block : blocks) {
    const Strand& strand = part.piece(block).strand;
    if (strands.empty() || strands[at].number != strand.number) {
      const auto [known, is_new] =
          index.try_emplace(strand.number, static_cast<std::uint32_t>(strands.size()));
      if (is_new) strands.push_back(strand);
      at = known->second;
    }
    sent.push_back({part.id(block), at, block.size});
    spheres += block.size;
  }
  const bool with_arcs = part.rule().kind == Exclusion::Rule::arc_window;
  out.reserve(strands.size() * sizeof(Strand) + sent.size() * sizeof(FarBlocks::Sent) +
              spheres * (sizeof(Sphere) + (with_arcs ? sizeof(double) : 0)) + 4 * sizeof spheres);
  out.put_list(strands).put_list(sent).put(spheres);
  for (const Block& block : blocks) out.put_all(part.spheres(block));
  out.put(with_arcs ? spheres : 0);
  for (const Block& block : blocks) out.put_all(part.arcs(block));
}

void FarBlocks::take(ByteReader& in, const Rule& rule, std::uint32_t mark) {
  const auto strands = in.get_list<Strand>();
  const auto strands_before = static_cast<std::uint32_t>(strands_.size());
  strands_.insert(strands_.end(), strands.begin(), strands.end());
  for (const auto& [first, strand, size] : in.get_list<Sent>()) {
    if (size == 0 || size > Block::most || strand >= strands.size())
      throw std::logic_error("a message holds no blocks");
    const auto begin = static_cast<std::uint32_t>(block_of_.size());
    block_of_.insert(block_of_.end(), size, blocks());
    headers_.push_back({first, strands_before + strand, begin, mark});
  }
  const auto spheres = in.get_list<Sphere>();
  spheres_.insert(spheres_.end(), spheres.begin(), spheres.end());
  const auto arcs = in.get_list<double>();
  arcs_.insert(arcs_.end(), arcs.begin(), arcs.end());
  const bool with_arcs = rule.kind == Exclusion::Rule::arc_window;
  if (spheres_.size() != block_of_.size() || arcs_.size() != (with_arcs ? spheres_.size() : 0))
    throw std::logic_error("a message holds no blocks");
}

void FarBlocks::clear() {
  strands_.clear(), headers_.clear(), block_of_.clear(), spheres_.clear(), arcs_.clear();
}

}  // namespace catena::ranks
