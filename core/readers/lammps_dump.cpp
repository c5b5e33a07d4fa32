#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "catena/core/counted.h"
#include "catena/core/readers/bead_file.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/lammps_data.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// A LAMMPS dump in text, https://docs.lammps.org/dump.html: frames of atoms in any order, by the names of
/// their columns: id; x y z, unwrapped (xu), scaled (xs) or both (xsu); perhaps mol, and radius or diameter.
/// The box is that of each frame, periodic along an axis where both bounds say p; old versions of LAMMPS say
/// nothing. Bonds are in a data file that --topology names.
namespace catena {
namespace {

class LammpsDump {
 public:
  LammpsDump(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), beads_(options, shown_name(file)), topology_(options.topology) {}

  CurveFile curves() {
    lines_.read_once();
    while (lines_.next())
      if (!trimmed(lines_.line()).empty()) read_item();
    if (in_header_) lines_.fail("the file is truncated: it ends where 'ITEM: ATOMS' is due");
    lines_.forget();
    if (!topology_.empty()) read_bonds();
    return beads_.curves();
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void read_item() {
    const std::string_view line = trimmed(lines_.line());
    if (!line.starts_with("ITEM: ")) lines_.fail("'ITEM: ...' is due");
    const std::string_view item = line.substr(6);
    if (item.starts_with("TIMESTEP") && has_step_)
      lines_.fail("another frame begins where 'ITEM: ATOMS' of this one is due");
    has_step_ = has_step_ || item.starts_with("TIMESTEP");
    in_header_ = true;
    if (item.starts_with("NUMBER OF ATOMS"))
      read_number();
    else if (item.starts_with("BOX BOUNDS"))
      read_box();
    else if (item.starts_with("ATOMS"))
      read_atoms();
    else
      due_line("a value");  // TIMESTEP, UNITS, TIME
  }

  void read_number() {
    atoms_ = lines_.count(trimmed(due_line("the number of atoms")), "number of atoms");
    beads_.reserve(std::min<std::size_t>(atoms_, lines_.bytes() / 8), 0);
  }

  std::string_view due_line(const char* what) {
    if (!lines_.next()) lines_.fail(fmt::format("the file is truncated: it ends where {} is due", what));
    return lines_.line();
  }

  // The bounds of a tilted box are those of what encloses it, see
  // https://docs.lammps.org/Howto_triclinic.html.
  void read_box() {
    std::vector<std::string> words;
    for (const auto word : lines_.fields()) words.emplace_back(word);
    const bool tilted = words.size() > 3 && words[3] == "xy";
    if (words.size() > 3 && words[3] == "abc")
      lines_.fail("a box of general edges (abc origin) is not supported; dump it as xy xz yz");
    const std::size_t kinds = tilted ? 6 : 3;
    if (words.size() != kinds && words.size() != kinds + 3)
      lines_.fail(
          "'ITEM: BOX BOUNDS' has three words such as pp behind it, and xy xz yz in front of them if tilted");
    if (words.size() == kinds) beads_.about().box_is_periodic = false;
    std::array<double, 3> low{}, high{}, tilt{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      due_line("a bound of the box");
      const auto& fields = lines_.fields();
      if (fields.size() < (tilted ? 3u : 2u))
        lines_.fail("a bound of the box is 'low high', and a tilt where it is tilted");
      low[axis] = lines_.wide_real(fields[0], "lower bound");
      high[axis] = lines_.wide_real(fields[1], "upper bound");
      if (tilted) tilt[axis] = lines_.wide_real(fields[2], "tilt");
    }
    const auto [xy, xz, yz] = tilt;
    low[0] -= std::min({0.0, xy, xz, xy + xz}), high[0] -= std::max({0.0, xy, xz, xy + xz});
    low[1] -= std::min(0.0, yz), high[1] -= std::max(0.0, yz);
    low_ = low;
    edge_ = {{high[0] - low[0], high[1] - low[1], high[2] - low[2]}, xy, xz, yz};
    box_ = edge_;
    has_box_ = true;
    for (std::size_t axis = 0; axis < 3 && words.size() > kinds; ++axis)
      if (words[kinds + axis] != "pp") box_.length[axis] = 0;
  }

  void read_atoms() {
    find_columns();
    for (std::uint32_t k = 0; k < atoms_; ++k) {
      due_line("an atom");
      const auto& fields = lines_.fields();
      if (fields.size() != columns_)
        lines_.fail(fmt::format("an atom of {}, but {} named", counted(fields.size(), "column"),
                                columns_ == 1 ? "1 is" : fmt::format("{} are", columns_)));
      add(fields);
    }
    beads_.about().boxes.push_back(box_);
    beads_.end_frame();
    in_header_ = has_step_ = has_box_ = false;
    box_ = {};  // the next frame's is its own
  }

  void find_columns() {
    std::vector<std::string> names;
    for (const auto name : lines_.fields()) names.emplace_back(name);
    names.erase(names.begin(), names.begin() + 2);
    columns_ = names.size();
    const auto column = [&](const char* name) {
      const auto found = std::ranges::find(names, name);
      if (found == names.end()) return none;
      if (std::ranges::count(names, name) > 1) lines_.fail(fmt::format("the column {} comes twice", name));
      return static_cast<std::size_t>(found - names.begin());
    };
    id_ = column("id"), molecule_ = column("mol"), radius_ = column("radius"), diameter_ = column("diameter");
    scaled_ = false;
    place_ = {none, none, none};
    for (const char* suffix : {"", "u", "s", "su"}) {
      const std::string end = suffix;
      const std::array<std::size_t, 3> here{column(("x" + end).c_str()), column(("y" + end).c_str()),
                                            column(("z" + end).c_str())};
      if (std::ranges::find(here, none) != here.end()) continue;
      place_ = here;
      scaled_ = end.starts_with('s');
      break;
    }
    if (id_ == none || place_[0] == none) lines_.fail("the columns lack id, or x y z (or xu, xs, xsu)");
    if (scaled_ && !has_box_)
      lines_.fail("scaled coordinates need their box; the frame has no 'ITEM: BOX BOUNDS'");
    if (const auto& boxes = beads_.about().boxes; !boxes.empty() && box_.repeats() != boxes.front().repeats())
      lines_.fail("this frame and the first differ in having a periodic box");
    const bool has_radii = radius_ != none || diameter_ != none;
    if (!beads_.about().boxes.empty() && has_radii != beads_.about().has_radii)
      lines_.fail("this frame and the first differ in having radii");
    beads_.about().has_radii = has_radii;
  }

  void add(const std::vector<std::string_view>& fields) {
    double x = lines_.coordinate(fields[place_[0]], "x"), y = lines_.coordinate(fields[place_[1]], "y"),
           z = lines_.coordinate(fields[place_[2]], "z");
    if (scaled_) {
      x = low_[0] + x * edge_.length[0] + y * edge_.xy + z * edge_.xz;
      y = low_[1] + y * edge_.length[1] + z * edge_.yz;
      z = low_[2] + z * edge_.length[2];
    }
    float radius = 0;
    if (radius_ != none) radius = lines_.radius(fields[radius_]);
    if (diameter_ != none) {
      const float half = lines_.half(fields[diameter_]);
      constexpr float rounding = 1e-4f;  // of what has five digits
      if (radius_ != none && std::abs(half - radius) > rounding * std::max(half, radius))
        lines_.fail(fmt::format("the radius {} is not half of the diameter {}; keep one of the two columns",
                                fields[radius_], fields[diameter_]));
      if (radius_ == none) radius = half;
    }
    beads_.add(lines_.integer(fields[id_], "id"), x, y, z, radius,
               molecule_ == none ? 0 : lines_.integer(fields[molecule_], "mol"));
  }

  void read_bonds() {
    LammpsData data(topology_);
    std::uint64_t bonds = 0;
    while (data.next_section())
      if (data.section() == "Bonds") bonds += data.read_bonds(beads_);
    data.require_bonds(bonds);
    if (bonds == 0)
      data.lines().fail("no LAMMPS data with a section Bonds; name one, or leave --topology out");
  }

  TextLines lines_;
  BeadFile beads_;
  std::string topology_;
  std::uint32_t atoms_ = 0;
  std::array<double, 3> low_{};
  PeriodicBox edge_, box_;  ///< of the frame; without and with what is not periodic left out
  std::size_t columns_ = 0, id_ = none, molecule_ = none, radius_ = none, diameter_ = none;
  std::array<std::size_t, 3> place_{};
  bool scaled_ = false;
  bool in_header_ = false, has_step_ = false, has_box_ = false;  ///< of the frame under way: what came of it
};

const RegisterReader registered{
    {"LAMMPS dump",
     {".dump", ".lammpstrj"},
     "atoms by id and column names, all frames; the box; bonds by --topology; radii where dumped",
     "atom id",
     {"--topology"}},
    read_by<LammpsDump>};

}  // namespace
}  // namespace catena
