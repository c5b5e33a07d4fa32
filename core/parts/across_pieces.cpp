#include "catena/core/parts/across_pieces.h"

#include <algorithm>
#include <optional>

namespace catena::parts {
namespace {

using Piece = LocalChain::Piece;

class Across {
 public:
  Across(const Chain& whole, std::span<const Piece> pieces)
      : whole_(whole), view_(whole.view()), pieces_(pieces.begin(), pieces.end()) {
    std::ranges::sort(pieces_, {}, &Piece::first);
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
      if (const auto j = local(pair->j)) add(piece.begin + (pair->i - piece.first), *j);
  }

  std::optional<std::uint32_t> local(std::uint32_t id) const {
    const auto after = std::ranges::upper_bound(pieces_, id, {}, &Piece::first);
    if (after == pieces_.begin()) return {};
    const Piece& piece = *(after - 1);
    if (id - piece.first >= piece.size) return {};
    return piece.begin + (id - piece.first);
  }

  /// Whether sphere i may be a neighbour of j or of one further away, `steps` or a length along the strand
  /// apart, whatever the radius of that other one.
  bool may_reach(std::uint32_t i, std::uint64_t steps, double length) const {
    if (view_.exclusion.rule == Exclusion::Rule::index_window) return steps <= view_.exclusion.window;
    return length < view_.exclusion.factor * (double{whole_[i].radius} + view_.extent.greatest_radius);
  }
  bool any_may_reach(std::uint64_t steps, double length) const {
    if (view_.exclusion.rule == Exclusion::Rule::index_window) return steps <= view_.exclusion.window;
    return length < view_.exclusion.factor * (2.0 * view_.extent.greatest_radius);
  }
  double arc(std::uint32_t i) const {
    return view_.exclusion.rule == Exclusion::Rule::arc_window ? view_.exclusion.arc[i] : 0;
  }

  /// Those ahead of piece p along the strand.
  void follow(std::span<const Piece> strand, std::size_t p) {
    const Piece& from = strand[p];
    const std::uint32_t next = strand[p + 1].first;
    for (std::uint32_t i = from.first + from.size;
         i-- > from.first && any_may_reach(next - i, arc(next) - arc(i));)
      for (std::size_t q = p + 1; q < strand.size(); ++q)
        if (!each_ahead(from, i, strand[q])) break;
  }
  /// False when i reaches no further than this piece.
  bool each_ahead(const Piece& from, std::uint32_t i, const Piece& to) {
    for (std::uint32_t j = to.first; j < to.first + to.size; ++j) {
      if (!may_reach(i, j - i, arc(j) - arc(i))) return false;
      if (whole_.neighbours(i, j)) add(from.begin + (i - from.first), to.begin + (j - to.first));
    }
    return true;
  }

  /// Those around the end of the strand.
  void go_around(std::span<const Piece> strand) {
    const std::uint32_t of = strand[0].strand, first = whole_.strands().first[of];
    const std::uint64_t size = whole_.strands().first[of + 1] - first;
    const double loop =
        view_.exclusion.rule == Exclusion::Rule::arc_window ? view_.exclusion.loop_length[of] : 0;
    const std::uint32_t last = strand.back().first + strand.back().size - 1;
    for (const Piece& head : strand)
      for (std::uint32_t i = head.first; i < head.first + head.size; ++i) {
        if (!any_may_reach(size - (last - i), loop - (arc(last) - arc(i)))) return;
        for (std::size_t q = strand.size(); q-- > 0;)
          if (!each_around(head, i, strand[q], size, loop)) break;
      }
  }
  /// False when i reaches no further back than this piece.
  bool each_around(const Piece& head, std::uint32_t i, const Piece& tail, std::uint64_t size, double loop) {
    for (std::uint32_t j = tail.first + tail.size; j-- > tail.first;) {
      if (j <= i || !may_reach(i, size - (j - i), loop - (arc(j) - arc(i)))) return false;
      if (whole_.neighbours(i, j)) add(head.begin + (i - head.first), tail.begin + (j - tail.first));
    }
    return true;
  }

  const Chain& whole_;
  const ChainView view_;
  std::vector<Piece> pieces_;
  std::vector<Pair> pairs_;
};

}  // namespace

std::vector<Pair> neighbours_across(const Chain& whole, std::span<const Piece> pieces) {
  return Across(whole, pieces).find();
}

}  // namespace catena::parts
