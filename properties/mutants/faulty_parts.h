#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "catena/core/parameters/parameters.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/parts/partition.h"
#include "catena/core/strategy/variant.h"

namespace catena::properties {

/// Searches a chain in parts by Hybrid, one after the other: the base of mutants, right but for what each of
/// them changes.
class FaultyParts : public Variant {
 public:
  using Base = FaultyParts;

  /// How many parts; none is read, but that the parameter is there says that searches are shared out.
  static std::vector<ParameterInfo> parameters() { return {{"parts", "3", "how many"}}; }

  void build(const Chain& chain) override { built_ = chain.size(); }
  void find(const Chain& chain, const Request& request, Collisions& result) override;
  Timings timings() const override { return {}; }

 protected:
  virtual parts::Order order() const { return parts::Order::chain; }
  virtual void spoil(parts::PartRanges&) {}
  virtual SphereRange asked(const parts::LocalChain& part) { return part.own(); }
  virtual Chain spoiled(Chain part) { return part; }

 private:
  void search(const Chain& chain, const parts::LocalChain& part, Collisions& result);

  std::optional<std::uint32_t> built_;
};

}  // namespace catena::properties
