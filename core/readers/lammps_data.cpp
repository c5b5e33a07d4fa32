#include "catena/core/readers/lammps_data.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/lammps_atom_style.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/usc_hair.h"

namespace catena {
namespace {

bool starts_with_letter(std::string_view text) {
  return !text.empty() && (('A' <= text[0] && text[0] <= 'Z') || ('a' <= text[0] && text[0] <= 'z'));
}

}  // namespace

LammpsData::LammpsData(const std::filesystem::path& file) : lines_(file) {
  lines_.read_once();
  lines_.next();  // the title
  while (!at_section_ && lines_.next()) {
    if (starts_with_letter(trimmed(lines_.line()))) {
      take_name();
    } else {
      lines_.cut_comment('#');
      if (!lines_.line().empty()) read_header_line();
    }
  }
}

void LammpsData::take_name() {
  const std::string_view line = lines_.line();
  const std::size_t comment = std::min(line.find('#'), line.size());
  section_ = trimmed(line.substr(0, comment));
  style_ = comment < line.size() ? trimmed(line.substr(comment + 1)) : "";
  at_section_ = true;
}

void LammpsData::read_header_line() {
  const auto& fields = lines_.fields();
  const auto is = [&](std::size_t numbers, std::string_view word) {
    return fields.size() == numbers + 1 && fields[numbers] == word;
  };
  const auto say = [&](const std::string& what) {
    if (!said_.insert(what).second) lines_.fail(fmt::format("the header says {} twice", what));
  };
  if (is(1, "atoms")) say("atoms"), atoms_ = lines_.count(fields[0], "number of atoms");
  if (is(1, "bonds")) say("bonds"), bonds_ = lines_.count(fields[0], "number of bonds");
  if (fields.size() == 4 && fields[3].size() == 4 && fields[3].ends_with("vec")) has_general_box_ = true;
  constexpr std::string_view axes = "xyz";
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (fields.size() == 4 && fields[2] == fmt::format("{}lo", axes[axis]) &&
        fields[3] == fmt::format("{}hi", axes[axis])) {
      say(fmt::format("{} {}", fields[2], fields[3]));
      box_.length[axis] = lines_.wide_real(fields[1], "upper end") - lines_.wide_real(fields[0], "lower end");
      has_box_ = true;
    }
  if (fields.size() == 6 && fields[3] == "xy") {
    say("xy xz yz");
    box_.xy = lines_.wide_real(fields[0], "xy");
    box_.xz = lines_.wide_real(fields[1], "xz");
    box_.yz = lines_.wide_real(fields[2], "yz");
  }
}

bool LammpsData::next_section() {
  while (!at_section_) {
    if (!lines_.next()) return false;
    // Names of types may begin rows elsewhere, but not those of the sections that are read.
    if (starts_with_letter(trimmed(lines_.line()))) take_name();
  }
  at_section_ = false;
  return true;
}

const std::vector<std::string_view>& LammpsData::next_row() {
  while (!at_section_ && lines_.next()) {
    if (starts_with_letter(trimmed(lines_.line()))) {
      take_name();
      break;
    }
    lines_.cut_comment('#');
    if (!lines_.line().empty()) return lines_.fields();
  }
  return none_;
}

std::uint64_t LammpsData::read_bonds(BeadFile& beads) {
  for (std::uint64_t bonds = 0;; ++bonds) {
    const auto& row = next_row();
    if (row.empty()) return bonds;
    if (row.size() < 4)
      lines_.fail(fmt::format("a bond is 'id type atom atom', got {}", counted(row.size(), "column")));
    if (const auto problem = beads.tie(lines_.integer(row[2], "atom"), lines_.integer(row[3], "atom"));
        !problem.empty())
      lines_.fail(problem);
  }
}

void LammpsData::require_bonds(std::uint64_t read) const {
  if (read != bonds_)
    lines_.fail(fmt::format("the header says {}, the file has {}", counted(bonds_, "bond"), read));
}

namespace {

/// A LAMMPS data file: atoms, bonds and the box. Where `Atoms` says no style, the columns tell it if they
/// can: with bonds 6 are molecular and 7 full, without 5 are atomic, each perhaps with three image flags
/// more, which are whole numbers. Coordinates are taken as they are stored; image flags are not applied. A
/// diameter of style sphere makes radii. Whether the box is periodic no data file says.
class LammpsAtoms {
 public:
  LammpsAtoms(const std::filesystem::path& file, const ReadOptions& options)
      : data_(file), beads_(options, shown_name(file)) {}

  CurveFile curves() {
    while (data_.next_section()) {
      if (data_.section() == "Atoms") read_atoms();
      if (data_.section() == "Bonds" && atoms_ == 0) data_.lines().fail("the bonds come before the atoms");
      if (data_.section() == "Bonds") bonds_ += data_.read_bonds(beads_);
    }
    if (atoms_ == 0) data_.lines().fail("the file has no section Atoms, or nothing in it");
    if (atoms_ != data_.atoms())
      data_.lines().fail(
          fmt::format("the header says {}, the file has {}", counted(data_.atoms(), "atom"), atoms_));
    data_.require_bonds(bonds_);
    if (data_.has_box()) {
      beads_.about().boxes.push_back(data_.box());
      beads_.about().box_is_periodic = false;
    }
    if (data_.has_general_box())
      beads_.about().warnings.emplace_back(
          "its box of general edges (avec bvec cvec) is left out, and nothing is periodic; write it as "
          "xlo xhi, ylo yhi, zlo zhi and xy xz yz");
    data_.lines().forget();
    return beads_.curves();
  }

 private:
  void read_atoms() {
    const LammpsAtomStyle* style = told_style();
    if (style != nullptr && style->name == "hybrid")
      beads_.about().warnings.emplace_back(
          "the atoms are of style hybrid; molecules and diameters of its sub-styles are not read");
    const std::size_t most = data_.lines().bytes() / 10;  // of what a header can say truly
    beads_.reserve(std::min<std::size_t>(data_.atoms(), most), std::min<std::size_t>(data_.bonds(), most));
    std::size_t size = 0;
    for (;;) {
      const auto& row = data_.next_row();
      if (row.empty()) return beads_.end_frame();
      if (style == nullptr) style = &guessed(row), guessed_ = true;
      const bool flags = row.size() != style->columns + 3 || style->more_columns || has_flags(row);
      if (size == 0 && !(style->fits(row.size()) && flags))
        data_.lines().fail(
            fmt::format("an atom of style {} has {} columns, perhaps 3 image flags more, not {}", style->name,
                        style->columns, row.size()));
      if (size == 0) size = row.size();
      if (row.size() != size)
        data_.lines().fail(
            fmt::format("the atom has {}, those before it {}", counted(row.size(), "column"), size));
      if (guessed_ && size > style->columns && !has_flags(row)) fail_untold(size);
      add(row, *style);
    }
  }

  /// Null where the section names none. Sub-styles may stand behind hybrid; /kk is where LAMMPS keeps the
  /// atoms.
  const LammpsAtomStyle* told_style() const {
    const std::string_view told = data_.style(), word = told.substr(0, told.find_first_of(" \t"));
    if (word.empty()) return nullptr;
    const std::string_view name = word.substr(0, word.size() - (word.ends_with("/kk") ? 3 : 0));
    const auto found = std::ranges::find(lammps_atom_styles(), name, &LammpsAtomStyle::name);
    if (found == lammps_atom_styles().end() || (word != told && name != "hybrid"))
      data_.lines().fail(fmt::format("{} behind Atoms is no style of atoms; write one, as in 'Atoms # full'",
                                     in_quotes(told)));
    return &*found;
  }

  static bool has_flags(const std::vector<std::string_view>& row) {
    return row.size() > 7 && std::all_of(row.end() - 3, row.end(), is_integer);
  }

  [[noreturn]] void fail_untold(std::size_t columns) const {
    data_.lines().fail(
        fmt::format("what the columns are, of which there are {}, is not told; write the style behind the "
                    "section's name, as in "
                    "'Atoms # full'",
                    columns));
  }

  const LammpsAtomStyle& guessed(const std::vector<std::string_view>& row) const {
    const std::size_t columns = row.size() - (has_flags(row) ? 3 : 0);
    const std::string_view name = data_.bonds() == 0 ? (columns == 5 ? "atomic" : "")
                                  : columns == 6     ? "molecular"
                                  : columns == 7     ? "full"
                                                     : "";
    if (name.empty()) fail_untold(row.size());
    return *std::ranges::find(lammps_atom_styles(), name, &LammpsAtomStyle::name);
  }

  void add(const std::vector<std::string_view>& row, const LammpsAtomStyle& columns) {
    const TextLines& lines = data_.lines();
    float radius = 0;
    if (columns.diameter) {
      radius = lines.half(row[*columns.diameter]);
      beads_.about().has_radii = true;
    }
    beads_.add(
        lines.integer(row[0], "atom id"), lines.coordinate(row[columns.x], "x"),
        lines.coordinate(row[columns.x + 1], "y"), lines.coordinate(row[columns.x + 2], "z"), radius,
        columns.molecule && data_.bonds() == 0 ? lines.integer(row[*columns.molecule], "molecule") : 0);
    ++atoms_;
  }

  LammpsData data_;
  BeadFile beads_;
  std::uint64_t atoms_ = 0, bonds_ = 0;
  bool guessed_ = false;  ///< the style, from the columns
};

const RegisterReader registered{{"LAMMPS data",
                                 {".data", ".lmp"},
                                 "atoms along their bonds, or molecules; the box; radii of style sphere",
                                 "atom id"},
                                [](const std::filesystem::path& file, const ReadOptions& options) {
                                  return may_be_usc_hair(file) ? read_usc_hair(file, options)
                                                               : read_by<LammpsAtoms>(file, options);
                                }};

}  // namespace
}  // namespace catena
