#include "catena/reference/verify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <string>
#include <vector>

#include "catena/core/counted.h"
#include "catena/core/thrown.h"
#include "catena/reference/reference.h"

namespace catena::reference {
namespace {

using Find = std::function<void(const Request&, Collisions&)>;

/// False when there are more pairs than a request allows.
bool find_pairs(const Find& find, Collisions& found) {
  try {
    find({Request::Want::pairs}, found);
    return true;
  } catch (const PairLimitExceeded&) {
    return false;
  }
}

/// Asks for what `exact` has and compares. Too many invented pairs must not end it: then counts are compared.
void ask_and_compare(const Find& find, const Chain& chain, const Answer& exact, Verification& v) {
  Collisions found;
  v.by_pairs = exact.has_pairs && find_pairs(find, found);
  if (!v.by_pairs) find({Request::Want::counts}, found);
  v.comparison = v.by_pairs ? compare(chain, exact, found) : compare_counts(exact, found);
  v.ran = true;
}

std::string what_differs(const Verification& v) {
  const Comparison& c = v.comparison;
  std::vector<std::string> parts;
  const auto say = [&](bool applies, std::string text) {
    if (applies) parts.push_back(std::move(text));
  };
  say(c.missing + c.invented > c.neighbours, fmt::format("largest margin {:.1e}", c.worst_margin));
  say(c.neighbours > 0, fmt::format("{} neighbours reported", c.neighbours));
  say(c.repeated > 0, fmt::format("{} pairs repeated", c.repeated));
  say(c.malformed > 0, fmt::format("{} pairs not i < j < n", c.malformed));
  say(c.wrong_counts > 0 && (!v.by_pairs || c.missing + c.invented == 0),
      fmt::format("{} counts wrong{}", c.wrong_counts,
                  v.by_pairs ? "" : " (compared by counts: a flood of pairs)"));
  say(c.inconsistent_counts > 0, fmt::format("{} counts unlike its pairs", c.inconsistent_counts));
  say(c.wrong_total, "wrong total");
  say(v.enclosure.violations > 0, fmt::format("{:.1f} % unenclosed, worst by {:.1e} of the parent",
                                              100 * v.enclosure.share(), v.enclosure.worst_shortfall));
  say(v.enclosure.foreign_leaves > 0, fmt::format("{} leaves not of the chain", v.enclosure.foreign_leaves));
  say(v.enclosure.misplaced > 0, fmt::format("{} nodes without one place and bound", v.enclosure.misplaced));
  say(!v.shape.is_tree(), fmt::format("not a tree: {} roots, {} spheres lost, {} nodes shared", v.shape.roots,
                                      v.shape.lost_leaves, v.shape.shared));
  return fmt::format("{}", fmt::join(parts, "; "));
}

void judge(Verification& v, bool rounded) {
  const bool same = v.comparison.right() && v.enclosure.violations == 0;
  const bool sound = v.comparison.well_formed() && v.enclosure.foreign_leaves == 0 &&
                     v.enclosure.misplaced == 0 && v.shape.is_tree();
  v.verdict = same && sound ? Verdict::exact : rounded && sound ? Verdict::differs : Verdict::wrong;
  v.reason = what_differs(v);
}

/// What `ask` finds out of a variant. A declared limit is a refusal, and want of memory says nothing of it;
/// whatever else is thrown is the variant's fault.
template <class Ask>
Verification answered(const Ask& ask) {
  Verification v;
  try {
    ask(v);
  } catch (const CapacityError& limit) {
    v.verdict = Verdict::refused;
    v.reason = limit.what();
  } catch (...) {
    if (thrown_for_want().empty()) {
      v.verdict = Verdict::wrong;
      v.reason = "threw: " + thrown_words();
    } else {
      v = {};  // half of it says nothing
      v.verdict = Verdict::undecided;
      v.reason = thrown_words();
    }
  }
  return v;
}

}  // namespace

std::string name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::exact:
      return "exact";
    case Verdict::differs:
      return "differs";
    case Verdict::wrong:
      return "WRONG";
    case Verdict::refused:
      return "refused";
    case Verdict::unavailable:
      return "unavailable";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

Undecided::Undecided(std::uint64_t answers)
    : Error(counted(answers, "answer") +
            " not decided: the machine had too little memory or threads; take fewer spheres") {}

Answer exact_answer(const Chain& chain, std::uint64_t pair_limit) {
  try {
    return find(chain, {Request::Want::pairs, pair_limit});
  } catch (const PairLimitExceeded&) {
    return find(chain, {Request::Want::counts, pair_limit});
  }
}

Verification verify(Variant& variant, bool rounded, const Chain& chain, const Answer& exact) {
  return answered([&](Verification& v) {
    variant.build(chain);
    ask_and_compare([&](const Request& request, Collisions& found) { variant.find(chain, request, found); },
                    chain, exact, v);
    EnclosureChecker checker(chain);
    variant.visit_bounds(checker);
    v.enclosure = checker.report();
    v.shape = checker.shape();
    judge(v, rounded);
  });
}

Verification verify_by_certificate(Variant& variant, const Chain& chain, std::uint64_t pair_limit,
                                   std::uint64_t& exact_pairs) {
  exact_pairs = 0;
  return answered([&](Verification& v) {
    Collisions found;
    Certified certified;
    v.by_pairs = find_pairs(
        [&](Request request, Collisions& to) {
          request.pair_limit = pair_limit;
          certified = certify(variant, chain, request, to);
        },
        found);
    if (!v.by_pairs) certified = certify(variant, chain, {Request::Want::counts}, found);
    v.certificate = certified.report;
    v.enclosure.bounds = certified.report.tree.bounds;
    v.enclosure.violations = certified.report.tree.unenclosed;
    if (!certified.report.holds()) {
      v.verdict = Verdict::wrong;
      v.reason = "not certified: " + certified.report.fault();
      return;
    }
    exact_pairs = certified.answer.pair_count;
    v.comparison = compare(chain, certified.answer, found);
    v.ran = true;
    judge(v, false);
    if (v.comparison.right() && !compare(chain, certified.answer, certified.shown).right()) {
      v.verdict = Verdict::wrong;
      v.reason = "the search with evidence gives another answer than its evidence proves";
    }
  });
}

}  // namespace catena::reference
