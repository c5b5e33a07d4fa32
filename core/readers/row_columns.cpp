#include "catena/core/readers/row_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/counted.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"

namespace catena {
namespace {

using Role = TableColumns::Role;

bool is_element(std::string_view word) {
  constexpr std::string_view symbols =
      " H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr Rb "
      "Sr Y Zr "
      "Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W "
      "Re Os Ir Pt "
      "Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm Md No Lr Rf Db Sg Bh Hs Mt Ds Rg Cn "
      "Nh Fl Mc "
      "Lv Ts Og ";
  return word.find(' ') == std::string_view::npos &&
         symbols.find(fmt::format(" {} ", word)) != std::string_view::npos;
}

/// `front`, then x,y,z, then `back`, then columns that are not read.
std::string option(std::string front, std::string_view back, std::size_t columns) {
  front += "x,y,z";
  front += back;
  while (static_cast<std::size_t>(std::ranges::count(front, ',')) + 1 < columns) front += ",_";
  return "--columns " + front;
}

[[noreturn]] void refuse(std::size_t columns, bool word, bool counted, const TextLines& lines) {
  constexpr std::size_t most = 20;  // beyond, no table of points: nobody would write such an option
  if (columns > most)
    lines.fail(fmt::format("{} columns in a row; write a row for each point, as x y z", columns));
  std::vector<std::string> ways;
  if (word) {
    ways = {option("element,", "", columns), option("strand,", "", columns)};
    if (columns > 4)
      ways = {option("element,", "", columns), option("element,", ",r", columns),
              option("chr,_,", "", columns)};
  } else {
    ways = {option("", "", columns), option("", ",r", columns),
            option(counted ? "element," : "id,", "", columns)};
  }
  const auto numbers = [](std::size_t n) { return catena::counted(n, "number"); };
  lines.fail(fmt::format("{} can be read in several ways; say which: {}",
                         word ? fmt::format("a word and {}", numbers(columns - 1))
                              : fmt::format("{} in a row", numbers(columns)),
                         fmt::join(ways, ", ")));
}

}  // namespace

TableColumns columns_of_row(std::span<const std::string_view> row, bool counted, const TextLines& lines) {
  if (row.size() < 3)
    lines.fail(fmt::format("a point needs three coordinates, got {}; a comment starts with #",
                           row.size() == 1 ? fmt::format("{} alone", in_quotes(row[0]))
                                           : fmt::format("{} columns", row.size())));
  if (row.size() == 3) return TableColumns({Role::x, Role::y, Role::z});
  for (std::size_t column = 1; column < row.size(); ++column)
    if (!is_number(row[column]))
      lines.fail(fmt::format("{} in column {} is not a number", in_quotes(row[column]), column + 1));
  const bool word = !is_number(row[0]);
  if (row.size() == 4 && word && (counted || is_element(row[0])))
    return TableColumns({Role::element, Role::x, Role::y, Role::z});
  refuse(row.size(), word, counted, lines);
}

}  // namespace catena
