#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/plan/machine_cost.h"

namespace catena {

/// What searches cost on this machine, as far as plans need it.
struct CATENA_API Machine {
  struct VariantCost {
    std::string variant;  ///< by the name that StrategyRegistry::make takes
    MachineCost cost;
    bool on_device = false, all_pairs = false;
    /// Why it cannot run here; empty: it can. A device is looked for only by who would take it, as the look
    /// takes longer than many a search.
    std::function<std::optional<std::string>()> unavailable = {};
    std::function<bool()> started = {};  ///< see StrategyInfo

    /// What the first search is yet to pay besides.
    double start_ms() const { return started && !started() ? cost.start_ms : 0; }
  };
  std::vector<VariantCost> costs;
  std::string source;                  ///< where the figures are from, for the user
  std::optional<std::string> warning;  ///< one line, when a file could not be used
  unsigned cores = 1;                  ///< threads that a search may have

  /// What the strategies say of themselves; of the host, those that are available here.
  static Machine built_in();
  /// The built-in figures, and in their place those of the file where it has them. A file that is not there
  /// is no fault; one that is damaged, or of another machine, is a warning, and nothing of it is used.
  static Machine from(const std::filesystem::path& file);
  /// From calibration_file(), read once in a program.
  static const Machine& here();
};

/// Where `catena calibrate` keeps its figures: catena/calibration.txt below XDG_CACHE_HOME, or below
/// ~/.cache. Empty where the environment names no home.
CATENA_API std::filesystem::path calibration_file();

/// What tells one kind of processor from another where a home is shared, of the text of /proc/cpuinfo; most
/// that are no x86 have no name there, but numbers.
CATENA_API std::string processor_of(std::istream& cpuinfo);

/// The figures as text, as Machine::from reads them.
CATENA_API std::string calibration_text(const Machine& machine);

}  // namespace catena
