#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/property.h"

/// A variant that breaks one clause of a statement and nothing else.
namespace catena::properties {

using Want = Request::Want;

/// What a variant was told so far.
struct Told {
  const Chain* chain = nullptr;  ///< of the last build or update; null: none
  int builds = 0, updates = 0;
  int unsearched = 0;  ///< updates since the last find
  Request prepared;
  bool told_all = true, told_none = false;  ///< by the last update
};
struct Question {
  const Told& told;
  const Chain& chain;
  const Request& request;
};

/// All pairs, but for one fault.
class Faulty final : public Variant {
 public:
  struct Fault {
    /// After an honest answer.
    std::function<void(const Question&, Collisions&)> spoil = {};
    /// In place of one, where it returns true.
    std::function<bool(const Question&, Collisions&)> instead = {};
    /// Of build and update.
    std::function<void(const Told&)> begin = {};
    std::function<void(const Told&, BoundsVisitor&)> bounds = {};
  };
  explicit Faulty(const Fault& fault) : fault_(fault) {}

  void prepare(const Request& request) override { told_.prepared = request; }
  void build(const Chain& chain) override { ++told_.builds, told_.told_all = true, begin(chain); }
  void update(const Chain& chain, const Moved& moved) override {
    ++told_.updates, ++told_.unsearched, told_.told_all = moved.everything() && moved.shift() == 0;
    told_.told_none = !moved.everything() && moved.ranges().empty();
    begin(chain);
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    const Question question{told_, chain, request};
    if (fault_.instead && fault_.instead(question, result)) return searched();
    if (told_.chain == nullptr || held_.size() != chain.size())
      throw std::logic_error("find: not the chain of the last build");
    const auto honest = StrategyRegistry::instance().make("CPU1");
    honest->build(chain);
    honest->find(chain, request, result);
    if (fault_.spoil) fault_.spoil(question, result);
    searched();
  }
  void visit_bounds(BoundsVisitor& visitor) const override {
    if (fault_.bounds && told_.chain != nullptr) fault_.bounds(told_, visitor);
  }
  Timings timings() const override { return {}; }

 private:
  void searched() { told_.unsearched = 0; }
  void begin(const Chain& chain) {
    held_ = chain, told_.chain = &held_;
    if (fault_.begin) fault_.begin(told_);
  }
  const Fault fault_;
  Chain held_;
  Told told_;
};

inline void drop_a_pair(Collisions& found) {
  if (found.pairs.empty()) return;
  const Pair gone = found.pairs.back();
  found.pairs.pop_back(), --found.pair_count;
  --found.count[gone.i], --found.count[gone.j];
  found.found = found.pair_count > 0;
}

/// A row whose every sphere touches the next but one, in strands and with a joint, so that each relation has
/// something to change.
inline Case row(bool strands = false) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < 24; ++i)
    spheres.push_back({static_cast<float>(i), i % 4 ? 0 : 0.25f, 0, 1.25f});
  Exclusion exclusion = Exclusion::index(1);
  if (strands) exclusion.extra_pairs = {{3, 5}};
  return Case::of(
      Chain(std::move(spheres), strands ? Strands{{0, 7, 16, 24}, {0, 0, 0}} : Strands{}, exclusion));
}

inline std::optional<std::string> asked(const std::string& property, const Faulty::Fault& fault,
                                        const Case& test, VariantInfo info = {}) {
  if (info.name.empty()) info.name = "faulty";
  const Subject subject{info, [&] { return std::make_unique<Faulty>(fault); }};
  for (const auto& p : PropertyRegistry::instance().make_all())
    if (p->name() == property) {
      Faulty variant(fault);
      return p->check(subject, variant, test);
    }
  ADD_FAILURE() << "there is no property " << property;
  return std::nullopt;
}

inline void expect_noticed(const std::string& property, const Faulty::Fault& fault, const std::string& words,
                           const Case& test = row(), const VariantInfo& info = {}) {
  EXPECT_EQ(asked(property, {}, test, info), std::nullopt) << property;
  const auto fault_found = asked(property, fault, test, info);
  ASSERT_TRUE(fault_found) << property << ": not '" << words << "'";
  EXPECT_NE(fault_found->find(words), std::string::npos) << property << ": " << *fault_found;
}

inline VariantInfo rounded() {
  VariantInfo info;
  info.exact = false;
  return info;
}

/// Two spheres a node, in one tree, whose bounds are `wide`.
inline void show_twos(const Chain& chain, BoundsVisitor& visitor, double wide, std::uint32_t first = 0) {
  visitor.tree({.nested = true});
  for (std::uint32_t i = first; i + 1 < chain.size(); i += 2)
    for (const std::uint32_t k : {i, i + 1})
      visitor.edge(chain.size() + i, Sphere64{chain[i].x, chain[i].y, chain[i].z, wide}, k,
                   Sphere64{chain[k].x, chain[k].y, chain[k].z, chain[k].radius});
}

}  // namespace catena::properties
