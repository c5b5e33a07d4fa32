#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/tube/error.h"

namespace catena::bench {

/// Both errors of one chain on one tube: of the spheres, and of storing them.
struct TubeErrors {
  std::string name;  ///< of the tube
  double offset = 0;
  TubeError tube;
  std::optional<StorageError> storage;  ///< empty where the pairs are too many to look at each
};

/// Of n spheres, the stored ones moved by `offset` on every axis. `all` is approaches(tube). Storage is
/// looked at for spacings from 0.049 radii and up to 200,000 spheres.
TubeErrors errors_of(const Tube& tube, const std::vector<Approach>& all, std::uint32_t n, double offset);

/// One line of `catena errors --json`.
nlohmann::ordered_json to_json(const TubeErrors& errors);

}  // namespace catena::bench
