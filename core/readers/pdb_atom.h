#pragma once
#include <string>
#include <string_view>

#include "catena/core/readers/text_lines.h"

namespace catena {

/// An ATOM or HETATM line of the PDB format, by its columns.
struct PdbAtom {
  bool hetero;
  std::string name;  ///< "CA"
  char alternate;    ///< location; blank: the only one
  std::string residue, chain, number, segment;
  char insertion;
  double x, y, z;
  double occupancy;  ///< 1 where the line has none
  bool calcium;      ///< named CA, but no C-alpha

  bool same_residue(const PdbAtom& other) const {
    return chain == other.chain && segment == other.segment && number == other.number &&
           insertion == other.insertion;
  }
};

/// Columns of a line counted from 1, both included, as in the format's own tables; what a short line lacks is
/// empty.
std::string_view pdb_columns(std::string_view line, std::size_t first, std::size_t last);

/// The current line, which is an ATOM or HETATM record. Throws InputError "file:line: reason" where the line
/// is too short, a coordinate is no number, or the columns are shifted, so that they would be misread.
PdbAtom parse_pdb_atom(const TextLines& lines);

}  // namespace catena
