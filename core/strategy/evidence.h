#pragma once
#include <cstdint>

#include "catena/core/export.h"
#include "catena/core/policies/visitor.h"

namespace catena {

/// How often the evidence of one search accounts for a pair of different spheres.
enum class Accounting {
  none,           ///< there is no evidence
  each_pair,      ///< n(n-1)/2 unordered pairs, each once: the searches that meet a pair at one place
  from_both_ends  ///< n(n-1) ordered pairs, each once: every sphere i was searched for against all others
};

/// Receives why a search need not look further, as it goes. Every pair that is accounted for is below exactly
/// one discarded pair of nodes, or tested, or excluded; reference/certificate.h checks it. A node is named by
/// its id in Variant::visit_bounds (or EvidenceNodes): below n it is the sphere of that index, and all ids
/// are below 8n. Calls come from one thread.
class CATENA_API EvidenceSink {
 public:
  virtual ~EvidenceSink() = default;
  /// No sphere below `a` overlaps a sphere below `b`; accounts for all those pairs, ordered (below a, below
  /// b).
  virtual void discarded(std::uint32_t a, std::uint32_t b) = 0;
  /// Spheres i and j, not neighbours, were compared.
  virtual void tested(std::uint32_t i, std::uint32_t j) = 0;
  /// Spheres i and j were met and left out as neighbours.
  virtual void excluded(std::uint32_t i, std::uint32_t j) = 0;
  /// The bounds of nodes a and b, at least one of them an inner node, were compared. Accounts for nothing; it
  /// is told so that the work of a search can be counted.
  virtual void compared(std::uint32_t /*a*/, std::uint32_t /*b*/) {}
};

/// The longest chain of which evidence is given: ids have 32 bits.
constexpr std::uint32_t most_spheres_with_evidence = std::uint32_t{1} << 29;

/// In place of an EvidenceSink where nobody asks: nothing is computed for it.
struct NoEvidence {
  void discarded(std::uint32_t, std::uint32_t) const {}
  void tested(std::uint32_t, std::uint32_t) const {}
  void excluded(std::uint32_t, std::uint32_t) const {}
  void compared(std::uint32_t, std::uint32_t) const {}
};

/// What the search for sphere i reports to a sink; base of visitors that also gather its hits.
struct CATENA_API EvidenceVisitor : Visitor {
  EvidenceVisitor(std::uint32_t sphere, EvidenceSink& to) : i(sphere), sink(to) {}
  void tested_node(std::uint32_t slot) { sink.compared(i, slot); }
  void discarded(std::uint32_t slot) { sink.discarded(i, slot); }
  void tested_batch(std::uint32_t first, std::uint32_t count, std::uint32_t near) {
    for (std::uint32_t k = 0; k < count; ++k)
      if ((near >> k & 1u) == 0 && first + k != i) sink.discarded(i, first + k);
  }
  void tested_pair(std::uint32_t j) { sink.tested(i, j); }
  void excluded(std::uint32_t j) { sink.excluded(i, j); }
  const std::uint32_t i;
  EvidenceSink& sink;
};

}  // namespace catena
