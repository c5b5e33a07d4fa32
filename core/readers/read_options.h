#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace catena {

/// What a user says of how a file is to be read. `columns` and `atom` are for the readers that name them in
/// ReaderInfo::options; elsewhere they are refused.
struct ReadOptions {
  std::vector<std::string> columns{};  ///< --columns x,y,z,r: what each column of a table is; `_` is not read
  std::string atom{};                  ///< --atom NAME: the atom that stands for a residue
  bool recentre = false;               ///< --recentre: an origin is taken off before the rounding to binary32
  std::optional<std::array<double, 3>> origin{};  ///< --origin: this one; otherwise the first point of the file
};

}  // namespace catena
