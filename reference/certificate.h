#pragma once
#include <cstdint>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/evidence.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/variant.h"
#include "catena/reference/answer.h"
#include "catena/reference/evidence_tree.h"
#include "catena/reference/fingerprint.h"
#include "catena/reference/tally.h"

namespace catena::reference {

/// What the check of one search's evidence found. All faults zero and `each_once`: the answer is proved.
struct CertificateReport {
  std::uint64_t discarded = 0;       ///< pairs of nodes left out
  std::uint64_t tested = 0;          ///< pairs of spheres compared
  std::uint64_t excluded = 0;        ///< pairs of spheres left out as neighbours
  std::uint64_t unknown = 0;         ///< lines that name no node, or no two spheres
  std::uint64_t not_separate = 0;    ///< discarded pairs of nodes whose bounds touch
  std::uint64_t not_neighbours = 0;  ///< excluded pairs that are none
  bool each_once = false;            ///< every pair of spheres is accounted for, as often as declared
  BoundTreeFaults tree;

  bool holds() const {
    return unknown == 0 && not_separate == 0 && not_neighbours == 0 && each_once && tree.sound();
  }
  std::string fault() const;  ///< what is wrong in one line; empty when it holds
};

/// Checks evidence line by line as it comes, and decides every tested pair itself: O(1) a line, O(n + pairs)
/// memory. It proves this. Each node encloses the spheres below it (EvidenceTree, exact), each discarded pair
/// of nodes is separate (exact), so no pair below it collides; each excluded pair is one of neighbours; and
/// all lines together account for every pair exactly once (Fingerprint, wrong once in 10^18 checks). So the
/// tested pairs that overlap, by exact_gap.h, and are no neighbours are all the pairs there are: `answer`. Of
/// core/ it uses the chain, its rule of neighbours and the interface by which evidence comes.
class CertificateChecker final : public EvidenceSink {
 public:
  /// `tree` must be complete and outlive the checker. Want::any is answered like Want::counts.
  CertificateChecker(const Chain& chain, const EvidenceTree& tree, Accounting accounting,
                     const Request& request);

  void discarded(std::uint32_t a, std::uint32_t b) override;
  void tested(std::uint32_t i, std::uint32_t j) override;
  void excluded(std::uint32_t i, std::uint32_t j) override;

  CertificateReport report() const;
  /// The right answer, if the report holds. Call once, at the end. Throws PairLimitExceeded like
  /// reference::find.
  Answer answer() && { return std::move(tally_).finish(); }

 private:
  bool two_spheres(std::uint32_t i, std::uint32_t j);

  const Chain& chain_;
  const ChainView view_;
  const EvidenceTree& tree_;
  const bool both_ends_;
  CertificateReport report_;
  Fingerprint seen_;
  Tally tally_;
};

/// A checked search.
struct Certified {
  CertificateReport report;
  Answer answer;     ///< what the evidence proves; means nothing unless the report holds
  Collisions shown;  ///< what the search with evidence answered itself
};

/// Whether certify() can check the variant's answer on this chain. `auto` knows when it has chosen, so where a
/// variant says that it has evidence it is asked again after a build.
bool has_evidence(Variant& variant, const Chain& chain);

/// Builds, leaves the answer of find() in `found`, searches again with evidence, and checks that evidence. That all
/// three answers are one is for the caller to compare: the evidence alone says nothing of find(), which may run on
/// many threads. It must have evidence. Cost: both searches and O(1) for each line of evidence. Throws what build and
/// find throw, and PairLimitExceeded.
Certified certify(Variant& variant, const Chain& chain, const Request& request, Collisions& found);

}  // namespace catena::reference
