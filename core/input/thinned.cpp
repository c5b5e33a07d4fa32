#include "catena/core/input/thinned.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/tube_loss.h"
#include "catena/core/periodic/periodic.h"

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

bool starts_strand(const Chain& chain, std::uint32_t sphere) {
  return std::ranges::binary_search(chain.strands().first, sphere);
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

 private:
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

  std::span<const Pair> joints_;
  double tolerance_;
};

/// The most that is lost between two consecutive spheres, over all frames.
class OwnLoss {
 public:
  void look(const Chain& chain, const PeriodicBox* box) {
    const auto& [first, closed] = chain.strands();
    for (std::size_t s = 0; s < closed.size(); ++s) {
      for (std::uint32_t i = first[s]; i + 1 < first[s + 1]; ++i) step(chain[i], chain[i + 1], box);
      if (closed[s] && first[s] < first[s + 1]) step(chain[first[s + 1] - 1], chain[first[s]], box);
    }
  }
  double most() const { return most_; }

 private:
  /// What is lost of a step, as a share of the least radius r, is 1 - sqrt(1 - x / 4), but for rounding,
  /// which is less than 1e-13 where the radii are alike, and so grows with x = (D^2 - (ra - rb)^2) / r^2:
  /// only where x is about the greatest so far is the loss to be asked for.
  void step(const Sphere& a, Sphere b, const PeriodicBox* box) {
    if (box != nullptr) {
      const auto way = box->to_nearest({double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z});
      b = {static_cast<float>(a.x + way[0]), static_cast<float>(a.y + way[1]), static_cast<float>(a.z + way[2]),
           b.radius};
    }
    const double dx = double{b.x} - a.x, dy = double{b.y} - a.y, dz = double{b.z} - a.z;
    const double taper = double{b.radius} - a.radius, radius = std::min(a.radius, b.radius);
    const double x = dx * dx + dy * dy + dz * dz - taper * taper, square = radius * radius;
    if (square > 0 && std::abs(taper) <= radius && x < (0.999999 * greatest_ - 1e-12) * square) return;
    if (square > 0) greatest_ = std::max(greatest_, x / square);
    most_ = std::max(most_, share_lost(std::array{a, b}));
  }

  double greatest_ = 0, most_ = 0;  ///< x; what is lost
};

/// What is lost of stretches, of their halves, of the halves of these, and so on, most over all frames. What
/// one frame needs can spoil a stretch of another: so each tells all that may be asked of it.
class Halves {
 public:
  Halves(std::vector<Pair> whole, std::uint32_t spheres, double tolerance)
      : tolerance_(tolerance), whole_(std::move(whole)), most_(std::size_t{2} * spheres) {}

  void look(const Chain& chain, const PeriodicBox*) {
    for (const Pair& stretch : whole_) look(chain, stretch.i, stretch.j, root(stretch));
  }
  /// As few halvings as every frame lets be.
  void settle(Thinning& thinning) const {
    for (const Pair& stretch : whole_) keep(stretch.i, stretch.j, root(stretch), thinning);
  }

 private:
  // A stretch of k steps has 2 k - 1 stretches in and with it: itself, then those of its first half, then the
  // others.
  static std::size_t root(const Pair& stretch) { return std::size_t{2} * stretch.i; }
  static std::uint32_t middle(std::uint32_t first, std::uint32_t last) { return first + (last - first) / 2; }
  static std::size_t second_half(std::uint32_t first, std::uint32_t last, std::size_t at) {
    return at + std::size_t{2} * (middle(first, last) - first);
  }

  void look(const Chain& chain, std::uint32_t first, std::uint32_t last, std::size_t at) {
    if (last - first <= 1) return;
    // By how much it is above the tolerance does not matter.
    if (most_[at] <= tolerance_) most_[at] = std::max(most_[at], share_lost(stretch_of(chain, first, last)));
    look(chain, first, middle(first, last), at + 1);
    look(chain, middle(first, last), last, second_half(first, last, at));
  }
  void keep(std::uint32_t first, std::uint32_t last, std::size_t at, Thinning& thinning) const {
    if (most_[at] > tolerance_) {
      keep(first, middle(first, last), at + 1, thinning);
      return keep(middle(first, last), last, second_half(first, last, at), thinning);
    }
    thinning.kept.push_back(last);
    thinning.lost = std::max(thinning.lost, most_[at]);
  }

  const double tolerance_;
  const std::vector<Pair> whole_;  ///< their first and last spheres
  std::vector<double> most_;       ///< share_lost; 0 of a single step, of which nothing is left out
};

/// The stretches of a walk along frame 0, most of which are good for all frames as they are.
class Stretches {
 public:
  Stretches(const Chain& chain, std::span<const std::uint32_t> walked, double tolerance, Thinning& thinning)
      : tolerance_(tolerance), thinning_(thinning) {
    for (std::size_t k = 0; k < walked.size(); ++k)
      if (starts_strand(chain, walked[k]))
        thinning.kept.push_back(walked[k]);
      else
        whole_.push_back({walked[k - 1], walked[k]});
    most_.resize(whole_.size());
  }

  void look(const Chain& chain, const PeriodicBox* box) {
    for (std::size_t k = 0; k < whole_.size(); ++k)
      if (whole_[k].j - whole_[k].i > 1 && most_[k] <= tolerance_)
        most_[k] = std::max(most_[k], share_lost(stretch_of(chain, whole_[k].i, whole_[k].j)));
    own_.look(chain, box);
  }
  /// Keeps the ends of those that are good; gives the others.
  std::vector<Pair> settle() {
    std::vector<Pair> spoilt;
    for (std::size_t k = 0; k < whole_.size(); ++k) {
      if (most_[k] > tolerance_) {
        spoilt.push_back(whole_[k]);
        continue;
      }
      thinning_.kept.push_back(whole_[k].j);
      thinning_.lost = std::max(thinning_.lost, most_[k]);
    }
    thinning_.own = own_.most();
    return spoilt;
  }

 private:
  const double tolerance_;
  Thinning& thinning_;
  std::vector<Pair> whole_;  ///< their first and last spheres
  std::vector<double> most_;
  OwnLoss own_;
};

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

Thinning thin(const Animation& whole, std::span<const Pair> joints, double tolerance,
              std::span<const PeriodicBox> boxes) {
  if (!(tolerance > 0 && tolerance < 1))
    throw InputError(
        fmt::format("--tolerance {}: must be a share of the radius, above 0 and below 1", tolerance));
  const Chain chain = whole.frame(0);
  if (chain.exclusion().rule != Exclusion::Rule::arc_window)
    throw InputError(
        "--tolerance leaves spheres out, so that neighbours cannot be told by counting them: "
        "give --arc-window F too, such as pi/2");
  const auto for_each_frame = [&](auto& looks) {
    looks.look(chain, box_of(boxes, 0));
    for (std::uint32_t f = 1; f < whole.frames(); ++f) {
      const Chain moved = whole.frame(f);
      if (moved.size() != chain.size())
        throw InputError(fmt::format("--tolerance: frame {} has {}, frame 0 has {}", f,
                                     counted(moved.size(), "sphere"), chain.size()));
      looks.look(moved, box_of(boxes, f));
    }
  };
  Thinning thinning{.tolerance = tolerance, .spheres = chain.size(), .kept = {}};
  Stretches stretches(chain, Walk(joints, tolerance).first(chain), tolerance, thinning);
  for_each_frame(stretches);
  if (std::vector<Pair> spoilt = stretches.settle(); !spoilt.empty()) {
    Halves halves(std::move(spoilt), chain.size(), tolerance);
    for_each_frame(halves);
    halves.settle(thinning);
  }
  std::ranges::sort(thinning.kept);
  return thinning;
}

std::unique_ptr<Animation> thinned(std::unique_ptr<Animation> whole, const Thinning& thinning) {
  return std::make_unique<Thinned>(std::move(whole), thinning);
}

}  // namespace catena
