#include "catena/core/readers/binary_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "catena/core/chain/centre_distance.h"
#include "catena/core/counted.h"
#include "catena/core/default_floats.h"
#include "catena/core/error.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"

namespace catena {

static_assert(std::endian::native == std::endian::little, "arrays are read as they are in the file");
static_assert(sizeof(BinaryChain::Header) == 64);

namespace {
constexpr std::uint64_t most_strands = 1u << 16;  // that are read at once
}

BinaryChain::BinaryChain(std::string name, std::uint64_t bytes, ReadAt read)
    : name_(std::move(name)), read_(std::move(read)) {
  if (bytes < sizeof header_) fail("the file is truncated: it has no header");
  read_(0, std::as_writable_bytes(std::span(&header_, 1)));
  if (std::memcmp(header_.magic, magic, sizeof header_.magic) != 0)
    fail("the file does not start with 'catena-binary 1'");
  const std::uint64_t arcs = header_.rule == 1 ? sizeof(double) : 0;
  // Each fits into the file before it is multiplied.
  if (header_.spheres > bytes / sizeof(Sphere) || header_.strands > bytes / sizeof(Strand) ||
      header_.pairs > bytes / sizeof(Neighbours))
    fail(fmt::format("the file is truncated: {}, {} and {} do not fit into {}",
                     counted(header_.spheres, "sphere"), counted(header_.strands, "strand"),
                     counted(header_.pairs, "pair"), counted(bytes, "byte")));
  spheres_at_ = sizeof header_;
  strands_at_ = spheres_at_ + header_.spheres * sizeof(Sphere);
  pairs_at_ = strands_at_ + header_.strands * sizeof(Strand);
  arcs_at_ = pairs_at_ + header_.pairs * sizeof(Neighbours);
  if (const std::uint64_t due = arcs_at_ + header_.spheres * arcs; due != bytes)
    fail(fmt::format("the file has {}, but its header says {}", counted(bytes, "byte"), due));
  const bool window = header_.rule == 0 && header_.window >= 1;
  const bool arc = header_.rule == 1 && std::isfinite(header_.factor) && header_.factor > 0;
  if (!window && !arc)
    fail(fmt::format("the exclusion rule {} with window {} and factor {} is none", header_.rule,
                     header_.window, header_.factor));
  if (header_.strands == 0) fail("there is no strand");
}

Exclusion BinaryChain::rule() const {
  return header_.rule == 0 ? Exclusion::index(header_.window) : Exclusion::arc(header_.factor);
}

template <class Record>
std::vector<Record> BinaryChain::records(std::uint64_t array, std::uint64_t begin, std::uint64_t end) const {
  std::vector<Record> all;
  resize_large(all, end - begin);
  if (!all.empty()) read_(array + begin * sizeof(Record), std::as_writable_bytes(std::span(all)));
  return all;
}

std::vector<Sphere> BinaryChain::spheres(std::uint64_t begin, std::uint64_t end) const {
  auto all = records<Sphere>(spheres_at_, begin, end);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Sphere& s = all[k];
    if (!std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z) || !std::isfinite(s.radius))
      fail(fmt::format("sphere {} is not finite: x={} y={} z={} radius={}", begin + k, s.x, s.y, s.z,
                       s.radius));
    if (s.radius < 0) fail(fmt::format("sphere {} has the negative radius {}", begin + k, s.radius));
  }
  return all;
}

std::vector<double> BinaryChain::arcs(std::uint64_t begin, std::uint64_t end) const {
  auto all = records<double>(arcs_at_, begin, end);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!std::isfinite(all[k]))
      fail(fmt::format("the arc length {} of sphere {} is not finite", all[k], begin + k));
  return all;
}

std::vector<BinaryChain::Extent> BinaryChain::strands(std::uint64_t begin, std::uint64_t end) const {
  const auto found = records<Strand>(strands_at_, begin, std::min(end + 1, header_.strands));
  std::vector<Extent> extents;
  extents.reserve(end - begin);
  for (std::uint64_t number = begin; number < end; ++number) {
    const Strand& strand = found[number - begin];
    const std::uint64_t stop =
        number + 1 < header_.strands ? found[number + 1 - begin].first : header_.spheres;
    if (strand.first > stop || (number == 0 && strand.first != 0) || stop > header_.spheres)
      fail(fmt::format("strand {} runs from sphere {} to {}", number, strand.first, stop));
    if (strand.closed > 1 || !std::isfinite(strand.loop_length))
      fail(fmt::format("strand {} is closed by {}, with a loop of length {}", number, strand.closed,
                       strand.loop_length));
    extents.push_back({strand, stop});
  }
  return extents;
}

BinaryChain::Extent BinaryChain::strand(std::uint64_t number) const { return strands(number, number + 1)[0]; }

void BinaryChain::for_each_strand(
    std::uint64_t begin, std::uint64_t end,
    const std::function<void(std::uint64_t number, const Extent&)>& visit) const {
  std::uint64_t number = strand_of(begin);
  // One strand of millions of spheres is as usual as millions of strands.
  for (std::uint64_t many = 8; begin < end; many = std::min(2 * many, most_strands))
    for (const Extent& strand : strands(number, std::min(number + many, header_.strands))) {
      if (strand.end > begin && begin < end) visit(number, strand), begin = strand.end;
      ++number;
    }
}

void BinaryChain::require_strands(std::uint64_t begin, std::uint64_t end) const {
  for (; begin < end; begin = std::min(end, begin + most_strands))
    strands(begin, std::min(end, begin + most_strands));
}

void BinaryChain::require_measured(std::uint64_t begin, std::span<const Sphere> spheres,
                                   std::span<const double> arcs) const {
  if (spheres.empty()) return;
  const DefaultFloats floats;
  const std::uint64_t end = begin + spheres.size();
  std::uint64_t at = begin;
  for_each_strand(begin, end, [&](std::uint64_t number, const Extent& extent) {
    const Strand& strand = extent.strand;
    const std::uint64_t stop = extent.end;
    // What goes before this part is some other's to check.
    Sphere last = at > strand.first ? this->spheres(at - 1, at)[0] : spheres[at - begin];
    double length = at > strand.first ? this->arcs(at - 1, at)[0] : 0;
    for (; at < std::min(end, stop); ++at) {
      length += centre_distance(last, spheres[at - begin]);
      last = spheres[at - begin];
      if (arcs[at - begin] != length)
        fail(fmt::format("sphere {} is at the arc length {}, but centres say {}; write the file anew", at,
                         arcs[at - begin], length));
    }
    if (strand.closed == 0 || at < stop) return;
    const std::uint64_t first = strand.first;
    length +=
        centre_distance(last, first < begin ? this->spheres(first, first + 1)[0] : spheres[first - begin]);
    if (strand.loop_length != length)
      fail(fmt::format("strand {} has a loop of length {}, but centres say {}; write the file anew", number,
                       strand.loop_length, length));
  });
}

std::uint64_t BinaryChain::strand_of(std::uint64_t sphere) const {
  std::uint64_t begin = 0,
                end = header_.strands;  // strand `begin` begins at the sphere or before it, `end` does not
  while (end - begin > 1) {
    const std::uint64_t middle = begin + (end - begin) / 2;
    (records<Strand>(strands_at_, middle, middle + 1)[0].first <= sphere ? begin : end) = middle;
  }
  return begin;
}

std::vector<BinaryChain::Neighbours> BinaryChain::pairs(std::uint64_t begin, std::uint64_t end) const {
  const auto first_of = [&](std::uint64_t sphere) {
    if (sphere == header_.spheres)
      return header_.pairs;  // also those that begin with no sphere, to be refused
    std::uint64_t low = 0, high = header_.pairs;
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (records<Neighbours>(pairs_at_, middle, middle + 1)[0].i < sphere)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  };
  auto all = records<Neighbours>(pairs_at_, first_of(begin), first_of(end));
  for (const auto& [i, j] : all)
    if (i < begin || i >= end || j <= i || j >= header_.spheres)
      fail(
          fmt::format("the pair {} {} does not name two of the spheres in their order, of which there are {}",
                      i, j, header_.spheres));
  return all;
}

void BinaryChain::fail(const std::string& reason) const {
  throw InputError(fmt::format("{}: {}", name_, reason));
}

namespace {

/// All of it, as other files are read.
CurveFile read_whole(const std::filesystem::path& file, const ReadOptions& options) {
  const std::string bytes = read_bytes(file);
  const BinaryChain binary(shown_name(file), bytes.size(), [&](std::uint64_t at, std::span<std::byte> part) {
    std::memcpy(part.data(), bytes.data() + at, part.size());
  });
  const auto& header = binary.header();
  if (header.spheres >= std::uint64_t{1} << 31)
    throw InputError(fmt::format("{}: {} spheres are too many for one process; search them by ranks (mpirun)",
                                 shown_name(file), header.spheres));
  CurveFile curves(options);
  curves.has_radii = true;
  curves.exclusion = binary.rule();
  const std::vector<Sphere> spheres = binary.spheres(0, header.spheres);
  binary.require_strands(0, header.strands);
  // A chain of other arcs would be another one by ranks, which take them from the file.
  if (header.rule == 1) binary.require_measured(0, spheres, binary.arcs(0, header.spheres));
  for (const Sphere& s : spheres) curves.add_point(s.x, s.y, s.z, s.radius);
  for (std::uint64_t k = 0; k < header.strands; ++k) {
    const BinaryChain::Extent strand = binary.strand(k);
    curves.strand_first.push_back(static_cast<std::uint32_t>(strand.end));
    curves.strand_closed.push_back(strand.strand.closed != 0);
  }
  for (const auto& [i, j] : binary.pairs(0, header.spheres))
    curves.exclusion.extra_pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
  return curves;
}

const RegisterReader registered{{"catena binary",
                                 {".catena"},
                                 "catena's own arrays: what .chain holds, but joints; ranks read a part each",
                                 "sphere number from 0"},
                                read_whole};

}  // namespace
}  // namespace catena
