#include "catena/core/plan/omissions.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "catena/core/never_destroyed.h"
#include "catena/core/strategy/step_names.h"

namespace catena {
namespace {

const std::array<OmissionInfo, 17>& table() {
  static const auto& all = never_destroyed(std::array<OmissionInfo, 17>{{
      {Omission::hierarchy, "hierarchy", "hierarchy",
       "all pairs are compared instead, by the same exact test"},
      {Omission::device, "device", "device", "the host's exact variants give the device's pairs"},
      {Omission::threads, "threads", "further threads",
       "who searches a part of the chain changes no pair; a property compares any number of threads"},
      {Omission::pair_list, "pair-list", "pair list", "pairs are counted as they are found and not kept"},
      {Omission::after_hit, "after-hit", "search after the first pair",
       "one colliding pair is the answer yes, whatever the others are"},
      {Omission::other_places, "other-places", "build before a look at the likeliest places",
       "a look answers yes alone, by a pair that the exact test found; without one all is searched"},
      {Omission::straight, "straight", "search within straight stretches",
       "along one axis each child of a node ends before the next but one begins, by intervals rounded "
       "outward"},
      {Omission::exact, "exact", "exact stage where binary32 is certain",
       "outside of a band of rounding, whose width is proved, both have the same sign: "
       "properties/proofs/overlap_binary32.g; pair by pair, so that no margin of the scene is asked for"},
      {Omission::radii, "radii", "radius of each sphere in cells",
       "the least radius of the chain and the greatest are one number, as all were seen to be when they were "
       "checked"},
      {Omission::strands, "strand-table", strand_table_step,
       "of one open strand every sphere is of the same one, and no end of it is joined to the other"},
      {Omission::range_checks, "range-checks", range_checks_step,
       "no sum of two radii, of spheres or of bounds over them, has a square that binary32 has no room for: "
       "none falls back to binary64 for its range (Robust::in_range)"},
      {Omission::upload, "upload", upload_step,
       "a chain of the same topology has the same strands and neighbours, and a sphere that did not move the "
       "same bits"},
      {Omission::unmoved, "unmoved", "search of an unmoved frame",
       "no bit of a sphere differs, so that no pair does"},
      {Omission::still_parts, "still-parts", "search of the parts that did not move",
       "a pair of two spheres none of whose bits differ is as it was; every other is searched"},
      {Omission::shifted, "shifted", "search of the shifted part",
       "sphere i is bit for bit what i + s was, and the window of neighbours goes by |i - j| alone"},
      {Omission::far_pairs, "far-pairs", "search of pairs farther apart than their skins",
       "each sphere lies, by a bound rounded up, within the thicker sphere that the list was made of"},
      {Omission::sort, "sort", "sort in space",
       "whatever order its spheres are in, a node encloses them as they are now: only how many nodes meet "
       "depends on it"},
  }});
  return all;
}

}  // namespace

std::span<const OmissionInfo> all_omissions() { return table(); }

const OmissionInfo& info_of(Omission omission) { return table()[static_cast<std::size_t>(omission)]; }

std::vector<std::string> omission_names() {
  std::vector<std::string> names;
  for (const OmissionInfo& o : table()) names.push_back(o.name);
  return names;
}

Omissions Omissions::without(std::span<const std::string> names) {
  Omissions result;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(table(), name, &OmissionInfo::name);
    if (found == table().end()) throw std::logic_error("there is no omission " + name);
    result.off_.set(static_cast<std::size_t>(found->omission));
  }
  return result;
}

}  // namespace catena
