#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/cost.h"
#include "catena/core/strategy/place.h"
#include "catena/core/strategy/variant_name.h"

namespace catena {

/// What a strategy promises beyond what all do; the properties hold it to that.
struct CATENA_API Promises {
  bool same_bits = false;   ///< update leaves bounds bit for bit those of build
  bool same_order = false;  ///< pairs come in the same order, whatever the number of threads
};

/// What a strategy file says of itself.
struct CATENA_API StrategyInfo {
  /// As in the paper: "aCPU2"; with "@host" when a device algorithm is run by the host executor.
  std::string name;
  std::string summary;  ///< one line for `catena list`
  Place place = Place::host();
  /// The parameters it understands, with defaults and meaning: `aGPU2@host(subtree=256)`.
  std::vector<ParameterInfo> parameters = {};
  bool all_pairs = false;  ///< compares all pairs, O(n^2); benchmarks leave it out on long chains
  /// A variant complete in itself that shows a hierarchy; every combination of stages does.
  bool has_tree = false;
  bool peer = false;  ///< somebody else's library, asked for comparison
  Promises promises = {};
  /// On a usual machine; without one no plan chooses it. `catena calibrate` measures those that have one.
  std::optional<Cost> cost = {};
  /// That `auto` may try it beside what a plan chose, and what it may take for such a chain, at worst, in
  /// times of the quickest: who takes less is tried sooner, and 0 never. Empty function: never.
  std::function<double(std::uint32_t n, const Extent& extent)> rival = {};
  /// Why it cannot run on this machine; nullopt when it can. Empty function: it always can.
  std::function<std::optional<std::string>()> unavailable = {};
  /// Whether this process has paid what starting takes (Cost::start_ms), for this strategy or another. Empty
  /// function: there is nothing to start.
  std::function<bool()> started = {};
  bool resident = false;  ///< a variant complete in itself that is a ResidentSearch: registering it says so
};

/// How a variant computes.
struct CATENA_API ArithmeticInfo {
  std::string name;  ///< "robust", "literal", "double", or the strategy's own
  /// Its pair set is that of exact real arithmetic; otherwise it may miss and invent pairs.
  bool exact = true;
};

/// One complete variant: everything that others need to know of it without running it.
struct CATENA_API VariantInfo {
  std::string name;           ///< what StrategyRegistry::make takes: parts.text()
  VariantName parts;          ///< its stages with their settings
  std::vector<Place> places;  ///< of each stage
  std::string arithmetic;     ///< also where the name does not say it
  std::string summary;
  bool exact = true;       ///< the answer must be exactly right; nothing excuses it
  bool all_pairs = false;  ///< O(n^2)
  bool has_tree = false;   ///< shows a hierarchy
  bool peer = false;       ///< somebody else's library
  bool resident = false;   ///< Variant::resident() is not null: it takes a chain that lies on its device
  bool hidden = false;     ///< a mutant: made by name, never listed among the variants
  Promises promises = {};
  std::optional<Cost> cost = {};
  std::optional<std::string> unavailable = {};

  /// At least one stage runs on a device.
  bool on_device() const {
    for (const Place& place : places)
      if (place.on_device()) return true;
    return false;
  }
};

}  // namespace catena
