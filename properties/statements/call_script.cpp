#include "catena/properties/statements/call_script.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/properties/failing_allocations.h"
#include "catena/reference/enclosure.h"

namespace catena::properties {

/// Throws at the first edge past `most`.
struct CallScript::CountedEdges final : BoundsVisitor {
  explicit CountedEdges(std::uint64_t past) : most(past) {}
  void edge(std::uint32_t, const AnyBound&, std::uint32_t, const AnyBound&) override {
    if (edges++ == most) throw SinkThrew();
  }
  const std::uint64_t most;
  std::uint64_t edges = 0;
};

struct CallScript::ThrowingSink final : EvidenceSink {
  explicit ThrowingSink(std::uint64_t past) : left(past) {}
  void discarded(std::uint32_t, std::uint32_t) override { told(); }
  void tested(std::uint32_t, std::uint32_t) override { told(); }
  void excluded(std::uint32_t, std::uint32_t) override { told(); }
  void told() {
    if (left-- == 0) throw SinkThrew();
  }
  std::uint64_t left;
};

CallScript::CallScript(Variant& variant, const std::vector<Shot>& shots, std::uint64_t seed,
                       Collisions (&reused)[2], Troubles troubles)
    : variant_(variant),
      keeper_(dynamic_cast<KeepsAnswer*>(&variant)),
      shots_(shots),
      dice_(seed),
      reused_(reused),
      troubles_(troubles) {}

std::optional<std::string> CallScript::run() {
  prepare();
  Fault fault = build();
  for (int made = 0; made < calls && !fault; ++made) fault = call();
  if (fault) return told_ + ": " + *fault;
  return std::nullopt;
}

std::optional<std::string> CallScript::call() {
  switch (dice_.below(9)) {
    case 0:
      return prepare();
    case 1:
      return build();
    case 2:
    case 3:
      return update();
    case 4:
      return built_ ? look() : look_at_nothing();
    case 5:
      return find_with_evidence();
    default:
      return find();
  }
}

/// Whether the call came to its end: in some there is too little memory, in some a sink throws.
template <class Call>
bool CallScript::ends(const Call& call) {
  if (!troubles_.memory || !dice_.one_in(3)) try {
      call();
      return true;
    } catch (const SinkThrew&) {
      tell("which threw");
      return false;
    }
  const std::int64_t given = soon();
  tell("with {} allocations", given);
  try {
    const FailingAllocations none(given);
    call();
    return true;
  } catch (const std::bad_alloc&) {
  } catch (const SinkThrew&) {
  } catch (const PairLimitExceeded&) {
    throw;
  } catch (const Error&) {  // who has others do the work says what went wrong there
  }
  tell("which threw");
  return false;
}

SphereRange CallScript::some_of(const SphereRange& all, std::uint32_t n) {
  if (dice_.one_in(2)) return all;
  const SphereRange within = all.within(n);
  const std::uint32_t a = within.begin + dice_.below(within.size() + 1),
                      b = within.begin + dice_.below(within.size() + 1);
  if (dice_.one_in(8)) return {std::max(a, b), std::min(a, b)};  // of none
  return {std::min(a, b), std::max(a, b)};
}

std::optional<std::string> CallScript::prepare() {
  using enum Request::Want;
  next_ = {.want = dice_.pick({any, counts, pairs, pairs}),
           .queries = dice_.one_in(3) ? some_of({}, shots_.front().test.chain.size()) : SphereRange{},
           .frames_follow = dice_.one_in(2)};
  tell("prepare {} [{}, {})", word(next_.want), next_.queries.begin, next_.queries.end);
  variant_.prepare(next_);
  return std::nullopt;
}

std::optional<std::string> CallScript::build() {
  last_ = dice_.below(number_of_shots());
  prepared_ = next_;
  tell("build {}", last_);
  const Chain passing = shots_[last_].test.chain;  // it need not outlive the call
  built_ = false;
  try {
    built_ = ends([&] { variant_.build(passing); });
  } catch (const CapacityError&) {
    if (!troubles_.any) throw;
    tell("which is refused");
  }
  return std::nullopt;
}

std::optional<std::string> CallScript::update() {
  // Where nothing is built it differs from nothing, whatever is said.
  const Shot& before = built_ ? shots_[last_] : shots_[dice_.below(number_of_shots())];
  std::uint32_t next = dice_.below(number_of_shots());
  while (shots_[next].film != before.film) next = dice_.below(number_of_shots());
  const Shot& now = shots_[next];
  const Chain passing = now.test.chain;
  std::vector<SphereRange> ranges;
  Moved moved;
  if (before.along && now.along && dice_.one_in(2)) {
    tell("update {} along", next);
    moved = Moved::along(*now.along - *before.along);
  } else if (dice_.one_in(3)) {
    tell("update {}", next);
  } else {
    ranges = changes(before.test.chain, passing, dice_.one_in(2));
    moved = Moved(ranges);
    tell("update {} told", next);
  }
  last_ = next, prepared_ = next_, built_ = false;
  try {
    built_ = ends([&] { variant_.update(passing, moved); });
  } catch (const CapacityError&) {
    if (!troubles_.any) throw;
    tell("which is refused");
  }
  return std::nullopt;
}

/// What is looked at in between changes nothing, and its bounds enclose.
std::optional<std::string> CallScript::look() {
  tell("look");
  if (!ends([&] {
        static_cast<void>(variant_.timings());
        static_cast<void>(variant_.plan());
        static_cast<void>(variant_.work());
        static_cast<void>(variant_.answered_by());
        if (!troubles_.any || !dice_.one_in(2)) return;
        CountedEdges some(soon());
        variant_.visit_bounds(some);
      }))
    return std::nullopt;
  reference::EnclosureChecker checker(shots_[last_].test.chain);
  variant_.visit_bounds(checker);
  const auto report = checker.report();
  if (report.violations == 0) return std::nullopt;
  return fmt::format("{} of {} bounds do not enclose", report.violations, report.bounds);
}

std::optional<std::string> CallScript::look_at_nothing() {
  tell("look");
  CountedEdges edges(~std::uint64_t{0});
  if (!ends([&] {
        static_cast<void>(variant_.timings());
        static_cast<void>(variant_.plan());
        static_cast<void>(variant_.work());
        static_cast<void>(variant_.answered_by());
        variant_.visit_bounds(edges);
      }))
    return std::nullopt;
  if (edges.edges == 0) return std::nullopt;
  return fmt::format("{} bounds are shown, and nothing is built", edges.edges);
}

std::optional<std::string> CallScript::find() {
  const bool other = !built_ || (troubles_.any && dice_.one_in(8));
  const Case& test = other ? drawn_case() : shots_[last_].test;
  if (other && built_ && test.chain.size() == shots_[last_].test.chain.size()) return std::nullopt;
  Request request = prepared_;
  request.queries = some_of(prepared_.queries, test.chain.size());
  if (dice_.one_in(2))
    request.want = static_cast<Request::Want>(dice_.below(static_cast<std::uint32_t>(prepared_.want) + 1));
  const bool kept = keeper_ != nullptr && dice_.one_in(4);
  tell("{}{} {} [{}, {})", kept ? "find_kept" : "find", other ? " of another" : "", word(request.want),
       request.queries.begin, request.queries.end);
  Collisions fresh, &found = dice_.one_in(4) ? fresh : reused_[dice_.below(2)];
  const auto search = [&](const Request& asked) {
    if (!kept) return variant_.find(test.chain, asked, found);
    found = keeper_->find_kept(test.chain, asked);
    if (asked.want != Request::Want::pairs) found.pairs.clear();  // they may be there
  };
  try {
    return answer_of(test, request, kept, found, search);
  } catch (const std::logic_error& refusal) {
    if (!other) return fmt::format("refuses the chain that is built: {}", refusal.what());
    tell("which is refused");
    return std::nullopt;
  }
}

/// The search that is proved is that of all spheres, for counts or pairs.
std::optional<std::string> CallScript::find_with_evidence() {
  const Case& test = shots_[last_].test;
  if (prepared_.want == Request::Want::any || prepared_.queries != SphereRange{} ||
      variant_.evidence() == Accounting::none)
    return std::nullopt;
  Request request = prepared_;
  request.want = dice_.one_in(2) ? prepared_.want : Request::Want::counts;
  const std::uint64_t most = troubles_.any && dice_.one_in(2) ? soon() : ~std::uint64_t{0};
  tell("find {} with evidence", word(request.want));
  Collisions& found = reused_[dice_.below(2)];
  const auto search = [&](const Request& asked) {
    ThrowingSink sink(most);
    variant_.find_with_evidence(test.chain, asked, found, sink);
  };
  try {
    return answer_of(test, request, false, found, search);
  } catch (const std::logic_error& refusal) {
    if (built_) return fmt::format("refuses the chain that is built: {}", refusal.what());
    tell("which is refused");
    return std::nullopt;
  }
}

/// `kept`: past the limit what is left of the answer is no matter.
template <class Search>
std::optional<std::string> CallScript::answer_of(const Case& test, const Request& asked, bool kept,
                                                 Collisions& found, const Search& search) {
  Request request = asked;
  const Expected right = expected(test, request.queries);
  const std::uint64_t pairs = right.pairs.size();
  if (request.want == Request::Want::pairs && dice_.one_in(3)) {
    request.pair_limit = dice_.pick({pairs, pairs - (pairs > 0), std::uint64_t{0}});
    tell("limit {}", request.pair_limit);
  }
  const bool passes_limit = request.want == Request::Want::pairs && pairs > request.pair_limit;
  try {
    if (!ends([&] { search(request); })) return std::nullopt;
  } catch (const PairLimitExceeded& error) {
    if (!passes_limit || error.found() != pairs)
      return fmt::format("says {} pairs, there are {}", error.found(), pairs);
    if (!kept && !found.pairs.empty()) return "pairs are left past the limit";
    return std::nullopt;
  } catch (const CapacityError&) {
    if (!troubles_.any) throw;
    tell("which is refused");
    return std::nullopt;
  }
  if (passes_limit) return fmt::format("{} pairs pass the limit", pairs);
  return fault_of(found, request.want, right);
}

}  // namespace catena::properties
