#include <cstdint>

#include "catena/properties/mutants/mutant.h"

// Bugs in who is a neighbour. Each wrong rule is the right one on the chains that its author tried.
namespace catena::properties {
namespace {

/// The chain's exclusion rule as plain data, free to spoil.
class WrongRule : public FaultyTree {
 public:
  using Base = WrongRule;

 private:
  bool neighbours(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    ChainView spoilt = chain;
    spoil(spoilt.exclusion);
    return spoilt.neighbours(i, j);
  }
  virtual void spoil(ExclusionView&) const {}
};

class WindowOffByOne final : public WrongRule {
  void spoil(ExclusionView& rule) const override {
    if (rule.rule == Exclusion::Rule::index_window) --rule.window;
  }
};
const RegisterMutant<WindowOffByOne> off_by_one{"exclusion-window-off-by-one",
                                                "|i - j| < k for |i - j| <= k"};

class ExtraPairsIgnored final : public WrongRule {
  void spoil(ExclusionView& rule) const override { rule.extra_row = nullptr; }
};
const RegisterMutant<ExtraPairsIgnored> no_extra{"extra-pairs-ignored",
                                                 "branch joints collide with themselves"};

class AcrossStrands final : public WrongRule {
  void spoil(ExclusionView& rule) const override { rule.one_open_strand = true; }
};
const RegisterMutant<AcrossStrands> across{"neighbours-across-strands",
                                           "the end of one strand is a neighbour of the next one's start"};

class NotCyclic final : public FaultyTree {
  bool neighbours(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    const ExclusionView& rule = chain.exclusion;
    const bool far = (i < j ? j - i : i - j) > rule.window;
    return chain.neighbours(i, j) &&
           (rule.rule != Exclusion::Rule::index_window || rule.extra_row != nullptr || !far);
  }
};
const RegisterMutant<NotCyclic> not_cyclic{"window-not-cyclic",
                                           "a closed strand's last and first sphere collide"};

class AlwaysCyclic final : public FaultyTree {
  bool neighbours(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    return chain.neighbours(i, j) || (i < j ? j - i : i - j) + 1 == chain.size;
  }
};
const RegisterMutant<AlwaysCyclic> always_cyclic{"open-strand-taken-for-closed",
                                                 "both ends of an open tube are called neighbours"};

/// Arc lengths as stored, compared in the wrong way.
class WrongArc : public FaultyTree {
 public:
  using Base = WrongArc;

 private:
  bool neighbours(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    const ExclusionView& rule = chain.exclusion;
    if (rule.rule != Exclusion::Rule::arc_window || rule.extra_row != nullptr) return chain.neighbours(i, j);
    const std::uint32_t strand = rule.one_open_strand ? 0 : rule.strand_of[i];
    if (!rule.one_open_strand && strand != rule.strand_of[j]) return false;
    const double ahead = rule.arc[i] < rule.arc[j] ? rule.arc[j] - rule.arc[i] : rule.arc[i] - rule.arc[j];
    const double around =
        !rule.one_open_strand && rule.strand_closed[strand] ? rule.loop_length[strand] - ahead : ahead;
    return near(ahead, around, rule.factor * (double{chain.spheres[i].radius} + chain.spheres[j].radius));
  }
  virtual bool near(double ahead, double around, double window) const {
    return ahead < window || around < window;
  }
};

class ArcWithItsEnd final : public WrongArc {
  bool near(double ahead, double around, double window) const override {
    return ahead <= window || around <= window;
  }
};
const RegisterMutant<ArcWithItsEnd> with_end{"arc-window-with-its-end",
                                             "<= for < at the end of the arc window"};

class ArcOneWay final : public WrongArc {
  bool near(double ahead, double, double window) const override { return ahead < window; }
};
const RegisterMutant<ArcOneWay> one_way{"closed-arc-goes-one-way",
                                        "a closed tube is not measured around its seam"};

/// Whether two spheres are the same is asked of their values (CGAL#1629, drake PR#18736, in reverse).
class SelfByValue final : public FaultyTree {
  bool collide(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    return !(chain.spheres[i] == chain.spheres[j]) && FaultyTree::collide(chain, i, j);
  }
};
const RegisterMutant<SelfByValue> by_value{"self-by-value",
                                           "coincident spheres are taken for one and the same"};

/// Self-pairs are told by an id of 8 bits (mujoco#2444: by a packed body id).
class SelfById final : public FaultyTree {
  bool collide(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    return (i & 0xFF) != (j & 0xFF) && FaultyTree::collide(chain, i, j);
  }
};
const RegisterMutant<SelfById> by_id{"self-by-short-id", "mujoco#2444: self-pairs told by a packed id"};

/// The paper's exclusion does its work; without it, a sphere finds itself (Jolt#76).
class SelfPair final : public FaultyTree {
  void search(const ChainView& chain, std::uint32_t i) override {
    FaultyTree::search(chain, i);
    if (collide(chain, i, i)) hit(i, i);
  }
};
const RegisterMutant<SelfPair> self{"self-pair-counted", "Jolt#76: a sphere collides with itself"};

}  // namespace
}  // namespace catena::properties
