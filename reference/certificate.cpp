#include "catena/reference/certificate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "catena/core/strategy/evidence_nodes.h"
#include "catena/reference/exact_gap.h"

namespace catena::reference {

std::string CertificateReport::fault() const {
  std::vector<std::string> parts;
  const auto say = [&](std::uint64_t number, const char* what) {
    if (number > 0) parts.push_back(fmt::format("{} {}", number, what));
  };
  say(tree.unenclosed, "bounds do not enclose");
  say(tree.foreign_leaves, "leaves are not the chain's spheres");
  say(tree.misplaced, "nodes have no place in a tree");
  say(unknown, "lines name no node or no two spheres");
  say(not_separate, "discarded pairs of nodes are not separate");
  say(not_neighbours, "excluded pairs are no neighbours");
  if (!each_once) parts.push_back("some pairs are accounted for never or more than once");
  return fmt::format("{}", fmt::join(parts, "; "));
}

CertificateChecker::CertificateChecker(const Chain& chain, const EvidenceTree& tree, Accounting accounting,
                                       const Request& request)
    : chain_(chain),
      view_(chain.view()),
      tree_(tree),
      both_ends_(accounting == Accounting::from_both_ends),
      seen_(both_ends_ ? Fingerprint::Pairs::ordered : Fingerprint::Pairs::unordered),
      tally_(chain.size(), request) {}

void CertificateChecker::discarded(std::uint32_t a, std::uint32_t b) {
  ++report_.discarded;
  if (!tree_.knows(a) || !tree_.knows(b)) {
    ++report_.unknown;
    return;
  }
  report_.not_separate += !tree_.separate(a, b);
  seen_.add(tree_.weight(a), tree_.weight(b));
}

void CertificateChecker::tested(std::uint32_t i, std::uint32_t j) {
  ++report_.tested;
  if (!two_spheres(i, j)) return;
  seen_.add(tree_.weight(i), tree_.weight(j));
  const bool counts = !both_ends_ || i < j;  // from both ends a pair comes as (i, j) and (j, i)
  if (counts && overlap(chain_[i], chain_[j]) && !view_.neighbours(i, j)) tally_.add(i, j);
}

void CertificateChecker::excluded(std::uint32_t i, std::uint32_t j) {
  ++report_.excluded;
  if (!two_spheres(i, j)) return;
  seen_.add(tree_.weight(i), tree_.weight(j));
  report_.not_neighbours += !view_.neighbours(i, j);
}

bool CertificateChecker::two_spheres(std::uint32_t i, std::uint32_t j) {
  const bool valid = i < chain_.size() && j < chain_.size() && i != j;
  report_.unknown += !valid;
  return valid;
}

CertificateReport CertificateChecker::report() const {
  CertificateReport result = report_;
  result.tree = tree_.faults();
  result.each_once = seen_.value() == tree_.all_pairs();
  return result;
}

bool has_evidence(Variant& variant, const Chain& chain) {
  if (variant.evidence() == Accounting::none) return false;
  try {
    variant.build(chain);
  } catch (...) {
    return true;  // certify() meets it again, and says so
  }
  return variant.evidence() != Accounting::none;
}

Certified certify(Variant& variant, const Chain& chain, const Request& request, Collisions& found) {
  variant.build(chain);
  EvidenceTree tree(chain);
  visit_evidence_nodes(variant, chain, tree);
  tree.complete();
  variant.find(chain, request, found);
  CertificateChecker checker(chain, tree, variant.evidence(), request);
  Certified result;
  variant.find_with_evidence(chain, request, result.shown, checker);
  result.report = checker.report();
  result.answer = std::move(checker).answer();
  return result;
}

}  // namespace catena::reference
