#include "catena/core/space_tree/key_sort.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "catena/core/grid/grid_kernels.h"
#include "catena/core/space_tree/digit_sort.h"

namespace catena {
namespace {

constexpr std::size_t part = 1 << 13;
constexpr std::uint32_t shares_a_member = 4, samples_a_share = 32;

/// Vectors of AVX-512 sort at 4 ns a key, digits at 5; narrower ones at 10.
bool by_digits(std::size_t keys) {
  constexpr std::size_t many = 1 << 10;
  return keys >= many && spheres_of_a_vector() < 16;
}

}  // namespace

KeySort::KeySort() = default;
KeySort::~KeySort() = default;

void KeySort::operator()(std::span<std::uint64_t> keys, const Team& team) {
  while (sorters_.size() < team.size()) sorters_.emplace_back();
  while (rooms_.size() < team.size()) rooms_.emplace_back();
  if (team.size() == 1 || keys.size() < few) return sort(keys, rooms_[team.member()], team);
  shares_ = shares_a_member * team.size();
  choose_borders(keys);
  const auto parts = static_cast<std::uint32_t>((keys.size() + part - 1) / part);
  next_.assign(std::size_t{parts} * shares_, 0);
  share_.resize(keys.size());
  copy_.resize(keys.size());
  const auto each_part = [&](const auto& body) {
    team.for_each_range(parts, 1, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t p = begin; p < end; ++p)
        body(&next_[std::size_t{p} * shares_], p * part, std::min((p + 1) * part, keys.size()));
    });
  };
  each_part([&](std::uint32_t* count, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) ++count[share_[k] = share_of(keys[k])];
  });
  add_up(parts);
  each_part([&](std::uint32_t* next, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) copy_[next[share_[k]]++] = keys[k];
  });
  team.for_each_range(shares_, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t s = begin; s < end; ++s) {
      const std::size_t size = first_[s + 1] - first_[s];
      const std::span<std::uint64_t> share(copy_.data() + first_[s], size),
          to = keys.subspan(first_[s], size);
      const std::span<std::uint64_t> sorted = sort(share, to, team);
      if (sorted.data() != to.data()) std::copy(sorted.begin(), sorted.end(), to.begin());
    }
  });
}

void KeySort::sort(std::span<std::uint64_t> keys, LargeVector<std::uint64_t>& room, const Team& team) {
  if (by_digits(keys.size()) && room.size() < keys.size()) room.clear(), room.resize(keys.size());
  const std::span<std::uint64_t> sorted = sort(keys, {room.data(), std::min(room.size(), keys.size())}, team);
  if (sorted.data() != keys.data()) std::copy(sorted.begin(), sorted.end(), keys.begin());
}

std::span<std::uint64_t> KeySort::sort(std::span<std::uint64_t> keys, std::span<std::uint64_t> room,
                                       const Team& team) {
  if (by_digits(keys.size())) return sort_by_digits(keys, room);
  sorters_[team.member()](keys.data(), keys.size(), hwy::SortAscending());
  return keys;
}

void KeySort::choose_borders(std::span<const std::uint64_t> keys) {
  const std::size_t samples = std::size_t{shares_} * samples_a_share;
  std::vector<std::uint64_t> some(samples);
  for (std::size_t k = 0; k < samples; ++k) some[k] = keys[k * keys.size() / samples];
  std::sort(some.begin(), some.end());
  borders_.assign(std::bit_ceil(shares_) - 1, std::numeric_limits<std::uint64_t>::max());
  for (std::uint32_t s = 1; s < shares_; ++s) borders_[s - 1] = some[s * samples_a_share];
}

/// How many borders are not above the key, by halves and without a branch: which way it goes cannot be
/// foretold where keys are in no order.
std::uint16_t KeySort::share_of(std::uint64_t key) const {
  std::size_t below = 0;
  for (std::size_t half = (borders_.size() + 1) / 2; half > 0; half /= 2)
    below += half * static_cast<std::size_t>(borders_[below + half - 1] <= key);
  return static_cast<std::uint16_t>(std::min<std::size_t>(below, shares_ - 1));
}

/// Numbers of keys become places.
void KeySort::add_up(std::uint32_t parts) {
  first_.assign(shares_ + 1, 0);
  std::uint32_t place = 0;
  for (std::uint32_t s = 0; s < shares_; ++s) {
    first_[s] = place;
    for (std::uint32_t p = 0; p < parts; ++p) {
      std::uint32_t& next = next_[std::size_t{p} * shares_ + s];
      const std::uint32_t count = next;
      next = place;
      place += count;
    }
  }
  first_[shares_] = place;
}

}  // namespace catena
