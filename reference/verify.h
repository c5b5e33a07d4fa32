#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/error.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/variant.h"
#include "catena/reference/answer.h"
#include "catena/reference/certificate.h"
#include "catena/reference/compare.h"
#include "catena/reference/enclosure.h"

namespace catena::reference {

/// What came of holding one variant, or a peer, against the exact reference.
enum class Verdict {
  exact,        ///< the right pairs and counts, every bound encloses
  differs,      ///< it differs as its rounded arithmetic may
  wrong,        ///< it differs and must not, or in a way that rounding does not excuse
  refused,      ///< the input is past a declared limit of the variant
  unavailable,  ///< it cannot run on this machine
  undecided     ///< the machine had too little memory, or threads, to see what it answers
};
std::string name_of(Verdict verdict);

/// So many answers were not decided, and no other is wrong.
class Undecided : public Error {
 public:
  explicit Undecided(std::uint64_t answers);
};

struct Verification {
  Verdict verdict = Verdict::exact;
  std::string reason;  ///< why it is not exact; empty when it is
  bool ran = false;    ///< false: what follows says nothing
  bool by_pairs =
      true;  ///< false: a flood of pairs, so counts were compared and `missing`, `invented` say nothing
  Comparison comparison;
  EnclosureReport enclosure;
  TreeShape shape;
  std::optional<CertificateReport> certificate;  ///< when the answer was proved by the variant's own evidence
};

/// The exact answer that variants are compared with: pairs, or counts only when there are more pairs than the
/// limit.
Answer exact_answer(const Chain& chain, std::uint64_t pair_limit);

/// Builds and searches with the variant and compares with `exact`, which says whether pairs are wanted. A
/// variant that is not exact by its VariantInfo (`rounded`) may miss and invent pairs, and have bounds that
/// do not enclose; a repeated or malformed pair, a neighbour or a tree that is no tree is wrong for all.
/// CapacityError becomes `refused`, want of memory or threads `undecided`, and whatever else the variant
/// throws `wrong`, with "threw: " and what it said.
Verification verify(Variant& variant, bool rounded, const Chain& chain, const Answer& exact);

/// The same with the variant's own evidence in place of the reference, for those of has_evidence(): it is
/// checked line by line and proves which pairs there are, at about the cost of the search; what find()
/// answers, and what the search with evidence does, are held against that. Counts only when there are more
/// pairs than the limit. `exact_pairs` becomes the proved number; 0 when nothing was proved.
Verification verify_by_certificate(Variant& variant, const Chain& chain, std::uint64_t pair_limit,
                                   std::uint64_t& exact_pairs);

}  // namespace catena::reference
