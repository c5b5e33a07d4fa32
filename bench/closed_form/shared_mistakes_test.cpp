#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/closed_form/lattice_box.h"
#include "catena/bench/enumerate/judge.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/family.h"
#include "catena/reference/reference.h"

// What a variant and the reference misread alike no property can see. These mutants are of the definition
// itself, and die of what others published or a formula knows, alone.
namespace catena::bench {
namespace {

struct Mistake {
  std::string name;
  std::function<Chain(const Chain&)> reads;
};

Chain with_radii(const Chain& chain, const std::function<float(float)>& radius) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (Sphere& s : spheres) s.radius = radius(s.radius);
  return chain.moved(std::move(spheres));
}

Chain with(const Chain& chain, Strands strands, Exclusion exclusion) {
  return Chain({chain.spheres().begin(), chain.spheres().end()}, std::move(strands), std::move(exclusion));
}

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> mistakes{
      {"touching is not overlapping",
       [](const Chain& c) { return with_radii(c, [](float r) { return std::nextafter(r, 0.0f); }); }},
      {"a radius is a diameter", [](const Chain& c) { return with_radii(c, [](float r) { return r / 2; }); }},
      {"the window is one wider",
       [](const Chain& c) {
         Exclusion wider = c.exclusion();
         ++wider.window;
         return with(c, c.strands(), std::move(wider));
       }},
      {"a strand goes on in the next", [](const Chain& c) { return with(c, {}, c.exclusion()); }},
      {"every strand is closed",
       [](const Chain& c) {
         Strands closed = c.strands();
         std::ranges::fill(closed.closed, std::uint8_t{1});
         return with(c, std::move(closed), c.exclusion());
       }},
  };
  return mistakes;
}

/// A variant that is right but for the mistake.
class Mistaken final : public Variant {
 public:
  explicit Mistaken(const Mistake& mistake) : mistake_(mistake) {}

  void prepare(const Request& request) override { right_->prepare(request); }
  void build(const Chain& chain) override { right_->build(read_ = mistake_.reads(chain)); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    right_->find(read_ = mistake_.reads(chain), request, result);
  }
  Timings timings() const override { return right_->timings(); }

 private:
  const Mistake& mistake_;
  std::unique_ptr<Variant> right_ = StrategyRegistry::instance().make("CPU1");
  Chain read_;
};

/// Who from outside disagrees.
std::string judge_against(Variant& variant) {
  for (const float radius : {0.5f, std::nextafter(0.5f, 0.0f)})
    for (const WalkVerdict& v : judge_walks(variant, {3, radius, radius < 0.5f, 5}))
      if (v.differs()) return fmt::format("{}: {} of {} steps", v.sequence, v.counts, v.steps);
  for (const LatticeBox& box :
       {LatticeBox{.side = 5, .reach = 2}, LatticeBox{.side = 5, .reach = 2, .rods = true}}) {
    const Chain chain = open_input(box.scene()).animation->frame(0);
    Collisions found;
    variant.build(chain);
    variant.find(chain, {}, found);
    if (const std::string fault = bench::fault(box, found, true); !fault.empty())
      return fmt::format("closed form of {}: {}", box.scene(), fault);
  }
  return "";
}

TEST(SharedMistakes, DieOfJudgesFromOutsideAlone) {
  EXPECT_EQ(judge_against(*StrategyRegistry::instance().make("CPU1")), "");
  for (const Mistake& mistake : mistakes()) {
    Mistaken variant(mistake);
    std::uint64_t differ = 0, seed = 0;
    for (const properties::Family& family : properties::FamilyRegistry::instance().families()) {
      properties::Dice dice(++seed);
      const Chain chain = properties::generate(family, dice, 60);
      if (chain.exclusion().rule != Exclusion::Rule::index_window || !chain.exclusion().extra_pairs.empty())
        continue;
      Collisions found;
      variant.build(chain);
      variant.find(chain, {}, found);
      const auto misread = reference::find(mistake.reads(chain)), right = reference::find(chain);
      std::ranges::sort(found.pairs);
      EXPECT_TRUE(found.pairs == misread.pairs)
          << mistake.name << ": a reference that misreads alike must agree";
      differ += misread.pairs != right.pairs;
    }
    EXPECT_GT(differ, 0u) << mistake.name << " changes nothing";
    const std::string judge = judge_against(variant);
    fmt::print("{:<32} killed by {}\n", mistake.name, judge.empty() ? "nobody" : judge);
    EXPECT_NE(judge, "") << mistake.name;
  }
}

}  // namespace
}  // namespace catena::bench
