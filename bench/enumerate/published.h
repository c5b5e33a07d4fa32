#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace catena::bench {

/// What a table of walks on the square or cubic lattice counts.
enum class WalkTable {
  self_avoiding,  ///< walks that visit no point twice
  contact_free,   ///< of those, walks whose points are adjacent only where they follow one another
  contacts        ///< pairs of adjacent points that do not follow one another, over all self-avoiding walks
};

/// Numbers that somebody else counted and published; none of them was computed here.
struct PublishedTable {
  int dimensions;  ///< of the lattice: 2 square, 3 cubic
  WalkTable counts;
  std::string sequence;  ///< "A001412" of the On-Line Encyclopedia of Integer Sequences
  std::string erratum;   ///< a number printed elsewhere that the source calls wrong; empty: none is known
  std::vector<std::uint64_t> terms;  ///< terms[n] for n steps, from n = 0

  std::string address() const { return "https://oeis.org/" + sequence; }
};

std::span<const PublishedTable> published_tables();

/// Null where nobody published one that is carried here.
const PublishedTable* published_table(int dimensions, WalkTable counts);

}  // namespace catena::bench
