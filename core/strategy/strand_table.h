#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// Which strand a sphere is of, as a search is to look it up: in no table where the chain is one open strand,
/// unless it is told to all the same.
class CATENA_API StrandTable {
 public:
  StrandTable() = default;  ///< in no table
  explicit StrandTable(const Parameters& parameters);

  /// The chain as the search is to see it, with the same neighbours; valid as long as the chain and until the
  /// next call.
  ChainView seen(const ChainView& chain) {
    strands_ = chain.strand_count, one_open_ = chain.exclusion.one_open_strand;
    return kept_ && one_open_ ? with_table(chain) : chain;
  }

  /// Of the last chain that was seen.
  Decision told() const;

 private:
  ChainView with_table(const ChainView& chain);

  bool kept_ = false;
  std::uint32_t strands_ = 0;
  bool one_open_ = false;
  std::vector<std::uint32_t> strand_of_, first_;
  std::vector<double> loop_length_;
};

/// "strands": known or read.
CATENA_API ParameterInfo strands_parameter();

}  // namespace catena
