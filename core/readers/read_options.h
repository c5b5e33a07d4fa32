#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace catena {

/// What a user says of how a file is to be read. `columns`, `atom`, `array` and `topology` are for the
/// readers that name them in ReaderInfo::options; elsewhere they are refused.
struct ReadOptions {
  std::string
      format{};  ///< --format EXTENSION: read as a file of that extension would be; needed for standard input
  std::vector<std::string> columns{};  ///< --columns x,y,z,r: what each column of a table is; `_` is not read
  std::string atom{};                  ///< --atom NAME: the atom that stands for a residue
  std::string array{};                 ///< --array NAME: the array of a mesh that holds radii, or diameters
  std::string topology{};              ///< --topology FILE: where the strands or bonds of a configuration are
  bool recentre = false;               ///< --recentre: an origin is taken off before the rounding to binary32
  /// --origin: this one; otherwise the first point of the file.
  std::optional<std::array<double, 3>> origin{};
  friend bool operator==(const ReadOptions&, const ReadOptions&) = default;
};

}  // namespace catena
