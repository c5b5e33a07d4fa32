#include "catena/core/input/thinned.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/tube_loss.h"

namespace catena {
namespace {

/// tube_loss as a share of the least radius; 1 where as much is lost.
double share_lost(std::span<const Sphere> stretch) {
  const float least = std::ranges::min_element(stretch, {}, &Sphere::radius)->radius;
  const double loss = tube_loss(stretch);
  return loss < least ? loss / least : 1;
}

/// Spheres from `first` to `last` of a chain.
std::span<const Sphere> stretch_of(const Chain& chain, std::uint32_t first, std::uint32_t last) {
  return chain.spheres().subspan(first, last - first + 1);
}

class Walk {
 public:
  Walk(std::span<const Pair> joints, double tolerance) : joints_(joints), tolerance_(tolerance) {}

  /// Goes along every strand as far as it can, from the ends of strands and joints on.
  std::vector<std::uint32_t> first(const Chain& chain) const {
    std::vector<std::uint32_t> stops = stops_of(chain), kept;
    for (std::size_t k = 0; k < stops.size(); ++k) {
      kept.push_back(stops[k]);
      if (k + 1 == stops.size() || starts_strand(chain, stops[k + 1])) continue;
      for (std::uint32_t at = farthest(chain, stops[k], stops[k + 1]); at < stops[k + 1];
           at = farthest(chain, at, stops[k + 1]))
        kept.push_back(at);
    }
    return kept;
  }

  /// Adds to `kept` what this frame needs; whether that was anything.
  bool add(const Chain& chain, std::vector<std::uint32_t>& kept) const {
    std::vector<std::uint32_t> more;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (k > 0 && !starts_strand(chain, kept[k])) halve(chain, kept[k - 1], kept[k], more);
      more.push_back(kept[k]);
    }
    const bool changed = more.size() != kept.size();
    kept = std::move(more);
    return changed;
  }

 private:
  static bool starts_strand(const Chain& chain, std::uint32_t sphere) {
    return std::ranges::binary_search(chain.strands().first, sphere);
  }

  std::vector<std::uint32_t> stops_of(const Chain& chain) const {
    std::vector<std::uint32_t> stops;
    const auto& first = chain.strands().first;
    for (std::size_t s = 0; s + 1 < first.size(); ++s)
      if (first[s] < first[s + 1]) stops.push_back(first[s]), stops.push_back(first[s + 1] - 1);
    for (const Pair& joint : joints_) stops.push_back(joint.i), stops.push_back(joint.j);
    std::ranges::sort(stops);
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    return stops;
  }

  bool may_skip(const Chain& chain, std::uint32_t first, std::uint32_t last) const {
    return last - first <= 1 || share_lost(stretch_of(chain, first, last)) <= tolerance_;
  }

  /// Beyond `from`, by doubled steps and then halved ones: the last one tried to which nothing needs to be
  /// kept.
  std::uint32_t farthest(const Chain& chain, std::uint32_t from, std::uint32_t end) const {
    std::uint32_t good = 1;
    while (good <= (end - from) / 2 && may_skip(chain, from, from + 2 * good)) good *= 2;
    std::uint32_t bad = std::min(2 * good, end - from + 1);
    while (bad - good > 1) {
      const std::uint32_t middle = good + (bad - good) / 2;
      (may_skip(chain, from, from + middle) ? good : bad) = middle;
    }
    return from + good;
  }

  void halve(const Chain& chain, std::uint32_t first, std::uint32_t last,
             std::vector<std::uint32_t>& more) const {
    if (may_skip(chain, first, last)) return;
    const std::uint32_t middle = first + (last - first) / 2;
    halve(chain, first, middle, more);
    more.push_back(middle);
    halve(chain, middle, last, more);
  }

  std::span<const Pair> joints_;
  double tolerance_;
};

void measure(const Chain& chain, Thinning& thinning) {
  const auto& [first, closed] = chain.strands();
  for (std::size_t s = 0; s < closed.size(); ++s)
    if (closed[s] && first[s] < first[s + 1])
      thinning.own = std::max(thinning.own, share_lost(std::array{chain[first[s + 1] - 1], chain[first[s]]}));
  std::size_t strand = 0, k = 0;
  for (std::uint32_t i = 0; i + 1 < chain.size(); ++i) {
    while (first[strand + 1] <= i) ++strand;
    while (thinning.kept[k] < i) ++k;
    if (first[strand + 1] == i + 1) continue;
    thinning.own = std::max(thinning.own, share_lost(stretch_of(chain, i, i + 1)));
    if (thinning.kept[k] != i || thinning.kept[k + 1] == i + 1) continue;
    thinning.lost = std::max(thinning.lost, share_lost(stretch_of(chain, i, thinning.kept[k + 1])));
  }
}

class Thinned final : public Animation {
 public:
  Thinned(std::unique_ptr<Animation> whole, const Thinning& thinning)
      : whole_(std::move(whole)), thinning_(thinning) {
    const Chain first = whole_->frame(0);
    topology_ = first.view().topology;
    first_ = made(first);
  }

  std::uint32_t frames() const override { return whole_->frames(); }
  Chain frame(std::uint32_t f) const override {
    if (f == 0) return first_;
    const Chain whole = whole_->frame(f);
    return whole.view().topology == topology_ ? first_.moved(spheres_of(whole)) : made(whole);
  }

 private:
  std::vector<Sphere> spheres_of(const Chain& chain) const {
    std::vector<Sphere> spheres;
    spheres.reserve(thinning_.kept.size());
    for (const std::uint32_t i : thinning_.kept) spheres.push_back(chain[i]);
    return spheres;
  }

  Chain made(const Chain& chain) const {
    Strands strands{{0}, chain.strands().closed};
    for (const std::uint32_t end : std::span(chain.strands().first).subspan(1))
      strands.first.push_back(thinning_.place_of(end));

    Exclusion exclusion = chain.exclusion();
    std::erase_if(exclusion.extra_pairs,
                  [&](const Pair& pair) { return !thinning_.keeps(pair.i) || !thinning_.keeps(pair.j); });
    for (Pair& pair : exclusion.extra_pairs) pair = {thinning_.place_of(pair.i), thinning_.place_of(pair.j)};

    const ExclusionView whole = chain.view().exclusion;
    ArcLengths arcs;
    for (const std::uint32_t i : thinning_.kept) arcs.arc.push_back(whole.arc[i]);
    arcs.loop_length.assign(whole.loop_length, whole.loop_length + chain.strand_count());
    return Chain(spheres_of(chain), std::move(strands), std::move(exclusion), std::move(arcs));
  }

  std::unique_ptr<Animation> whole_;
  Thinning thinning_;
  std::uint64_t topology_ = 0;  ///< of the whole chain in frame 0
  Chain first_;
};

}  // namespace

bool Thinning::keeps(std::uint32_t sphere) const { return std::ranges::binary_search(kept, sphere); }

std::uint32_t Thinning::place_of(std::uint32_t sphere) const {
  return static_cast<std::uint32_t>(std::ranges::lower_bound(kept, sphere) - kept.begin());
}

Thinning thin(const Animation& whole, std::span<const Pair> joints, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    throw InputError(
        fmt::format("--tolerance {}: must be a share of the radius, above 0 and below 1", tolerance));
  const Chain chain = whole.frame(0);
  if (chain.exclusion().rule != Exclusion::Rule::arc_window)
    throw InputError(
        "--tolerance leaves spheres out, so that neighbours cannot be told by counting them: "
        "give --arc-window F too, such as pi/2");
  const Walk walk(joints, tolerance);
  Thinning thinning{tolerance, chain.size(), walk.first(chain)};
  // What one frame adds can spoil a stretch of another, so until a whole round adds nothing.
  const std::uint32_t frames = whole.frames();
  const auto frame = [&](std::uint32_t f) {
    Chain moved = whole.frame(f);
    if (moved.size() != chain.size())
      throw InputError(fmt::format("--tolerance: frame {} has {}, frame 0 has {}", f,
                                   counted(moved.size(), "sphere"), chain.size()));
    return moved;
  };
  for (std::uint32_t f = 1 % frames, clean = 1; clean < frames; f = (f + 1) % frames)
    clean = walk.add(frame(f), thinning.kept) ? 1 : clean + 1;
  for (std::uint32_t f = 0; f < frames; ++f) measure(frame(f), thinning);
  return thinning;
}

std::unique_ptr<Animation> thinned(std::unique_ptr<Animation> whole, const Thinning& thinning) {
  return std::make_unique<Thinned>(std::move(whole), thinning);
}

}  // namespace catena
