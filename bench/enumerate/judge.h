#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/enumerate/enumerate.h"

namespace catena::bench {

/// One number that a variant found, beside the published one.
struct WalkVerdict {
  std::string lattice;
  float radius = 0;
  int steps = 0;
  std::string counts;  ///< what is counted, in words
  std::uint64_t found = 0;
  std::string sequence;  ///< empty: nobody published it, or not for so many steps
  std::optional<std::uint64_t> published;
  double ms = 0;  ///< of the whole question, this length and the shorter ones

  bool differs() const { return published && *published != found; }
};

/// Asks the variant and looks each number up. Throws like enumerate_walks.
std::vector<WalkVerdict> judge_walks(Variant& variant, const WalkQuestion& question);

/// {lattice, radius, steps, counts, found, (sequence, published, agrees)}
nlohmann::ordered_json to_json(const WalkVerdict& verdict);

std::string lattice_name(const WalkQuestion& question);  ///< "square", "cubic", or the other's

}  // namespace catena::bench
