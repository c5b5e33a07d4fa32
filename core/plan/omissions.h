#pragma once
#include <bitset>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "catena/core/export.h"

namespace catena {

/// Work that a plan may leave out because it cannot change the answer.
enum class Omission {
  hierarchy,
  device,
  threads,
  pair_list,
  after_hit,
  other_places,
  straight,
  exact,
  radii,
  strands,
  range_checks,
  upload,
  unmoved,
  still_parts,
  shifted,
  far_pairs,
  sort,
};

/// What a plan says of a piece of work that it may leave out.
struct CATENA_API OmissionInfo {
  Omission omission;
  std::string name;        ///< as `--no-omit` takes it
  std::string step;        ///< what is left out
  std::string obligation;  ///< why the answer is the same without it
};

/// All of them, in the order of a plan.
CATENA_API std::span<const OmissionInfo> all_omissions();
/// That of one. O(1).
CATENA_API const OmissionInfo& info_of(Omission omission);
/// The names of all, in the order of a plan.
CATENA_API std::vector<std::string> omission_names();

/// Those that a plan may use: all, but for the ones that were switched off.
class CATENA_API Omissions {
 public:
  Omissions() = default;
  /// All but those of these names. Throws std::logic_error for an unknown one.
  static Omissions without(std::span<const std::string> names);
  bool may(Omission omission) const { return !off_[static_cast<std::size_t>(omission)]; }

 private:
  std::bitset<32> off_;
};

}  // namespace catena
