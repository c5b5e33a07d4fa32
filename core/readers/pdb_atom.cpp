#include "catena/core/readers/pdb_atom.h"

#include <fmt/format.h>

#include "catena/core/readers/number_text.h"

namespace catena {
namespace {

// Names start in column 13 or 14, a number fills its field to the last column, and a residue's name of three
// letters or fewer leaves column 21 blank: of a shifted line, one of these is not so.
void require_columns(const TextLines& lines) {
  const std::string_view line = lines.line();
  if (line.size() < 54)
    lines.fail(fmt::format("an atom's coordinates end at column 54, the line at {}", line.size()));
  const auto blank = [&](std::size_t column) { return line[column - 1] == ' '; };
  const auto refuse = [&](const char* what) {
    lines.fail(fmt::format("{}; the columns of this line are not those of the format", what));
  };
  if (blank(13) && blank(14)) refuse("no atom's name starts in column 13 or 14");
  if (!blank(12) && !(line[11] >= '0' && line[11] <= '9'))
    refuse("column 12, before the atom's name, is not blank");
  if (!blank(21) && (blank(18) || blank(19) || blank(20)))
    refuse("the residue's name does not stand in columns 18 to 20");
  for (const std::size_t last : {38, 46, 54})
    if (blank(last) && !trimmed(line.substr(last - 8, 8)).empty())
      refuse("a coordinate does not end in column 38, 46 or 54");
}

char letter(std::string_view line, std::size_t column) {
  const std::string_view text = pdb_columns(line, column, column);
  return text.empty() ? ' ' : text[0];
}

}  // namespace

std::string_view pdb_columns(std::string_view line, std::size_t first, std::size_t last) {
  return first > line.size() ? std::string_view{} : line.substr(first - 1, last - first + 1);
}

PdbAtom parse_pdb_atom(const TextLines& lines) {
  require_columns(lines);
  const std::string_view line = lines.line();
  const auto field = [&](std::size_t first, std::size_t last) {
    return trimmed(pdb_columns(line, first, last));
  };
  PdbAtom atom{};
  atom.hetero = line.starts_with("HETATM");
  atom.name = field(13, 16);
  atom.alternate = letter(line, 17);
  atom.residue = field(18, 21);
  atom.chain = field(22, 22);
  atom.number = field(23, 26);
  atom.insertion = letter(line, 27);
  atom.x = lines.coordinate(field(31, 38), "x");
  atom.y = lines.coordinate(field(39, 46), "y");
  atom.z = lines.coordinate(field(47, 54), "z");
  if (atom.chain.empty()) atom.segment = field(73, 76);
  const std::string_view occupancy = field(55, 60);
  atom.occupancy = occupancy.empty() ? 1 : lines.wide_real(occupancy, "occupancy");
  atom.calcium = atom.name == "CA" && line[12] == 'C' &&
                 (atom.hetero || atom.residue == "CA" || lower_case(field(77, 78)) == "ca");
  return atom;
}

}  // namespace catena
