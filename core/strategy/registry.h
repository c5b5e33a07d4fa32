#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/strategy/device.h"
#include "catena/core/strategy/stages.h"
#include "catena/core/strategy/variant.h"
#include "catena/core/strategy/variant_info.h"

namespace catena {

/// All strategies of the program. Strategy files register themselves before main; afterwards it is read only.
class CATENA_API StrategyRegistry {
 public:
  using MakeStage = std::function<std::unique_ptr<Stage>(const Parameters&)>;
  using MakeVariant = std::function<std::unique_ptr<Variant>(const Parameters&)>;
  /// Joins two stages of one tree type.
  using Compose = std::unique_ptr<Variant> (*)(std::unique_ptr<Stage>, Place, std::unique_ptr<Stage>, Place,
                                               std::unique_ptr<Device>);
  /// The type of tree that a stage makes or takes, and what may be done with it.
  struct TreeType {
    std::type_index type;
    bool movable;  ///< between host and device
    Compose compose;
  };

  static StrategyRegistry& instance();

  /// Each throws std::logic_error where there is one of its kind of this name and arithmetic.
  void add_construction(const StrategyInfo& info, const ArithmeticInfo& arithmetic, const TreeType& tree,
                        MakeStage make);
  void add_traversal(const StrategyInfo& info, const ArithmeticInfo& arithmetic, const TreeType& tree,
                     MakeStage make);
  void add_variant(const StrategyInfo& info, const ArithmeticInfo& arithmetic, MakeVariant make,
                   bool hidden = false);

  /// Makes the devices; set once by the folder that owns them.
  void set_device(std::function<std::unique_ptr<Device>(Place)> make) { make_device_ = std::move(make); }
  /// Null when no device is built in. Throws CapacityError when there is no such device.
  std::unique_ptr<Device> make_device(Place place = Place::device()) const {
    return make_device_ ? make_device_(place) : nullptr;
  }

  /// Every variant: those complete in themselves, and every construction with every traversal of the same
  /// arithmetic and tree. Sorted by name. Mutants only when asked for.
  std::vector<VariantInfo> variants(bool with_hidden = false) const;

  /// Names of single strategies as registered ("CPU1", "aCPU2", "CPU2", ...), each once, sorted.
  std::vector<std::string> strategy_names() const;
  /// Of complete variants that are exact, those that are rivals of a plan's choice for such a chain; the
  /// safest first.
  std::vector<std::string> rivals(std::uint32_t n, const Extent& extent) const;
  /// Null when there is none of that name; mutants are found too.
  const StrategyInfo* find_strategy(std::string_view name) const;
  /// Throws InputError that names those there are.
  const StrategyInfo& strategy(std::string_view name) const;

  /// What is known of one variant by its name: strategy or construction+traversal, each with optional
  /// (key=value,...) parameters, then an optional /arithmetic; without one it is robust, or the only one that
  /// the strategy has. Throws InputError that names what is unknown and what there is; also for a parameter.
  VariantInfo describe(std::string_view name) const;
  /// Makes it. Throws like describe, and CapacityError when the variant is not available here.
  std::unique_ptr<Variant> make(std::string_view name) const;
  /// The same for a variant that make gave out and that holds others: each call comes to these in the default
  /// floating-point environment already, and they need not look, which takes a few spheres' search.
  std::unique_ptr<Variant> make_held(std::string_view name) const;

  /// The name with each device stage that has a twin on the host ("@host") replaced by it.
  VariantName on_host(VariantName name) const;

 private:
  struct VariantEntry {
    StrategyInfo info;
    ArithmeticInfo arithmetic;
    bool hidden;
    MakeVariant make;
    Parameters defaults;  ///< as none is written
  };
  struct StageEntry {
    StrategyInfo info;
    ArithmeticInfo arithmetic;
    TreeType tree;
    MakeStage make;
  };
  /// What a name stands for: one of the first, or one of each of the others.
  struct Resolved {
    const VariantEntry* whole = nullptr;
    const StageEntry* construction = nullptr;
    const StageEntry* traversal = nullptr;
  };

  Resolved resolve(const VariantName& name) const;
  const VariantEntry* resolve_whole(std::string_view wanted, std::string_view arithmetic) const;
  Resolved resolve_composed(const VariantName& name) const;
  VariantInfo info_of(const VariantEntry& entry) const;
  static VariantInfo info_of(const StageEntry& construction, const StageEntry& traversal);
  static bool combine(const StageEntry& construction, const StageEntry& traversal);

  std::vector<VariantEntry> complete_;
  std::vector<StageEntry> constructions_, traversals_;
  std::function<std::unique_ptr<Device>(Place)> make_device_;
};

}  // namespace catena
