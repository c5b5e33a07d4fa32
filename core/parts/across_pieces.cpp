#include "catena/core/parts/across_pieces.h"

#include <algorithm>
#include <optional>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/parts/greatest_radii.h"

namespace catena::parts {
namespace {

using Piece = LocalChain::Piece;

class Across {
 public:
  Across(const Chain& whole, std::span<const Piece> pieces)
      : whole_(whole), view_(whole.view()), pieces_(pieces.begin(), pieces.end()) {
    std::ranges::sort(pieces_, {}, &Piece::first);
    if (by_arcs()) lay_out();
  }

  std::vector<Pair> find() {
    for (std::size_t begin = 0, end; begin < pieces_.size(); begin = end) {
      for (end = begin + 1; end < pieces_.size() && pieces_[end].strand == pieces_[begin].strand;) ++end;
      const std::span<const Piece> of_strand(pieces_.data() + begin, end - begin);
      for (std::size_t p = 0; p + 1 < of_strand.size(); ++p) follow(of_strand, p);
      if (whole_.strands().closed[of_strand[0].strand] != 0 && !of_strand[0].closed) go_around(of_strand);
    }
    for (const Piece& piece : pieces_) add_extra(piece);
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    return std::move(pairs_);
  }

 private:
  void add(std::uint32_t i, std::uint32_t j) { pairs_.push_back({std::min(i, j), std::max(i, j)}); }

  /// The extra pairs whose lower sphere is of this piece.
  void add_extra(const Piece& piece) {
    const auto& extra = whole_.exclusion().extra_pairs;  // sorted
    for (auto pair = std::ranges::lower_bound(extra, piece.first, {}, &Pair::i);
         pair != extra.end() && pair->i - piece.first < piece.size; ++pair)
      if (const auto j = local(pair->j); j && Robust::overlap(whole_[pair->i], whole_[pair->j]))
        add(piece.begin + (pair->i - piece.first), *j);
  }

  std::optional<std::uint32_t> local(std::uint32_t id) const {
    const auto after = std::ranges::upper_bound(pieces_, id, {}, &Piece::first);
    if (after == pieces_.begin()) return {};
    const Piece& piece = *(after - 1);
    if (id - piece.first >= piece.size) return {};
    return piece.begin + (id - piece.first);
  }

  /// Of the whole chain, and here.
  struct Placed {
    std::uint32_t id, local;
  };
  /// All spheres in the order of the chain, with a tree over their radii: one that is great reaches far along
  /// the strand, and others are not to be looked through for it.
  void lay_out() {
    std::vector<float> radii;
    for (const Piece& piece : pieces_) {
      place_.push_back(placed_.size());
      for (std::uint32_t k = 0; k < piece.size; ++k) {
        placed_.push_back({piece.first + k, piece.begin + k});
        radii.push_back(whole_[piece.first + k].radius);
      }
    }
    place_.push_back(placed_.size());
    radii_.emplace(std::move(radii));
  }
  /// Where the spheres of a piece begin among those laid out; of the end of all, too.
  std::size_t place_of(const Piece* piece) const {
    return by_arcs() ? place_[static_cast<std::size_t>(piece - pieces_.data())] : 0;
  }

  bool by_arcs() const { return view_.exclusion.rule == Exclusion::Rule::arc_window; }
  double arc(std::uint32_t i) const { return by_arcs() ? view_.exclusion.arc[i] : 0; }
  /// Whether any two so far apart along a strand, in steps or by arc length, may be neighbours.
  bool any_may_reach(std::uint64_t steps, double length) const {
    if (!by_arcs()) return steps <= view_.exclusion.window;
    return length < view_.exclusion.factor * (2.0 * view_.extent.greatest_radius);
  }
  /// The same under an arc window, of sphere i and one of no greater radius than this.
  bool may_reach(std::uint32_t i, double length, float greatest) const {
    return length < view_.exclusion.factor * (double{whole_[i].radius} + double{greatest});
  }
  /// Two of one strand.
  void look_at(const Placed& i, const Placed& j) {
    if (whole_.neighbours(i.id, j.id) && Robust::overlap(whole_[i.id], whole_[j.id])) add(i.local, j.local);
  }

  /// Those ahead of piece p along the strand.
  void follow(std::span<const Piece> strand, std::size_t p) {
    const Piece& from = strand[p];
    const std::uint32_t next = strand[p + 1].first;
    const std::size_t begin = place_of(&strand[p + 1]), end = place_of(&strand.back() + 1);
    for (std::uint32_t k = from.size; k-- > 0;) {
      const Placed i{from.first + k, from.begin + k};
      if (!any_may_reach(next - i.id, arc(next) - arc(i.id))) return;
      if (!by_arcs()) {
        for (std::size_t q = p + 1; q < strand.size(); ++q)
          if (!each_ahead(i, strand[q])) break;
        continue;
      }
      radii_->for_each(
          begin, end,
          [&](std::size_t first, std::size_t, float greatest) {
            return may_reach(i.id, arc(placed_[first].id) - arc(i.id), greatest);
          },
          [&](std::size_t j) { look_at(i, placed_[j]); });
    }
  }
  /// Under an index window; false when i reaches no further than this piece.
  bool each_ahead(const Placed& i, const Piece& to) {
    for (std::uint32_t k = 0; k < to.size; ++k) {
      if (!any_may_reach(to.first + k - i.id, 0)) return false;
      look_at(i, {to.first + k, to.begin + k});
    }
    return true;
  }

  /// Those around the end of the strand.
  void go_around(std::span<const Piece> strand) {
    const std::uint32_t of = strand[0].strand, first = whole_.strands().first[of];
    const std::uint64_t size = whole_.strands().first[of + 1] - first;
    const double loop = by_arcs() ? view_.exclusion.loop_length[of] : 0;
    const std::uint32_t last = strand.back().first + strand.back().size - 1;
    std::size_t place = place_of(&strand[0]);
    const std::size_t end = place_of(&strand.back() + 1);
    for (const Piece& head : strand)
      for (std::uint32_t k = 0; k < head.size; ++k) {
        const Placed i{head.first + k, head.begin + k};
        if (!any_may_reach(size - (last - i.id), loop - (arc(last) - arc(i.id)))) return;
        ++place;
        if (!by_arcs()) {
          for (std::size_t q = strand.size(); q-- > 0;)
            if (!each_around(i, strand[q], size)) break;
          continue;
        }
        radii_->for_each(
            place, end,
            [&](std::size_t, std::size_t furthest, float greatest) {
              return may_reach(i.id, loop - (arc(placed_[furthest].id) - arc(i.id)), greatest);
            },
            [&](std::size_t j) { look_at(i, placed_[j]); });
      }
  }
  /// Under an index window; false when i reaches no further back than this piece.
  bool each_around(const Placed& i, const Piece& tail, std::uint64_t size) {
    for (std::uint32_t k = tail.size; k-- > 0;) {
      const std::uint32_t j = tail.first + k;
      if (j <= i.id || !any_may_reach(size - (j - i.id), 0)) return false;
      look_at(i, {j, tail.begin + k});
    }
    return true;
  }

  const Chain& whole_;
  const ChainView view_;
  std::vector<Piece> pieces_;
  // Under an arc window:
  std::vector<Placed> placed_;
  std::vector<std::size_t> place_;  ///< of each piece, and the end
  std::optional<GreatestRadii> radii_;
  std::vector<Pair> pairs_;
};

}  // namespace

std::vector<Pair> neighbours_across(const Chain& whole, std::span<const Piece> pieces) {
  return Across(whole, pieces).find();
}

}  // namespace catena::parts
