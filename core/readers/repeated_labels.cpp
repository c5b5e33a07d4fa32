#include "catena/core/readers/repeated_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "catena/core/readers/file_bytes.h"

namespace catena {
namespace {

struct Repeated {
  std::uint64_t times = 0;  ///< spheres whose label an earlier one has
  std::pair<std::uint32_t, std::uint32_t> first{std::numeric_limits<std::uint32_t>::max(), 0};
};

/// Names of strands tell spheres apart only where no two strands share one.
bool strands_are_named(const CurveFile& curves) {
  std::vector<std::string_view> names(curves.labels.strand_names.begin(), curves.labels.strand_names.end());
  std::ranges::sort(names);
  return !names.empty() && std::ranges::adjacent_find(names) == names.end();
}

/// A strand of each sphere, or 0 for all where strands are not told apart.
class StrandOf {
 public:
  explicit StrandOf(const CurveFile& curves)
      : first_(curves.strand_first), named_(strands_are_named(curves)) {}
  std::uint64_t operator()(std::uint32_t sphere) const {
    if (!named_) return 0;
    return static_cast<std::uint64_t>(std::ranges::upper_bound(first_, sphere) - first_.begin());
  }

 private:
  const std::vector<std::uint32_t>& first_;
  bool named_;
};

/// Spheres by a hash of strand and label, and those of one hash by what they truly are.
Repeated repeated(const CurveFile& curves) {
  const Labels& labels = curves.labels;
  const StrandOf strand_of(curves);
  std::vector<std::uint64_t> keyed;  // upper half: hash, lower half: sphere
  keyed.reserve(labels.size());
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    const std::uint64_t hash = labels.hash_of(i) ^ strand_of(i) * 0x9E3779B97F4A7C15;
    keyed.push_back((hash & ~std::uint64_t{0xFFFFFFFF}) | i);
  }
  std::ranges::sort(keyed);
  Repeated found;
  for (std::size_t begin = 0, end = 0; begin < keyed.size(); begin = end) {
    while (end < keyed.size() && keyed[end] >> 32 == keyed[begin] >> 32) ++end;
    if (end - begin == 1) continue;
    std::vector<std::pair<std::pair<std::uint64_t, std::string>, std::uint32_t>> group;
    for (std::size_t k = begin; k < end; ++k) {
      const auto sphere = static_cast<std::uint32_t>(keyed[k]);
      group.push_back({{strand_of(sphere), labels.of(sphere)}, sphere});
    }
    std::ranges::sort(group);
    for (std::size_t k = 1; k < group.size(); ++k) {
      if (group[k].first != group[k - 1].first) continue;
      ++found.times;
      found.first = std::min(found.first, {group[k - 1].second, group[k].second});
    }
  }
  return found;
}

}  // namespace

std::optional<std::string> said_of_repeated_labels(const CurveFile& curves) {
  if (curves.labels.surely_differ()) return {};
  const Repeated found = repeated(curves);
  if (found.times == 0) return {};
  return fmt::format(
      "{} label{} an earlier sphere, the first {} of spheres {} and {}; by i and j they are told apart",
      found.times, found.times == 1 ? " is also that of" : "s are also those of",
      in_quotes(curves.labels.of(found.first.second)), found.first.first, found.first.second);
}

}  // namespace catena
