#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "catena/core/error.h"
#include "catena/properties/property.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"

/// Checks that some mutants need, under the names of the properties that replace them: where the registry has
/// a property of that name, it is used instead.
namespace catena::properties::testing {

class UpdateIsBuild final : public Property {
 public:
  std::string name() const override { return "update is build"; }
  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    std::vector<Sphere> moved(test.chain.spheres().begin(), test.chain.spheres().end()), swollen = moved;
    for (std::size_t i = 1; i < moved.size(); ++i) moved[i].x = moved[i - 1].x;
    for (Sphere& s : swollen) s.radius = std::min(2 * s.radius, 1e38f);
    for (const auto& spheres : {moved, swollen}) {
      const Chain chain = test.chain.moved(spheres);
      variant.build(test.chain);
      variant.update(chain);
      variant.find(chain, {}, found_);
      if (!reference::compare(chain, reference::find(chain), found_).right())
        return "not the answer of a build";
    }
    return std::nullopt;
  }

 private:
  Collisions found_;
};

class RequestsAgree final : public Property {
 public:
  std::string name() const override { return "requests agree"; }
  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    variant.build(test.chain);
    for (const bool before : {false, true}) {
      Collisions any, counts;
      any.found = before;
      variant.find(test.chain, {Request::Want::any}, any);
      if (any.found != (test.exact.pair_count > 0)) return "any";
      variant.find(test.chain, {Request::Want::counts}, counts);
      if (counts.count != test.exact.count || counts.pair_count != test.exact.pair_count) return "counts";
    }
    return std::nullopt;
  }
};

class PairLimit final : public Property {
 public:
  std::string name() const override { return "pair limit"; }
  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    if (test.exact.pair_count == 0) return std::nullopt;
    variant.build(test.chain);
    Collisions found;
    for (const std::uint64_t limit : {test.exact.pair_count - 1, test.exact.pair_count / 2}) try {
        variant.find(test.chain, {Request::Want::pairs, limit}, found);
        return "no error past the limit";
      } catch (const PairLimitExceeded& error) {
        if (error.found() != test.exact.pair_count) return "the error does not state the true number";
      }
    return std::nullopt;
  }
};

class SameAnswerAgain final : public Property {
 public:
  std::string name() const override { return "same answer again"; }
  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    variant.build(test.chain);
    Collisions first, again;
    variant.find(test.chain, {}, first);
    for (int run = 0; run < 3; ++run) {
      variant.find(test.chain, {}, again);
      if (again.pairs.size() != first.pairs.size() || again.count != first.count) return "another answer";
    }
    return std::nullopt;
  }
};

/// Every registered property, and the checks above that are not among them.
inline std::vector<std::unique_ptr<Property>> all_properties() {
  auto all = PropertyRegistry::instance().make_all();
  const auto add = [&](std::unique_ptr<Property> check) {
    if (std::ranges::none_of(all, [&](const auto& p) { return p->name() == check->name(); }))
      all.push_back(std::move(check));
  };
  add(std::make_unique<UpdateIsBuild>());
  add(std::make_unique<RequestsAgree>());
  add(std::make_unique<PairLimit>());
  add(std::make_unique<SameAnswerAgain>());
  return all;
}

}  // namespace catena::properties::testing
