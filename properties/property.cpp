#include "catena/properties/property.h"

#include <algorithm>
#include <atomic>

#include "catena/core/error.h"
#include "catena/reference/reference.h"

namespace catena::properties {

namespace {

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

Case::Case(Chain of, reference::Answer answer)
    : chain(std::move(of)), exact(std::move(answer)), number(next_number()) {}

Case Case::of(Chain chain) {
  Request request;
  request.pair_limit = std::uint64_t{1} << 24;
  reference::Answer exact = reference::find(chain, request);
  return Case(std::move(chain), std::move(exact));
}

Subject Subject::of(VariantInfo info) {
  auto make = [name = info.name] { return StrategyRegistry::instance().make(name); };
  return {std::move(info), std::move(make)};
}

Subject Subject::named(const std::string& variant) { return of(StrategyRegistry::instance().describe(variant)); }

std::vector<Subject> Subject::available(bool with_mutants) {
  std::vector<Subject> subjects;
  for (auto& info : StrategyRegistry::instance().variants(with_mutants))
    if (!info.unavailable) subjects.push_back(of(std::move(info)));
  return subjects;
}

PropertyRegistry& PropertyRegistry::instance() {
  static PropertyRegistry registry;
  return registry;
}

std::vector<std::unique_ptr<Property>> PropertyRegistry::make_all() const {
  std::vector<std::unique_ptr<Property>> all;
  for (const auto& make : makers_) all.push_back(make());
  std::ranges::sort(all, {}, [](const auto& p) { return p->name(); });
  return all;
}

}  // namespace catena::properties
