#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "catena/core/chain/exclusion.h"
#include "catena/core/sphere.h"

namespace catena {

/// Catena's own binary, `.catena`: what `.chain` holds, but joints, in arrays of which any part can be read
/// alone, for chains of more than 2^31 spheres too. Little-endian:
///
///     64 bytes   BinaryChain::Header
///     spheres    16 bytes each: x y z radius, binary32
///     strands    24 bytes each: first sphere (u64), closed (u64: 0 or 1), length around the loop (binary64;
///                0 for an open strand, and under an index window)
///     pairs      16 bytes each: extra neighbours i < j (u64), sorted, each once
///     arcs       8 bytes a sphere: arc length along its strand (binary64); only under an arc window
///
/// The size of the file follows from the header, so that a truncated one is known at once.
class BinaryChain {
 public:
  struct Header {
    char magic[16];  ///< "catena-binary 1\n"
    std::uint64_t spheres, strands, pairs;
    std::uint32_t rule;    ///< 0: index window, 1: arc window
    std::uint32_t window;  ///< of the index window; else 0
    double factor;         ///< of the arc window; else 0
    std::uint64_t reserved;
  };
  static constexpr char magic[] = "catena-binary 1\n";

  struct Strand {
    std::uint64_t first, closed;
    double loop_length;
  };
  struct Neighbours {
    std::uint64_t i, j;
  };

  /// Fills the bytes from this position of the file on. They are within its size.
  using ReadAt = std::function<void(std::uint64_t position, std::span<std::byte>)>;

  /// Reads the header. Throws InputError, naming the file, unless it is that of a file of so many bytes.
  BinaryChain(std::string name, std::uint64_t bytes, ReadAt read);

  const Header& header() const { return header_; }
  Exclusion rule() const;  ///< without extra pairs

  /// Parts of the arrays, begin <= end <= their size. Throw InputError, naming the sphere or strand, for what
  /// no chain has. O(end - begin).
  std::vector<Sphere> spheres(std::uint64_t begin, std::uint64_t end) const;
  std::vector<double> arcs(std::uint64_t begin, std::uint64_t end) const;
  /// A strand, and where the one after it begins.
  struct Extent {
    Strand strand;
    std::uint64_t end;
  };
  Extent strand(std::uint64_t number) const;
  /// Calls visit(number, extent) for the strands that have spheres of [begin, end), in their order. Strands
  /// are read many at once: there may be millions of a few spheres each.
  void for_each_strand(std::uint64_t begin, std::uint64_t end,
                       const std::function<void(std::uint64_t number, const Extent&)>& visit) const;
  /// Throws InputError, naming the strand, for one of these that no chain has. Memory for a few.
  void require_strands(std::uint64_t begin, std::uint64_t end) const;
  /// Throws InputError, naming the sphere or strand, unless these arc lengths, of these spheres of the file
  /// from `begin` on, are what Chain measures of them, bit for bit: who gives all of the file to one Chain
  /// reads none. A loop is checked with its last sphere.
  void require_measured(std::uint64_t begin, std::span<const Sphere> spheres,
                        std::span<const double> arcs) const;
  /// The last strand that begins at this sphere or before it. O(log strands) reads.
  std::uint64_t strand_of(std::uint64_t sphere) const;
  /// The extra pairs whose i is one of these spheres. O(log pairs) reads, and theirs.
  std::vector<Neighbours> pairs(std::uint64_t begin, std::uint64_t end) const;

 private:
  template <class Record>
  std::vector<Record> records(std::uint64_t array, std::uint64_t begin, std::uint64_t end) const;
  std::vector<Extent> strands(std::uint64_t begin, std::uint64_t end) const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::string name_;
  ReadAt read_;
  Header header_;
  std::uint64_t spheres_at_, strands_at_, pairs_at_, arcs_at_;
};

}  // namespace catena
