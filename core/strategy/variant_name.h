#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/parameters/settings.h"

namespace catena {

/// One stage of a variant's name, "aGPU2@host(subtree=6,block=2)".
struct CATENA_API StageName {
  std::string strategy;  ///< as registered: "aGPU2@host"
  std::vector<Setting> settings = {};

  /// The algorithm, without where it runs: "aGPU2".
  std::string algorithm() const { return strategy.substr(0, strategy.rfind(on_host)); }
  /// A device algorithm that the host executor runs.
  bool is_host_twin() const { return strategy.ends_with(on_host); }
  /// The settings as written between the parentheses; empty when there are none.
  std::string settings_text() const;
  std::string text() const;

  static constexpr std::string_view on_host = "@host";
  friend bool operator==(const StageName&, const StageName&) = default;
};

/// The name of a variant taken apart: what `make` takes, and what everything else prints, compares and
/// changes. Nothing here says whether there is such a variant; StrategyRegistry::describe does.
struct CATENA_API VariantName {
  std::vector<StageName> stages;  ///< one, complete in itself, or construction and traversal
  std::string arithmetic = {};    ///< as written; empty: not written, the strategy's usual one

  /// "construction+traversal/arithmetic", each stage with (key=value,...) as needed. Throws InputError on
  /// unbalanced parentheses and settings that are not key=value.
  static VariantName parse(std::string_view text);
  std::string text() const;

  bool composed() const { return stages.size() == 2; }
  /// The same with other settings: none.
  VariantName plain() const;
  friend bool operator==(const VariantName&, const VariantName&) = default;
};

}  // namespace catena
