#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/export.h"
#include "catena/core/strategy/composed.h"
#include "catena/core/strategy/parameters.h"
#include "catena/core/strategy/space.h"
#include "catena/core/strategy/stages.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// What a strategy file says of itself.
struct CATENA_API StrategyInfo {
  std::string
      name;  ///< as in the paper: "aCPU2"; with "@host" when a device algorithm is run by the host executor
  std::string summary;  ///< one line for `catena list`
  Space space = Space::host;
  /// The parameters it understands, with defaults and meaning: `aGPU2@host(subtree=256)`.
  std::vector<ParameterInfo> parameters = {};
  /// Compares all pairs, O(n^2); benchmarks leave it out on long chains.
  bool all_pairs = false;
  /// Why it cannot run on this machine; nullopt when it can. Empty function: it always can.
  std::function<std::optional<std::string>()> unavailable = {};
};

/// One complete variant as `catena list` shows it.
struct CATENA_API VariantInfo {
  std::string name;        ///< "aCPU2+CPU2/literal"; robust is the default and not written
  std::string arithmetic;  ///< "robust", "literal", "double", or the strategy's own
  std::string summary;
  bool on_device = false;  ///< at least one stage runs on a device
  bool all_pairs = false;  ///< O(n^2)
  bool hidden = false;     ///< a mutant: made by name, never listed among the variants
  std::optional<std::string> unavailable;
};

/// All strategies of the program. Strategy files register themselves before main; afterwards it is read only.
class CATENA_API StrategyRegistry {
 public:
  static StrategyRegistry& instance();

  template <class Bound>
  using MakeConstruction = std::function<std::unique_ptr<Construction<Bound>>(const Parameters&)>;
  template <class Bound>
  using MakeTraversal = std::function<std::unique_ptr<Traversal<Bound>>(const Parameters&)>;
  using MakeVariant = std::function<std::unique_ptr<Variant>(const Parameters&)>;

  template <class Arithmetic>
  void add_construction(const StrategyInfo& info, MakeConstruction<typename Arithmetic::Bound> make);
  template <class Arithmetic>
  void add_traversal(const StrategyInfo& info, MakeTraversal<typename Arithmetic::Bound> make);
  void add_variant(const StrategyInfo& info, std::string arithmetic, MakeVariant make, bool hidden = false);

  /// Moves data to the device and back; set once by the folder that owns the device.
  void set_mover(std::function<std::unique_ptr<Mover>()> make) { make_mover_ = std::move(make); }
  /// Null when no device is built in.
  std::unique_ptr<Mover> make_mover() const { return make_mover_ ? make_mover_() : nullptr; }

  /// Every variant: those complete in themselves, and every construction with every traversal, in each
  /// arithmetic that both have. Sorted by name. Mutants only when asked for.
  std::vector<VariantInfo> variants(bool with_hidden = false) const;

  /// Names of single strategies as registered ("CPU1", "aCPU2", "CPU2", ...), each once, sorted.
  std::vector<std::string> strategy_names() const;
  /// Null when there is none of that name; mutants are found too.
  const StrategyInfo* find_strategy(const std::string& name) const;
  const StrategyInfo& strategy(
      const std::string& name) const;  ///< throws InputError that names those there are

  /// Makes a variant from its name: strategy or construction+traversal, each with optional (key=value,...)
  /// parameters, then an optional /arithmetic. Throws InputError that names what is unknown and what there
  /// is, and CapacityError when the variant is not available here.
  std::unique_ptr<Variant> make(std::string_view name) const;

 private:
  struct Entry {
    StrategyInfo info;
    std::string arithmetic;
    bool hidden = false;
    MakeVariant make;  // complete variants only
  };
  template <class Stage>
  struct StageEntry {
    StrategyInfo info;
    std::string arithmetic;
    std::function<std::unique_ptr<Stage>(const Parameters&)> make;
  };
  template <class Bound>
  struct Stages {
    std::vector<StageEntry<Construction<Bound>>> constructions;
    std::vector<StageEntry<Traversal<Bound>>> traversals;
  };
  template <class Bound>
  Stages<Bound>& stages() {
    if constexpr (std::is_same_v<Bound, Sphere>)
      return narrow_;
    else
      return wide_;
  }
  template <class Bound>
  const Stages<Bound>& stages() const {
    return const_cast<StrategyRegistry*>(this)->stages<Bound>();
  }
  template <class Arithmetic>
  void list_composed(std::vector<VariantInfo>& out) const;
  template <class Arithmetic>
  std::unique_ptr<Variant> make_composed(const StrategySpec& build, const StrategySpec& find) const;
  std::unique_ptr<Variant> make_complete(const StrategySpec& spec, const std::string& arithmetic) const;

  std::vector<Entry> complete_;
  Stages<Sphere> narrow_;
  Stages<Sphere64> wide_;
  std::function<std::unique_ptr<Mover>()> make_mover_;
};

template <class Arithmetic>
void StrategyRegistry::add_construction(const StrategyInfo& info,
                                        MakeConstruction<typename Arithmetic::Bound> make) {
  stages<typename Arithmetic::Bound>().constructions.push_back({info, Arithmetic::name, std::move(make)});
}

template <class Arithmetic>
void StrategyRegistry::add_traversal(const StrategyInfo& info,
                                     MakeTraversal<typename Arithmetic::Bound> make) {
  stages<typename Arithmetic::Bound>().traversals.push_back({info, Arithmetic::name, std::move(make)});
}

}  // namespace catena
