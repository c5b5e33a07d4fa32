#include "catena/core/parts/partition.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "catena/core/parts/group_boxes.h"
#include "catena/core/parts/halos.h"
#include "catena/core/parts/regions.h"

namespace catena::parts {
namespace {

/// A halo is moved and searched with its part: dearer than to share the groups out by space.
constexpr double most_in_halos = 0.125;

Box empty_box() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

/// Groups that are worked on together; what each range of so many finds is joined in their order.
constexpr std::uint32_t range = 1u << 14;

}  // namespace

Partition::Partition(const Chain& chain, std::uint32_t parts, const Options& options, const Team& team) {
  parts = std::max(1u, parts);
  if (options.order != Order::space) {
    const double share = part_in_chain_order(chain, parts, options, team);
    if (share <= most_in_halos || options.order == Order::chain) return;
    Partition by_space(chain, parts, {.group = options.group, .order = Order::space}, team);
    if (by_space.halo_share() < share) {
      *this = std::move(by_space);
      return;
    }
    part_in_chain_order(chain, parts, {.group = options.group, .order = Order::chain}, team);
  } else {
    part_by_space(chain, parts, options, team);
  }
}

/// Returns about how much of the chain is in halos; where that is too much to be worth it, and it need not be
/// so, nothing is parted.
double Partition::part_in_chain_order(const Chain& chain, std::uint32_t parts, const Options& options,
                                      const Team& team) {
  group_ = options.group;
  const LargeVector<Box> boxes = group_boxes(chain.spheres(), group_, team);
  const auto groups = static_cast<std::uint32_t>(boxes.size());
  parts = std::min(parts, std::max(1u, groups));
  std::vector<std::uint32_t> first;
  for (std::uint64_t p = 0; p <= parts; ++p) first.push_back(static_cast<std::uint32_t>(groups * p / parts));
  std::vector<std::vector<std::uint32_t>> halos(parts);
  if (parts > 1) {
    const Halos near(boxes, first, team);
    const double share = near.halo_share();
    if (share > most_in_halos && options.order == Order::measured) return share;
    halos = near.find();
  }
  parts_.assign(parts, {});
  for (std::uint32_t p = 0; p < parts; ++p) {
    parts_[p].own.resize(first[p + 1] - first[p]);
    std::iota(parts_[p].own.begin(), parts_[p].own.end(), first[p]);
    const auto after = std::ranges::lower_bound(halos[p], first[p]);
    parts_[p].before.assign(halos[p].begin(), after);
    parts_[p].after.assign(after, halos[p].end());
  }
  return 0;
}

/// A group is of the region where a sphere in its middle lies. All groups of a part are in one box, and every
/// other group that meets it is of its halo.
void Partition::part_by_space(const Chain& chain, std::uint32_t parts, const Options& options,
                              const Team& team) {
  in_space_ = true;
  group_ = std::max(1u, options.group / 8);
  const std::span<const Sphere> spheres = chain.spheres();
  const auto groups = static_cast<std::uint32_t>((spheres.size() + group_ - 1) / group_);
  const std::uint32_t ranges = (groups + range - 1) / range;
  const Regions regions(spheres, parts);
  LargeVector<std::uint32_t> part_of(groups);
  LargeVector<Box> boxes = group_boxes(spheres, group_, team);
  std::vector<std::vector<Box>> of_range(ranges, std::vector<Box>(parts, empty_box()));
  const auto in_ranges = [&](const auto& body) {
    team.for_each_range(ranges, 1, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t r = begin; r < end; ++r)
        for (std::uint32_t g = r * range; g < std::min((r + 1) * range, groups); ++g) body(r, g);
    });
  };
  in_ranges([&](std::uint32_t r, std::uint32_t g) {
    const std::size_t first = std::size_t{g} * group_,
                      size = std::min<std::size_t>(group_, spheres.size() - first);
    part_of[g] = regions.of(spheres[first + size / 2]);
    of_range[r][part_of[g]].join(boxes[g]);
  });
  std::vector<Box> around(parts, empty_box());
  for (const auto& of : of_range)
    for (std::uint32_t p = 0; p < parts; ++p) around[p].join(of[p]);

  std::vector<std::vector<Part>> found(ranges, std::vector<Part>(parts));
  in_ranges([&](std::uint32_t r, std::uint32_t g) {
    found[r][part_of[g]].own.push_back(g);
    for (std::uint32_t p = 0; p < parts; ++p)
      if (p != part_of[g] && around[p].meets(boxes[g]))
        (part_of[g] < p ? found[r][p].before : found[r][p].after).push_back(g);
  });
  parts_.assign(parts, {});
  team.for_each_range(parts, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t p = begin; p < end; ++p)
      for (auto list : {&Part::own, &Part::before, &Part::after})
        for (const auto& of : found)
          (parts_[p].*list).insert((parts_[p].*list).end(), (of[p].*list).begin(), (of[p].*list).end());
  });
}

std::uint64_t Partition::greatest() const {
  std::size_t most = 0;
  for (const Part& part : parts_)
    most = std::max(most, part.own.size() + part.before.size() + part.after.size());
  return std::uint64_t{most} * group_;
}

double Partition::halo_share() const {
  std::size_t own = 0, in_halos = 0;
  for (const Part& part : parts_) own += part.own.size(), in_halos += part.before.size() + part.after.size();
  return own == 0 ? 0 : static_cast<double>(in_halos) / static_cast<double>(own);
}

Partition::Options partition_options(const Parameters& parameters) {
  const std::string order = parameters.choice("order", {"measured", "chain", "space"});
  return {.group = static_cast<std::uint32_t>(parameters.unsigned_integer("group", 1, 1u << 20)),
          .order = order == "chain"   ? Order::chain
                   : order == "space" ? Order::space
                                      : Order::measured};
}

}  // namespace catena::parts
