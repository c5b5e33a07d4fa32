#include "catena/core/ranks/block_message.h"

#include <algorithm>
#include <stdexcept>

namespace catena::ranks {
namespace {

struct Header {
  SphereId first;
  Strand strand;
  std::uint32_t size, extra;
};

std::span<const IdPair> rows_of(std::span<const IdPair> extra, SphereId first, std::uint32_t size) {
  const auto begin = std::ranges::lower_bound(extra, first, {}, &IdPair::i);
  const auto end = std::ranges::lower_bound(begin, extra.end(), first + size, {}, &IdPair::i);
  return {begin, end};
}

}  // namespace

void put_block(ByteWriter& out, const HeldPart& part, const Block& block, ExtraPairs extra) {
  const SphereId first = part.id(block);
  const auto rows =
      extra == ExtraPairs::sent ? rows_of(part.extra(), first, block.size) : std::span<const IdPair>();
  out.put(Header{first, part.piece(block).strand, block.size, static_cast<std::uint32_t>(rows.size())});
  out.put_all(part.spheres(block)).put_all(part.arcs(block)).put_all(rows);
}

FarBlock get_block(ByteReader& in, const Rule& rule) {
  const auto header = in.get<Header>();
  if (header.size == 0 || header.size > Block::most) throw std::logic_error("a message holds no block");
  FarBlock block{header.first, header.strand, header.size, {}, {}, std::vector<IdPair>(header.extra)};
  in.get_all(std::span(block.spheres).first(header.size));
  if (rule.kind == Exclusion::Rule::arc_window) in.get_all(std::span(block.arcs).first(header.size));
  in.get_all(std::span(block.extra));
  return block;
}

}  // namespace catena::ranks
