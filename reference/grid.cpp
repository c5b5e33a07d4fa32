#include "catena/reference/grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "catena/reference/exact_gap.h"
#include "catena/reference/tally.h"

namespace catena::reference {
namespace {

// Why 27 cells are enough. A level's cell c is a power of two >= 2r for each radius r of the level and of all
// finer ones, so overlapping spheres A of this and B of this or a finer level have |xA - xB| <= rA + rB <= c.
// Their exact cell coordinates xA/c and xB/c differ by at most 1, hence so do the floors. Scaling by a power
// of two and floor are exact in binary64: a binary32 divided by c stays within 2^-278..2^277. Above 2^53
// index +-1 may round back to the index or to the one after the next: no sphere is lost, as none has an index
// in between (an index that large is a multiple of 2^30), and equal columns are looked into once.

/// The least e with 2^e >= 2 * radius. Points get the finest level: 2^-149 separates all different ones.
int octave(float radius) {
  if (radius == 0) return -149;
  int exponent;
  const double mantissa = std::frexp(2 * double{radius}, &exponent);
  return mantissa == 0.5 ? exponent - 1 : exponent;
}

struct Cell {
  double x, y, z;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Different integers for different cell coordinates up to 2^62, and consecutive ones for neighbours.
std::uint64_t whole(double v) {
  return std::fabs(v) < 0x1p62 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(v))
                               : std::bit_cast<std::uint64_t>(v);
}

/// Cells along x share a row and follow one another, so that looking into three of them reads one cache line.
std::uint64_t row(double y, double z) {
  std::uint64_t h = whole(y) * 0x9E3779B97F4A7C15u;  // odd constants of splitmix64
  h = (h ^ h >> 32) * 0xBF58476D1CE4E5B9u + whole(z);
  h = (h ^ h >> 29) * 0x94D049BB133111EBu;
  return h ^ h >> 32;
}

/// The coordinates next to v, v among them, each once.
struct Axis {
  std::array<double, 3> at;
  int size = 0;
  explicit Axis(double v) {
    for (const double candidate : {v - 1, v, v + 1})
      if (size == 0 || at[size - 1] != candidate) at[size++] = candidate;
  }
  const double* begin() const { return at.data(); }
  const double* end() const { return at.data() + size; }
};

/// All spheres of one octave, in buckets by the hash of their cell.
class Level {
 public:
  Level(int octave, std::span<const Sphere> spheres, std::span<const std::uint32_t> members)
      : cells_per_unit_(std::ldexp(1.0, -octave)), mask_(std::bit_ceil(members.size()) - 1) {
    first_.assign(mask_ + 2, 0);
    entries_.resize(members.size());
    low_ = high_ = cell(spheres[members.front()]);
    for (const std::uint32_t i : members) {
      const Cell c = cell(spheres[i]);
      ++first_[bucket(c) + 1];
      low_ = {std::min(low_.x, c.x), std::min(low_.y, c.y), std::min(low_.z, c.z)};
      high_ = {std::max(high_.x, c.x), std::max(high_.y, c.y), std::max(high_.z, c.z)};
    }
    for (std::size_t b = 0; b <= mask_; ++b) first_[b + 1] += first_[b];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const std::uint32_t i : members) {
      const Cell c = cell(spheres[i]);
      entries_[next[bucket(c)]++] = {c, i};
    }
  }

  /// Calls visit(index) once for each sphere of this level in the 27 cells around s.
  template <class Visit>
  void around(const Sphere& s, Visit&& visit) const {
    const Cell home = cell(s);
    if (home.x < low_.x - 1 || home.y < low_.y - 1 || home.z < low_.z - 1 || home.x > high_.x + 1 ||
        home.y > high_.y + 1 || home.z > high_.z + 1)
      return;  // Exact below 2^53; above, indices are multiples of 2^30, and those that differ by 1 at most
               // are equal.
    const Axis xs(home.x), ys(home.y), zs(home.z);
    for (const double z : zs)
      for (const double y : ys) {
        const std::uint64_t start = row(y, z);
        for (const double x : xs) {
          const std::size_t b = (start + whole(x)) & mask_;
          for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k)
            if (entries_[k].cell == Cell{x, y, z})
              visit(entries_[k].index);  // others share the bucket by chance
        }
      }
  }

 private:
  struct Entry {
    Cell cell;
    std::uint32_t index;
  };
  Cell cell(const Sphere& s) const {
    return {std::floor(s.x * cells_per_unit_), std::floor(s.y * cells_per_unit_),
            std::floor(s.z * cells_per_unit_)};
  }
  std::size_t bucket(const Cell& c) const { return (row(c.y, c.z) + whole(c.x)) & mask_; }

  double cells_per_unit_;
  Cell low_, high_;  // the cells that are in use lie between
  std::size_t mask_;
  std::vector<std::uint32_t> first_;  // buckets + 1 offsets into entries_
  std::vector<Entry> entries_;
};

/// Calls meet(i, j) once for each pair whose distance is at most 2^widened times the sum of its radii, and
/// for others.
template <class Meet>
void search(const Chain& chain, int widened, const Meet& meet) {
  const auto spheres = chain.spheres();
  std::map<int, std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < chain.size(); ++i) members[octave(spheres[i].radius)].push_back(i);
  std::map<int, Level> levels;
  for (const auto& [octave, indices] : members)
    levels.try_emplace(octave, octave + widened, spheres, indices);

  for (std::uint32_t i = 0; i < chain.size(); ++i) {
    // Spheres of one level find each other twice, those of different levels once: the finer looks for the
    // coarser.
    auto level = levels.find(octave(spheres[i].radius));
    level->second.around(spheres[i], [&](std::uint32_t j) {
      if (j > i) meet(i, j);
    });
    while (++level != levels.end()) level->second.around(spheres[i], [&](std::uint32_t j) { meet(i, j); });
  }
}

}  // namespace

Answer by_grid(const Chain& chain, const Request& request) {
  const auto spheres = chain.spheres();
  const ChainView view = chain.view();
  Tally tally(chain.size(), request);
  search(chain, 0, [&](std::uint32_t i, std::uint32_t j) {
    if (overlap(spheres[i], spheres[j]) && !view.neighbours(i, j)) tally.add(i, j);
  });
  return std::move(tally).finish();
}

void near_pairs(const Chain& chain, const NearVisitor& visit) {
  const auto spheres = chain.spheres();
  const ChainView view = chain.view();
  search(chain, 1, [&](std::uint32_t i, std::uint32_t j) {
    const Sphere &a = spheres[i], &b = spheres[j];
    const auto rough = GapEstimate::of(a, b);
    if (rough.gap > 1.0001 * rough.radii || view.neighbours(i, j)) return;
    // A rough margin above 2^-8 has relative error below 2^-40, as in all_pairs; below it, and next to 1,
    // where it decides who is near, only exact will do.
    double m = std::fabs(rough.gap) / rough.radii;
    if (!(m > 0x1p-8) || std::fabs(m - 1) < 0x1p-38) m = margin(a, b);
    const bool collides = overlap(a, b);
    if (m < 1 || collides) visit({std::min(i, j), std::max(i, j)}, collides, m);
  });
}

}  // namespace catena::reference
