#include "catena/core/parts/partition.h"

#include <algorithm>
#include <optional>

#include "catena/core/hierarchy/box_around.h"
#include "catena/core/parts/group_boxes.h"
#include "catena/core/parts/halos.h"
#include "catena/core/parts/regions.h"

namespace catena::parts {
namespace {

/// A halo is moved and searched with its part: dearer than to share the groups out by space.
constexpr double most_in_halos = 0.125;

/// A chain as groups of consecutive spheres.
struct Groups {
  std::span<const Sphere> spheres;
  std::uint32_t size;

  std::uint32_t count() const { return static_cast<std::uint32_t>((spheres.size() + size - 1) / size); }
  SphereRange range(std::uint32_t g) const {
    const std::uint64_t first = std::uint64_t{g} * size;
    return {static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(std::min<std::uint64_t>(first + size, spheres.size()))};
  }
  std::span<const Sphere> of(SphereRange range) const { return spheres.subspan(range.begin, range.size()); }
};

std::vector<std::uint32_t> even_offsets(std::uint32_t groups, std::uint32_t parts) {
  parts = std::clamp(parts, 1u, std::max(1u, groups));
  std::vector<std::uint32_t> first;
  for (std::uint64_t p = 0; p <= parts; ++p) first.push_back(static_cast<std::uint32_t>(groups * p / parts));
  return first;
}

Partition cut_at(std::span<const std::uint32_t> first, std::uint32_t spheres, std::uint32_t group) {
  Partition partition;
  for (std::size_t p = 0; p + 1 < first.size(); ++p) {
    const auto sphere = [&](std::size_t k) {
      return static_cast<std::uint32_t>(std::min<std::uint64_t>(std::uint64_t{first[k]} * group, spheres));
    };
    partition.parts.emplace_back().own.push_back({sphere(p), sphere(p + 1)});
  }
  return partition;
}

/// Nothing where it need not be chain order and halos seem too large; `share` is how large.
std::optional<Partition> in_chain_order(const Chain& chain, std::uint32_t parts,
                                        const PartitionOptions& options, const Team& team, double& share) {
  const Groups groups{chain.spheres(), options.group};
  const std::vector<std::uint32_t> first = even_offsets(groups.count(), parts);
  Partition partition = cut_at(first, chain.size(), options.group);
  if (partition.parts.size() == 1) return partition;
  const LargeVector<Box> boxes = group_boxes(groups.spheres, groups.size, team);
  const Halos near(boxes, first, team);
  if (options.order == Order::measured && (share = near.halo_share()) > most_in_halos) return {};
  const auto halos = near.find();
  for (std::size_t p = 0; p < halos.size(); ++p)
    for (const std::uint32_t g : halos[p])
      append(g < first[p] ? partition.parts[p].before : partition.parts[p].after, groups.range(g));
  return partition;
}

/// A group is of the region where a sphere in its middle lies. All of a part is in one box, and every other
/// group that meets it is of its halo. What is known of a group is worked out anew in each pass, as memory
/// takes longer.
class BySpace {
 public:
  BySpace(const Chain& chain, std::uint32_t parts, std::uint32_t group, const Team& team)
      : groups_{chain.spheres(), std::max(1u, group / 8)},
        parts_(parts),
        team_(team),
        regions_(chain.spheres(), parts) {}

  Partition part() {
    regions_.enclose(boxes_of_parts());
    std::vector<std::vector<PartRanges>> found(stretches(), std::vector<PartRanges>(parts_));
    for_each_run(
        [&](std::uint32_t stretch, SphereRange run, const Box& box, std::optional<std::uint32_t> own) {
          std::uint32_t others = 0;
          if (own) regions_.for_each_meeting(box, [&](std::uint32_t p) { others += p != *own; });
          if (own && others == 0) return append(found[stretch][*own].own, run);
          for_each_group(run, [&](SphereRange range) { take(range, found[stretch]); });
        });
    Partition partition{std::vector<PartRanges>(parts_), true};
    team_.for_each_range(parts_, 1, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t p = begin; p < end; ++p)
        for (const auto list : {&PartRanges::own, &PartRanges::before, &PartRanges::after})
          for (const auto& of_stretch : found)
            for (const SphereRange& range : of_stretch[p].*list) append(partition.parts[p].*list, range);
    });
    return partition;
  }

 private:
  /// Groups that are looked at as one first, and such runs that are worked on together; what each stretch of
  /// these finds is joined in their order.
  static constexpr std::uint32_t run_length = 8, stretch_length = 1u << 11;

  std::uint32_t runs() const { return (groups_.count() + run_length - 1) / run_length; }
  std::uint32_t stretches() const { return (runs() + stretch_length - 1) / stretch_length; }
  const Sphere& middle(SphereRange range) const { return groups_.spheres[range.begin + range.size() / 2]; }

  /// body(stretch, run, its box, the region if all of it is in one).
  template <class Body>
  void for_each_run(const Body& body) const {
    const Groups of_runs{groups_.spheres, groups_.size * run_length};
    team_.for_each_range(stretches(), 1, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t s = begin; s < end; ++s)
        for (std::uint32_t r = s * stretch_length; r < std::min((s + 1) * stretch_length, runs()); ++r) {
          const SphereRange run = of_runs.range(r);
          const Box box = box_around(groups_.of(run));
          body(s, run, box, regions_.around(box));
        }
    });
  }
  template <class Body>
  void for_each_group(SphereRange run, const Body& body) const {
    for (std::uint64_t first = run.begin; first < run.end; first += groups_.size)
      body(SphereRange{static_cast<std::uint32_t>(first),
                       static_cast<std::uint32_t>(std::min<std::uint64_t>(first + groups_.size, run.end))});
  }
  void take(SphereRange range, std::vector<PartRanges>& to) const {
    const std::uint32_t own = regions_.of(middle(range));
    append(to[own].own, range);
    regions_.for_each_meeting(box_around(groups_.of(range)), [&](std::uint32_t p) {
      if (p != own) append(own < p ? to[p].before : to[p].after, range);
    });
  }
  std::vector<Box> boxes_of_parts() const {
    std::vector<std::vector<Box>> boxes(stretches(), std::vector<Box>(parts_, Box::nothing()));
    for_each_run(
        [&](std::uint32_t stretch, SphereRange run, const Box& box, std::optional<std::uint32_t> own) {
          if (own) return boxes[stretch][*own].join(box);
          for_each_group(run, [&](SphereRange range) {
            boxes[stretch][regions_.of(middle(range))].join(box_around(groups_.of(range)));
          });
        });
    std::vector<Box> all(parts_, Box::nothing());
    for (const auto& of_stretch : boxes)
      for (std::uint32_t p = 0; p < parts_; ++p) all[p].join(of_stretch[p]);
    return all;
  }

  const Groups groups_;
  const std::uint32_t parts_;
  const Team& team_;
  Regions regions_;
};

}  // namespace

PartitionOptions partition_options(const Parameters& parameters) {
  return {.group = static_cast<std::uint32_t>(parameters.unsigned_integer("group", 1, 1u << 12)),
          .order = order_named(parameters.choice("order", order_names()))};
}

std::uint64_t Partition::greatest() const {
  std::uint64_t most = 0;
  for (const PartRanges& part : parts)
    most = std::max(most, spheres_in(part.before) + spheres_in(part.own) + spheres_in(part.after));
  return most;
}

double Partition::halo_share() const {
  std::uint64_t own = 0, in_halos = 0;
  for (const PartRanges& part : parts)
    own += spheres_in(part.own), in_halos += spheres_in(part.before) + spheres_in(part.after);
  return own == 0 ? 0 : static_cast<double>(in_halos) / static_cast<double>(own);
}

Partition cut_in_chain_order(std::uint32_t spheres, std::uint32_t parts, std::uint32_t group) {
  return cut_at(even_offsets((spheres + group - 1) / group, parts), spheres, group);
}

Partition part_chain(const Chain& chain, std::uint32_t parts, const PartitionOptions& options,
                     const Team& team) {
  parts = std::max(1u, parts);
  if (options.order == Order::space) return BySpace(chain, parts, options.group, team).part();
  double share = 0;
  if (auto partition = in_chain_order(chain, parts, options, team, share)) return *std::move(partition);
  Partition by_space = BySpace(chain, parts, options.group, team).part();
  if (by_space.halo_share() < share) return by_space;
  return *in_chain_order(chain, parts, {.group = options.group, .order = Order::chain}, team, share);
}

bool seems_tangled(const Chain& chain, std::uint32_t parts, std::uint32_t group, const Team& team) {
  // Groups in a box: some of a part, of which two are looked at.
  const std::uint64_t of_part = chain.size() / group / std::max(1u, parts);
  const auto together = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(of_part / 32, 1, 64));
  const std::uint32_t step = std::max(1u, together / 2);
  const Groups stretches{chain.spheres(), group * together};
  LargeVector<Box> boxes(stretches.count());
  team.for_each_range(stretches.count(), 64, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t s = begin; s < end; ++s) {
      const SphereRange range = stretches.range(s);
      boxes[s] = Box::nothing();
      for (std::uint64_t first = range.begin; first < range.end; first += step * group)
        boxes[s].join(box_around(
            stretches.of({static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(std::min<std::uint64_t>(first + group, range.end))})));
    }
  });
  const std::vector<std::uint32_t> first = even_offsets(stretches.count(), parts);
  constexpr double most = 0.5;  // the ends of a part, which are few boxes, touch the next ones
  return Halos(boxes, first, team).halo_share() > most;
}

}  // namespace catena::parts
