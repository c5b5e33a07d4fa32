#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "catena/core/parameters/parameters.h"
#include "catena/core/ranks/rank_search.h"
#include "catena/core/strategy/variant.h"

namespace catena::properties {

/// Searches a chain by three ranks that are threads, parted by space: the base of mutants, right but for what
/// each of them changes of what ranks tell one another. It is called by several threads at once.
class FaultyRanks : public Variant {
 public:
  using Base = FaultyRanks;

  /// How many ranks; none is read, but that the parameter is there says that searches are shared out.
  static std::vector<ParameterInfo> parameters() { return {{"ranks", "3", "how many"}}; }

  void build(const Chain& chain) override { built_ = chain.size(); }
  void find(const Chain& chain, const Request& request, Collisions& result) override;
  Timings timings() const override { return {}; }

  /// What a rank gives to all in a phase, for the so manyth time in it.
  virtual void spoil_gathered(ranks::Phase, unsigned /*time*/, ranks::Bytes&) const {}
  /// The blocks of another one that it asks for.
  virtual void spoil_question(std::vector<std::uint32_t>&) const {}
  /// What it gets in place.
  virtual void spoil_arrived(ranks::Phase, std::span<std::byte>) const {}

 private:
  std::optional<std::uint32_t> built_;
};

}  // namespace catena::properties
