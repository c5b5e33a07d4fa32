#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "catena/core/periodic/periodic_box.h"
#include "catena/core/readers/bead_file.h"
#include "catena/core/readers/text_lines.h"

namespace catena {

/// A LAMMPS data file, https://docs.lammps.org/read_data.html, section by section: a title, header lines, and
/// sections that begin with a name between blank lines.
class LammpsData {
 public:
  /// Reads the header. Throws InputError.
  explicit LammpsData(const std::filesystem::path& file);

  /// Goes to the next section; false when there is none.
  bool next_section();
  const std::string& section() const { return section_; }  ///< "Atoms"
  const std::string& style() const { return style_; }      ///< what the comment after its name says: "full"

  /// The next row of the section; empty at its end.
  const std::vector<std::string_view>& next_row();

  /// The rows of the section Bonds, in which this is, as bonds of beads; how many they are. Throws
  /// InputError.
  std::uint64_t read_bonds(BeadFile& beads);
  /// Throws InputError where the header says another number of bonds than were read of the whole file.
  void require_bonds(std::uint64_t read) const;

  TextLines& lines() { return lines_; }
  const TextLines& lines() const { return lines_; }
  std::uint32_t bonds() const { return bonds_; }  ///< that the header announces
  std::uint32_t atoms() const { return atoms_; }
  bool has_box() const { return has_box_; }
  bool has_general_box() const { return has_general_box_; }  ///< of any edges, which is not read
  const PeriodicBox& box() const { return box_; }

 private:
  void read_header_line();
  void take_name();

  TextLines lines_;
  std::string section_, style_;
  std::vector<std::string_view> none_;
  std::uint32_t atoms_ = 0, bonds_ = 0;
  bool has_box_ = false, has_general_box_ = false, at_section_ = false;
  std::set<std::string> said_;  ///< in the header
  PeriodicBox box_;
};

}  // namespace catena
