#include "catena/core/parts/halos.h"

#include <algorithm>
#include <atomic>

namespace catena::parts {

Halos::Halos(std::span<const Box> boxes, std::span<const std::uint32_t> first, const Team& team)
    : boxes_(boxes), first_(first), team_(team), around_((boxes.size() + together - 1) / together) {
  const auto all = static_cast<std::uint32_t>(around_.size());
  team.for_each_range(all, 64, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t a = begin; a < end; ++a) {
      around_[a] = boxes_[a * together];
      for (std::uint32_t k = a * together + 1; k < end_of(a); ++k) around_[a].join(boxes_[k]);
    }
  });
  tree_.clear(all);
  for (std::uint32_t a = 0; a < all; ++a) tree_.set(a, around_[a]);
  tree_.refresh(0, all);
}

std::uint32_t Halos::end_of(std::uint32_t a) const {
  return std::min((a + 1) * together, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t Halos::part_of(std::uint32_t box) const {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(first_, box) - first_.begin()) - 1;
}

std::uint32_t Halos::parts_met(std::uint32_t box) const {
  const auto parts = static_cast<std::uint32_t>(first_.size() - 1);
  std::vector<bool> met(parts, false);
  met[part_of(box)] = true;
  std::uint32_t others = 0;
  tree_.for_each_meeting(boxes_[box], [&](std::uint32_t a) {
    if (others + 1 == parts) return;
    std::uint32_t part = part_of(a * together);
    for (std::uint32_t k = a * together; k < end_of(a); ++k) {
      while (k >= first_[part + 1]) ++part;
      if (!met[part] && boxes_[k].meets(boxes_[box])) met[part] = true, ++others;
    }
  });
  return others;
}

double Halos::halo_share() const {
  constexpr std::size_t most = 256;
  const std::size_t step = std::max<std::size_t>(1, boxes_.size() / most);
  const auto asked = static_cast<std::uint32_t>((boxes_.size() + step - 1) / step);
  std::atomic<std::uint64_t> met{0};
  team_.for_each_range(asked, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::size_t k = begin; k < end; ++k)
      met += parts_met(static_cast<std::uint32_t>(std::min(k * step + step / 2, boxes_.size() - 1)));
  });
  return asked == 0 ? 0 : static_cast<double>(met) / asked;
}

/// take(part, box) for each box of the two that meets one of that other part.
template <class Take>
void Halos::compare(std::uint32_t a, std::uint32_t b, const Take& take) const {
  for (std::uint32_t i = a * together; i < end_of(a); ++i) {
    if (!boxes_[i].meets(around_[b])) continue;
    const std::uint32_t part = part_of(i);
    const auto other = [&](std::uint32_t k) { return k < first_[part] || k >= first_[part + 1]; };
    for (std::uint32_t k = a == b ? i + 1 : b * together; k < end_of(b); ++k)
      if (other(k) && boxes_[k].meets(boxes_[i])) take(part, k), take(part_of(k), i);
  }
}

std::vector<std::vector<std::uint32_t>> Halos::find() const {
  const std::size_t parts = first_.size() - 1;
  std::vector<std::vector<std::vector<std::uint32_t>>> met(team_.size(),
                                                           std::vector<std::vector<std::uint32_t>>(parts));
  team_.for_each_range(
      static_cast<std::uint32_t>(around_.size()), 16, [&](std::uint32_t begin, std::uint32_t end) {
        auto& mine = met[team_.member()];
        const auto take = [&](std::uint32_t part, std::uint32_t box) {
          if (auto& list = mine[part]; list.empty() || list.back() != box) list.push_back(box);
        };
        for (std::uint32_t a = begin; a < end; ++a) {
          const std::uint32_t part = part_of(a * together);
          const bool alone = end_of(a) <= first_[part + 1];
          if (!alone) compare(a, a, take);
          tree_.for_each_meeting(around_[a], [&](std::uint32_t b) {
            const bool same = alone && end_of(b) <= first_[part + 1];
            if (b > a && !same) compare(a, b, take);
          });
        }
      });
  std::vector<std::vector<std::uint32_t>> halos(parts);
  team_.for_each_range(static_cast<std::uint32_t>(parts), 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t p = begin; p < end; ++p) {
      auto& halo = halos[p];
      for (auto& lists : met) {
        halo.insert(halo.end(), lists[p].begin(), lists[p].end());
        std::vector<std::uint32_t>().swap(lists[p]);
      }
      std::ranges::sort(halo);
      halo.erase(std::unique(halo.begin(), halo.end()), halo.end());
    }
  });
  return halos;
}

}  // namespace catena::parts
