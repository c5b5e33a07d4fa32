#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/strategy/keeps_answer.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/property.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/statements/moved_frame.h"
#include "catena/reference/enclosure.h"

namespace catena::properties {
namespace {

/// A chain that a script may take, with its answer.
struct Shot {
  Case test;
  int film;  ///< those of one number are frames of one another
  std::optional<std::int64_t>
      along;  ///< this many spheres on along the film's first frame, where it is no other
};

/// The chain, frames of it, another chain and its frame, and one of no spheres.
std::vector<Shot> shots_of(const Chain& chain) {
  std::vector<Shot> shots;
  const auto add = [&](const Chain& shot, int film, std::optional<std::int64_t> along = std::nullopt) {
    shots.push_back({Case::of(shot), film, along});
  };
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  add(chain, 0, 0);
  add(partly_moved_frame(chain).first, 0);
  add(shaken_frame(chain), 0);
  add(thinned_frame(chain), 0);
  if (spheres.size() > 2) {
    std::ranges::rotate(spheres, spheres.begin() + 2);
    add(chain.moved(spheres), 0, 2);
  }
  spheres.resize((spheres.size() + 1) / 2);
  const Chain shorter(std::move(spheres));
  add(shorter, 1);
  add(moved_frame(shorter), 1);
  add(Chain(), 2);
  return shots;
}

/// The same numbers for the same chain, so that a failure shows again.
std::uint64_t seed_of(const Chain& chain) {
  std::uint64_t seed = chain.size();
  for (const Sphere& s : chain.spheres())
    for (const float x : {s.x, s.y, s.z, s.radius})
      seed = (seed ^ std::bit_cast<std::uint32_t>(x)) * 0x100000001B3u;
  return seed;
}

/// Where two frames differ, and sometimes a sphere more on either side.
std::vector<SphereRange> changes(const Chain& from, const Chain& to, bool wider) {
  std::vector<SphereRange> ranges;
  const std::uint32_t n = to.size(), more = wider ? 1 : 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (std::memcmp(&from[i], &to[i], sizeof(Sphere)) == 0) continue;
    const SphereRange here{i - std::min(i, more), std::min(n, i + 1 + more)};
    if (!ranges.empty() && here.begin <= ranges.back().end)
      ranges.back().end = here.end;
    else
      ranges.push_back(here);
  }
  return ranges;
}

const char* word(Request::Want want) {
  return want == Request::Want::any ? "any" : want == Request::Want::counts ? "counts" : "pairs";
}

/// What a request for some spheres is to be answered.
struct Expected {
  std::vector<std::uint32_t> count;
  std::vector<Pair> pairs;
};
Expected expected(const Case& test, const SphereRange& queries) {
  Expected right{test.exact.count, {}};
  for (std::uint32_t i = 0; i < test.chain.size(); ++i)
    if (!queries.contains(i)) right.count[i] = 0;
  std::ranges::copy_if(test.exact.pairs, std::back_inserter(right.pairs),
                       [&](const Pair& p) { return queries.contains(p.i); });
  return right;
}

/// One run of drawn calls on one variant, each answer held against the exact one.
class Script {
 public:
  Script(Variant& variant, const std::vector<Shot>& shots, std::uint64_t seed, Collisions (&reused)[2])
      : variant_(variant),
        keeper_(dynamic_cast<KeepsAnswer*>(&variant)),
        shots_(shots),
        dice_(seed),
        reused_(reused) {}

  /// What went wrong, with the calls up to there.
  std::optional<std::string> run() {
    prepare(), build();
    for (int call = 0; call < calls; ++call) {
      switch (dice_.below(8)) {
        case 0:
          prepare();
          break;
        case 1:
          build();
          break;
        case 2:
        case 3:
          update();
          break;
        case 4:
          if (auto fault = look()) return told_ + ": " + *fault;
          break;
        default:
          if (auto fault = find()) return told_ + ": " + *fault;
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr int calls = 24;

  const Shot& shot() const { return shots_[built_]; }
  template <class... Args>
  void tell(fmt::format_string<Args...> format, Args&&... args) {
    told_ += (told_.empty() ? "" : ", ") + fmt::format(format, std::forward<Args>(args)...);
  }

  SphereRange some_of(const SphereRange& all, std::uint32_t n) {
    if (dice_.one_in(2)) return all;
    const SphereRange within = all.within(n);
    const std::uint32_t a = within.begin + dice_.below(within.size() + 1),
                        b = within.begin + dice_.below(within.size() + 1);
    return {std::min(a, b), std::max(a, b)};
  }

  void prepare() {
    next_ = {.want = dice_.pick({Request::Want::any, Request::Want::counts, Request::Want::pairs}),
             .queries = dice_.one_in(3) ? some_of({}, shots_.front().test.chain.size()) : SphereRange{},
             .frames_follow = dice_.one_in(2)};
    tell("prepare {} [{}, {})", word(next_.want), next_.queries.begin, next_.queries.end);
    variant_.prepare(next_);
  }

  void build() {
    built_ = dice_.below(static_cast<std::uint32_t>(shots_.size()));
    prepared_ = next_;
    tell("build {}", built_);
    const Chain passing = shot().test.chain;  // it need not outlive the call
    variant_.build(passing);
  }

  void update() {
    const Shot& before = shot();
    const auto next = dice_.below(static_cast<std::uint32_t>(shots_.size()));
    if (shots_[next].film != before.film) return;
    built_ = next, prepared_ = next_;
    const Chain passing = shot().test.chain;
    if (before.along && shot().along && dice_.one_in(2)) {
      tell("update {} along", next);
      return variant_.update(passing, Moved::along(*shot().along - *before.along));
    }
    if (dice_.one_in(3)) {
      tell("update {}", next);
      return variant_.update(passing);
    }
    const auto ranges = changes(before.test.chain, passing, dice_.one_in(2));
    tell("update {} told", next);
    variant_.update(passing, Moved(ranges));
  }

  /// What is looked at in between changes nothing, and its bounds enclose.
  std::optional<std::string> look() {
    tell("look");
    static_cast<void>(variant_.timings());
    static_cast<void>(variant_.plan());
    static_cast<void>(variant_.work());
    static_cast<void>(variant_.answered_by());
    reference::EnclosureChecker checker(shot().test.chain);
    variant_.visit_bounds(checker);
    const auto report = checker.report();
    if (report.violations == 0) return std::nullopt;
    return fmt::format("{} of {} bounds do not enclose", report.violations, report.bounds);
  }

  std::optional<std::string> find() {
    const Case& test = shot().test;
    Request request = prepared_;
    request.queries = some_of(prepared_.queries, test.chain.size());
    request.want = static_cast<Request::Want>(dice_.below(static_cast<std::uint32_t>(prepared_.want) + 1));
    const Expected right = expected(test, request.queries);
    const std::uint64_t pairs = right.pairs.size();
    if (request.want == Request::Want::pairs && dice_.one_in(3))
      request.pair_limit = dice_.pick({pairs, pairs - (pairs > 0), std::uint64_t{0}});
    const bool kept = keeper_ != nullptr && dice_.one_in(4);
    tell("{} {} [{}, {}) limit {}", kept ? "find_kept" : "find", word(request.want), request.queries.begin,
         request.queries.end, request.pair_limit);
    Collisions fresh, &found = dice_.one_in(4) ? fresh : reused_[dice_.below(2)];
    const bool passes_limit = request.want == Request::Want::pairs && pairs > request.pair_limit;
    try {
      if (kept) {
        found = keeper_->find_kept(test.chain, request);
        if (request.want != Request::Want::pairs) found.pairs.clear();  // they may be there
      } else {
        variant_.find(test.chain, request, found);
      }
    } catch (const PairLimitExceeded& error) {
      if (!passes_limit || error.found() != pairs)
        return fmt::format("says {} pairs, there are {}", error.found(), pairs);
      if (!kept && !found.pairs.empty()) return "pairs are left past the limit";
      return std::nullopt;
    }
    if (passes_limit) return fmt::format("{} pairs pass the limit", pairs);
    return fault_of(found, request.want, right);
  }

  static std::optional<std::string> fault_of(Collisions& found, Request::Want want, const Expected& right) {
    if (found.found != !right.pairs.empty())
      return fmt::format("found is {}, with {} pairs", found.found, right.pairs.size());
    if (want == Request::Want::any) return std::nullopt;
    if (found.pair_count != right.pairs.size())
      return fmt::format("{} pairs, exactly {}", found.pair_count, right.pairs.size());
    if (found.count != right.count) return "other counts";
    if (want == Request::Want::counts)
      return found.pairs.empty() ? std::nullopt : std::optional<std::string>("pairs that nobody asked for");
    sort(found.pairs);
    return found.pairs == right.pairs ? std::nullopt : std::optional<std::string>("other pairs");
  }

  Variant& variant_;
  KeepsAnswer* const keeper_;
  const std::vector<Shot>& shots_;
  Dice dice_;
  Collisions (&reused_)[2];
  Request next_, prepared_;
  std::uint32_t built_ = 0;
  std::string told_;
};

/// In whatever order a caller prepares, builds, updates and asks, within what it prepared for, each answer is
/// that of the chain of the last build or update: nothing of an earlier chain, request, error or answer is
/// left in it.
class Calls final : public Property {
 public:
  std::string name() const override { return "calls in any order"; }
  bool applies_to(const Subject& subject) const override { return subject.exact(); }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    const auto& shots = shots_(test, [&] { return shots_of(test.chain); });
    struct Reset {  // also where a declared limit is passed
      Variant& variant;
      ~Reset() { variant.prepare({}); }
    } reset{variant};
    return Script(variant, shots, seed_of(test.chain), reused_).run();
  }

 private:
  DerivedFrom<std::vector<Shot>> shots_;
  Collisions reused_[2];
};

const RegisterProperty<Calls> registered;

}  // namespace
}  // namespace catena::properties
