#include <algorithm>
#include <cmath>

#include "catena/core/frames/frame_difference.h"
#include "catena/core/frames/frame_search.h"
#include "catena/properties/mutants/mutant.h"

// Bugs of searches that use what frames have in common: what a comparison of two frames, or the check of a
// kept list, may forget.
namespace catena::properties {
namespace {

/// A right search of frames around aCPU2+Dual, with some part of it broken.
class FaultyFrames : public Variant {
 public:
  using Base = FaultyFrames;
  FaultyFrames() : FaultyFrames(std::make_unique<FrameSearch>(Omissions(), true)) {}
  explicit FaultyFrames(std::unique_ptr<FrameSearch> frames)
      : base_(StrategyRegistry::instance().make("aCPU2+Dual")), frames_(std::move(frames)) {}

  void build(const Chain& chain) override {
    frames_->begin(true);
    n_ = chain.size();
  }
  void update(const Chain& chain, const Moved& moved) override {
    if (n_ != chain.size()) return build(chain);
    frames_->update(chain, moved);
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (n_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
    const FullSearch search = [this](const Chain& c, const Request& r, Collisions& found) {
      base_->build(c);
      base_->find(c, r, found);
    };
    frames_->find(chain, request, result, search, search, 0);
  }
  Timings timings() const override { return {}; }

 private:
  std::unique_ptr<Variant> base_;
  std::unique_ptr<FrameSearch> frames_;
  std::optional<std::uint32_t> n_;
};

template <class List>
class WithList final : public FaultyFrames {
 public:
  WithList() : FaultyFrames(std::make_unique<FrameSearch>(Omissions(), true, std::make_unique<List>())) {}
};
template <class Search>
class WithSearch final : public FaultyFrames {
 public:
  WithSearch() : FaultyFrames(std::make_unique<Search>(Omissions(), true)) {}
};

const std::vector<ParameterInfo> frames_parameter{{"frames", "always", "used always"}};

class CheckedSometimes final : public KeptList {
  bool holds(const Chain& chain) override {
    return KeptList::holds(chain) || (made() && ++calls_ % 4 != 0 && chain.size() == thick().size());
  }
  unsigned calls_ = 0;
};
const RegisterMutant<WithList<CheckedSometimes>> sometimes{
    "skin-checked-every-fourth-frame", "molecular dynamics' fixed rebuild interval ('dangerous builds')",
    frames_parameter};

class RoundedDown final : public KeptList {
  bool holds(const Chain& chain) override {
    if (!made() || chain.size() != thick().size()) return false;
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
      const Sphere &a = chain[i], &b = thick()[i];
      const float moved = std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)});
      if (!(moved <= b.radius - a.radius)) return false;
    }
    return true;
  }
};
const RegisterMutant<WithList<RoundedDown>> down{
    "displacement-rounded-down", "the greatest of three coordinates, which is less than the distance",
    frames_parameter};

class GrowthForgotten final : public KeptList {
  bool holds(const Chain& chain) override {
    if (!made() || chain.size() != thick().size()) return false;
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
      const Sphere &a = chain[i], &b = thick()[i];
      if (!(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) <= skin() * 0.99f)) return false;
    }
    return true;
  }
};
const RegisterMutant<WithList<GrowthForgotten>> growth{
    "growth-forgotten", "a skin for what moves alone, where radii grow", frames_parameter};

class InnerListNeverPruned final : public KeptList {
  bool inner_holds(std::span<const Sphere>, std::span<const Sphere>) const override { return true; }
};
const RegisterMutant<WithList<InnerListNeverPruned>> never_pruned{
    "inner-list-never-pruned-again",
    "GROMACS 2018 to 2024 (issue 5138): pairs lost through a pruned list that outlived its skin",
    frames_parameter};

class ShrinkingForgotten final : public KeptList {
  bool inner_holds(std::span<const Sphere> here, std::span<const Sphere> before) const override {
    return KeptList::inner_holds(here, before) ||
           std::ranges::equal(here, before, [](const Sphere& a, const Sphere& b) {
             return a.x == b.x && a.y == b.y && a.z == b.z && a.radius <= b.radius;
           });
  }
};
const RegisterMutant<WithList<ShrinkingForgotten>> shrinking{
    "shrinking-forgotten", "pairs that touched deeply are taken to touch for good, where radii shrink",
    frames_parameter};

class OuterForInner final : public KeptList {
  bool inner_within(std::span<const Sphere>) const override { return true; }
};
const RegisterMutant<WithList<OuterForInner>> outer_for_inner{
    "outer-skin-taken-for-held",
    "a list pruned at the edge of its skin is used until the inner skin ends, too", frames_parameter};

class OneSkinForTwo final : public KeptList {
  float open_skin() const override { return KeptList::open_skin() / 2; }
};
const RegisterMutant<WithList<OneSkinForTwo>> one_skin{
    "inner-list-of-one-skin", "pairs are settled as if one of two spheres moved alone", frames_parameter};

template <class Cells>
class WithCells final : public FaultyFrames {
 public:
  WithCells()
      : FaultyFrames(std::make_unique<FrameSearch>(Omissions(), true, std::make_unique<KeptList>(),
                                                   std::make_unique<Cells>())) {}
};

class ReachOfOneRadius final : public MovedCells {
  float reach(const Sphere& s, float) const override { return s.radius; }
};
const RegisterMutant<WithCells<ReachOfOneRadius>> one_radius{
    "moved-reach-of-one-radius",
    "a sphere that moved is looked for where centres lie in it, not where spheres touch", frames_parameter};

class MetFromBoth final : public MovedCells {
  bool lay_out(const ChainView& chain, std::span<const std::uint32_t> moved) override {
    none_.assign(chain.size / 32 + 1, 0);
    return MovedCells::lay_out(chain, moved);
  }
  CellsOfFew view() const override {
    CellsOfFew cells = MovedCells::view();
    cells.is_few = none_.data();
    return cells;
  }
  std::vector<std::uint32_t> none_;
};
const RegisterMutant<WithCells<MetFromBoth>> both{
    "moved-met-from-both", "a pair of two spheres that moved is found from each of them", frames_parameter};

class LastMovedForgotten final : public MovedCells {
  bool lay_out(const ChainView& chain, std::span<const std::uint32_t> moved) override {
    return MovedCells::lay_out(chain, moved.size() > 1 ? moved.first(moved.size() - 1) : moved);
  }
};
const RegisterMutant<WithCells<LastMovedForgotten>> last_moved{
    "moved-last-forgotten", "the last sphere that moved is not laid out", frames_parameter};

class CellsOfAnotherScale final : public MovedCells {
  CellsOfFew view() const override {
    CellsOfFew cells = MovedCells::view();
    for (float& scale : cells.scale) scale *= 0.9f;
    return cells;
  }
};
const RegisterMutant<WithCells<CellsOfAnotherScale>> scale{
    "moved-cells-of-another-scale", "places are laid out and looked up by cells of different width",
    frames_parameter};

class DirtyRangeTooShort final : public FrameSearch {
 public:
  using FrameSearch::FrameSearch;

 private:
  bool find_changes(std::span<const Sphere> before, std::span<const Sphere> now, std::uint32_t most,
                    std::vector<SphereRange>& ranges) const override {
    const bool few = FrameSearch::find_changes(before, now, most, ranges);
    for (SphereRange& range : ranges) --range.end;
    return few;
  }
};
const RegisterMutant<WithSearch<DirtyRangeTooShort>> range{
    "dirty-range-off-by-one", "the last sphere of a stretch that differs counts as unmoved",
    frames_parameter};

class RadiiNotCompared final : public FrameSearch {
 public:
  using FrameSearch::FrameSearch;

 private:
  bool find_changes(std::span<const Sphere> before, std::span<const Sphere> now, std::uint32_t most,
                    std::vector<SphereRange>& ranges) const override {
    const auto same_centre = [](const Sphere& a, const Sphere& b) {
      return a.x == b.x && a.y == b.y && a.z == b.z;
    };
    ranges.clear();
    if (std::ranges::equal(before, now, same_centre)) return true;
    return FrameSearch::find_changes(before, now, most, ranges);
  }
};
const RegisterMutant<WithSearch<RadiiNotCompared>> radii{
    "still-frame-by-its-centres", "a frame whose radii alone change counts as unmoved", frames_parameter};

class FramesBetweenForgotten final : public FaultyFrames {
 public:
  void prepare(const Request& request) override { yes_or_no_ = request.want == Request::Want::any; }
  void update(const Chain& chain, const Moved& moved) override {
    if (!yes_or_no_) FaultyFrames::update(chain, moved);
  }

 private:
  bool yes_or_no_ = false;
};
const RegisterMutant<FramesBetweenForgotten> between{"frames-between-forgotten",
                                                     "what moved since the last frame is taken to have since "
                                                     "the last one that pairs were asked of (auto, 2026)",
                                                     frames_parameter};

class ShiftBySamples final : public FrameSearch {
 public:
  using FrameSearch::FrameSearch;

 private:
  std::optional<std::int64_t> find_shift(std::span<const Sphere> before, std::span<const Sphere> now,
                                         std::uint32_t most, std::int64_t) const override {
    for (std::size_t s = 1; s <= most && s < now.size(); ++s) {
      const std::size_t last = now.size() - 1 - s;
      if (before[s] == now[0] && before[s + last / 4] == now[last / 4] && before[s + last] == now[last])
        return static_cast<std::int64_t>(s);
    }
    return std::nullopt;
  }
};
const RegisterMutant<WithSearch<ShiftBySamples>> samples{
    "shift-seen-by-samples", "a shift is taken for one where a sphere in the middle differs",
    frames_parameter};

}  // namespace
}  // namespace catena::properties
