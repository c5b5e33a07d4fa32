#include "catena/core/ranks/held_part.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace catena::ranks {
namespace {

bool none_closed(std::span<const Piece> pieces) {
  return std::ranges::none_of(pieces, [](const Piece& piece) { return piece.strand.closed != 0; });
}

bool whole(const Piece& piece) { return piece.size == piece.strand.size; }

/// Both ends of an extra pair, where this part has both.
std::vector<Pair> pairs_inside(const Part& part) {
  std::vector<const Piece*> by_id;
  for (const Piece& piece : part.pieces) by_id.push_back(&piece);
  std::ranges::sort(by_id, {}, &Piece::first);
  const auto find = [&](SphereId id) -> std::optional<std::uint32_t> {
    const auto after = std::ranges::upper_bound(by_id, id, {}, &Piece::first);
    if (after == by_id.begin()) return {};
    const Piece& piece = **(after - 1);
    if (id - piece.first >= piece.size) return {};
    return piece.begin + static_cast<std::uint32_t>(id - piece.first);
  };
  std::vector<Pair> pairs;
  for (const auto& [i, j] : part.extra)
    if (const auto a = find(i), b = i < j ? find(j) : std::nullopt; a && b) pairs.push_back({*a, *b});
  return pairs;
}

/// The piece of every sphere whose number `stride` divides.
std::vector<std::uint32_t> piece_at_every(std::uint32_t stride, std::span<const Piece> pieces,
                                          std::uint32_t spheres) {
  std::vector<std::uint32_t> at;
  at.reserve((spheres + stride - 1) / stride);
  std::uint32_t p = 0;
  for (std::uint32_t s = 0; s < spheres; s += stride) {
    while (s - pieces[p].begin >= pieces[p].size) ++p;
    at.push_back(p);
  }
  return at;
}

/// Whether the part as one open strand misses no neighbours: as its spheres ascend, those within an index
/// window are no further apart here than in the whole chain. What it passes over besides, a few pairs where
/// pieces part, is to be no more than there are spheres.
bool will_do_as_one_strand(const Part& part) {
  if (part.rule.kind != Exclusion::Rule::index_window || !part.extra.empty()) return false;
  const std::size_t window = part.rule.window;
  if (window == 0 || part.pieces.size() > part.spheres.size() / window / window) return false;
  return none_closed(part.pieces) && std::ranges::is_sorted(part.pieces, {}, &Piece::first);
}

Chain chain_of(Part& part, bool one_strand) {
  if (one_strand) return Chain(std::move(part.spheres), {}, Exclusion::index(part.rule.window));
  Strands strands{{0}, {}};
  ArcLengths lengths{std::move(part.arcs), {}};
  for (const Piece& piece : part.pieces) {
    strands.first.push_back(piece.begin + piece.size);
    strands.closed.push_back(piece.strand.closed != 0 && whole(piece));
    lengths.loop_length.push_back(piece.strand.loop_length);
  }
  if (part.pieces.empty()) strands = {}, lengths.loop_length.push_back(0);
  const Exclusion exclusion{part.rule.kind, part.rule.window, part.rule.factor, pairs_inside(part)};
  if (part.rule.kind == Exclusion::Rule::arc_window)
    return Chain(std::move(part.spheres), std::move(strands), exclusion, std::move(lengths));
  return Chain(std::move(part.spheres), std::move(strands), exclusion);
}

}  // namespace

bool neighbours(const Rule& rule, const Place& a, const Place& b) {
  if (a.strand.first != b.strand.first) return false;
  const bool closed = a.strand.closed != 0;
  if (rule.kind == Exclusion::Rule::arc_window)
    return within_arc_window(a.arc, b.arc, closed, a.strand.loop_length, rule.factor, a.radius, b.radius);
  const std::uint64_t steps = a.id < b.id ? b.id - a.id : a.id - b.id;
  return within_index_window(steps, a.strand.size, closed, std::uint64_t{rule.window});
}

HeldPart::HeldPart(Part part)
    : rule_(part.rule),
      pieces_(part.pieces),
      one_strand_(will_do_as_one_strand(part)),
      chain_(chain_of(part, one_strand_)),
      extra_(std::move(part.extra)),
      piece_at_(pieces_.size() > few ? piece_at_every(stride, pieces_, chain_.size())
                                     : std::vector<std::uint32_t>()),
      misses_neighbours_(!one_strand_ && look_for_missed()),
      furthest_neighbour_(rule_.kind == Exclusion::Rule::index_window && extra_.empty() &&
                                  none_closed(pieces_)
                              ? rule_.window
                              : ~SphereId{0}) {}

bool HeldPart::look_for_missed() const {
  if (std::ranges::any_of(pieces_,
                          [](const Piece& piece) { return piece.strand.closed != 0 && !whole(piece); }))
    return true;
  std::vector<const Piece*> by_id;
  for (const Piece& piece : pieces_) by_id.push_back(&piece);
  std::ranges::sort(by_id, {}, &Piece::first);
  const auto near = [&](const Piece* a, const Piece* b) {
    if (a->strand.first != b->strand.first) return false;
    return rule_.kind == Exclusion::Rule::arc_window || b->first - (a->first + a->size - 1) <= rule_.window;
  };
  return std::ranges::adjacent_find(by_id, near) != by_id.end();
}

std::span<const double> HeldPart::arcs(const Block& block) const {
  if (rule_.kind != Exclusion::Rule::arc_window) return {};
  return {chain_.view().exclusion.arc + block.begin, block.size};
}

Place HeldPart::place(std::uint32_t sphere) const {
  const Piece& piece = piece_of(sphere);
  const double arc = rule_.kind == Exclusion::Rule::arc_window ? chain_.view().exclusion.arc[sphere] : 0;
  return {piece.first + (sphere - piece.begin), piece.strand, arc, chain_[sphere].radius};
}

bool HeldPart::neighbours(const Place& a, const Place& b) const {
  return ranks::neighbours(rule_, a, b) || std::ranges::binary_search(extra_, IdPair{a.id, b.id});
}

}  // namespace catena::ranks
