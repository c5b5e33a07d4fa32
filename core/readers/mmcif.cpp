#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/pdb_models.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Proteins and nucleic acids of the mmCIF format, https://mmcif.wwpdb.org: the rows of the table _atom_site,
/// of which the same is taken as of a .pdb file. Chains and residues have the names of the authors, as there.
/// Which residues are of a polymer _entity_poly_seq says; where the label of a chain changes, it has ended,
/// unless an ATOM of that label follows what stands between.
namespace catena {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Keywords and names have no case.
bool is_loop(std::string_view line) { return line.size() == 5 && lower_case(line) == "loop_"; }

class CifTables {
 public:
  explicit CifTables(const std::filesystem::path& file) : lines_(file) {}

  TextLines& lines() { return lines_; }
  const TextLines& lines() const { return lines_; }

  void return_to(const TextLines::Mark& mark) {
    lines_.return_to(mark);
    at_loop_ = false;
  }

  /// Goes to the next table of this category, in lower case; false when there is none.
  bool find(std::string_view category) {
    names_.clear();
    while (std::exchange(at_loop_, false) || lines_.next()) {
      const std::string_view line = trimmed(lines_.line());
      if (lines_.line().starts_with(';')) skip_text();
      if (!is_loop(line)) continue;
      while (lines_.next() && trimmed(lines_.line()).starts_with('_')) {
        const std::string name = lower_case(lines_.fields()[0]);
        if (name.starts_with(category) && name.substr(category.size()).starts_with('.'))
          names_.emplace_back(name.substr(category.size() + 1));
      }
      fresh_ = true;
      if (!names_.empty()) return true;
    }
    return false;
  }

  std::optional<std::size_t> column(std::string_view name) const {
    const auto found = std::ranges::find(names_, lower_case(name));
    if (found == names_.end()) return {};
    if (std::ranges::count(names_, *found) > 1) lines_.fail(fmt::format("the column {} comes twice", name));
    return static_cast<std::size_t>(found - names_.begin());
  }

  /// The next row; empty at the table's end. A row may take several lines.
  const std::vector<std::string_view>& next_row() {
    row_.clear();
    kept_.clear();
    while (row_.size() < names_.size()) {
      keep_words();
      if (!fresh_ && !lines_.next()) break;
      fresh_ = false;
      const std::string_view line = trimmed(lines_.line());
      if (line.empty()) continue;
      if (row_.empty() && (line[0] == '#' || line[0] == '_' || is_loop(line) || line.starts_with("data_"))) {
        at_loop_ = is_loop(line);
        return row_;
      }
      if (line[0] == ';') lines_.fail("a text of several lines where a word is due");
      add_words(line);
    }
    if (!row_.empty() && row_.size() != names_.size())
      lines_.fail(fmt::format("the row has {}, the table {}", counted(row_.size(), "word"),
                              counted(names_.size(), "column")));
    return row_;
  }

 private:
  // Of a row that goes on, as a line's text may be gone when the next is read.
  void keep_words() {
    for (std::size_t k = kept_.size(); k < row_.size(); ++k) row_[k] = kept_.emplace_back(row_[k]);
  }

  void skip_text() {
    while (lines_.next() && !lines_.line().starts_with(';')) {
    }
  }

  // A quoted word ends at a quote before a blank, so that O5' may be written "O5'".
  void add_words(std::string_view line) {
    for (std::size_t at = 0; at < line.size() && line[at] != '#';) {
      const char quote = line[at];
      std::size_t end = at + 1;
      if (quote == '\'' || quote == '"') {
        while (end < line.size() &&
               (line[end] != quote || (end + 1 < line.size() && !is_blank(line[end + 1]))))
          ++end;
        if (end == line.size()) lines_.fail("a quote is not closed");
        row_.push_back(line.substr(at + 1, end - at - 1));
        ++end;
      } else {
        while (end < line.size() && !is_blank(line[end])) ++end;
        row_.push_back(line.substr(at, end - at));
      }
      for (at = end; at < line.size() && is_blank(line[at]);) ++at;
    }
  }

  TextLines lines_;
  std::vector<std::string> names_;
  std::vector<std::string_view> row_;
  std::deque<std::string> kept_;  ///< the first words of the row, which views name
  bool fresh_ = false;            ///< the current line is the first of the table's rows
  bool at_loop_ = false;          ///< it is that of the table behind this one
};

class Mmcif {
 public:
  Mmcif(const std::filesystem::path& file, const ReadOptions& options)
      : tables_(file), models_(options, polymer_residues_) {}

  CurveFile curves() {
    const auto start = tables_.lines().mark();
    if (tables_.find("_entity_poly_seq")) read_sequence();
    tables_.return_to(start);
    tables_.lines().read_once();
    if (!tables_.find("_atom_site")) tables_.lines().fail("the file has no table _atom_site");
    read_atoms();
    models_.end_model(tables_.lines());
    CurveFile curves = models_.curves(tables_.lines());
    if (!models_.over() && tables_.find("_atom_site"))
      curves.warnings.push_back(
          fmt::format("line {}: a second table _atom_site is not read", tables_.lines().line_number()));
    return curves;
  }

 private:
  void read_sequence() {
    const auto name = tables_.column("mon_id");
    for (;;) {
      const auto& row = tables_.next_row();
      if (row.empty() || !name) return;
      polymer_residues_.emplace(row[*name]);
    }
  }

  void read_atoms() {
    find_columns();
    std::string model, label;  // of the row before
    std::string chain;         // the label of the last ATOM: behind a ligand it may go on
    for (bool first = true;; first = false) {
      const auto& row = tables_.next_row();
      if (row.empty() || models_.over()) return;
      const std::string_view model_here = model_ ? row[*model_] : "1", label_here = row[label_];
      if (!first && model_here != model) models_.end_model(tables_.lines());
      if (!first && model_here == model && label_here != label)
        label_here == chain ? models_.go_on() : models_.end_chain();
      model = model_here, label = label_here;
      if (row[group_] == "ATOM") chain = label;
      models_.add(atom_of(row));
    }
  }

  void find_columns() {
    const auto either = [&](const char* first, const char* second) {
      const auto found = tables_.column(first);
      if (found) return *found;
      if (const auto other = tables_.column(second)) return *other;
      tables_.lines().fail(fmt::format("the table _atom_site has no column {}", first));
    };
    group_ = either("group_PDB", "group_PDB"), name_ = either("auth_atom_id", "label_atom_id");
    residue_ = either("auth_comp_id", "label_comp_id"), chain_ = either("auth_asym_id", "label_asym_id");
    label_ = either("label_asym_id", "auth_asym_id"), number_ = either("auth_seq_id", "label_seq_id");
    place_ = {either("Cartn_x", "Cartn_x"), either("Cartn_y", "Cartn_y"), either("Cartn_z", "Cartn_z")};
    element_ = tables_.column("type_symbol"), alternate_ = tables_.column("label_alt_id");
    insertion_ = tables_.column("pdbx_PDB_ins_code"), occupancy_ = tables_.column("occupancy");
    model_ = tables_.column("pdbx_PDB_model_num");
  }

  PdbAtom atom_of(const std::vector<std::string_view>& row) const {
    // A question mark or a point: not known, not applicable.
    const auto letter = [&](const std::optional<std::size_t>& column) {
      return !column || row[*column].empty() || row[*column] == "?" || row[*column] == "." ? ' '
                                                                                           : row[*column][0];
    };
    const TextLines& lines = tables_.lines();
    PdbAtom atom{};
    atom.hetero = row[group_] == "HETATM";
    atom.name = row[name_];
    atom.alternate = letter(alternate_);
    atom.residue = row[residue_], atom.chain = row[chain_], atom.number = row[number_];
    atom.insertion = letter(insertion_);
    atom.x = lines.coordinate(row[place_[0]], "Cartn_x");
    atom.y = lines.coordinate(row[place_[1]], "Cartn_y");
    atom.z = lines.coordinate(row[place_[2]], "Cartn_z");
    atom.occupancy = letter(occupancy_) == ' ' ? 1 : lines.wide_real(row[*occupancy_], "occupancy");
    atom.calcium = atom.name == "CA" && element_ && lower_case(row[*element_]) == "ca";
    return atom;
  }

  CifTables tables_;
  std::set<std::string, std::less<>> polymer_residues_;
  PdbModels models_;
  std::size_t group_ = 0, name_ = 0, residue_ = 0, chain_ = 0, label_ = 0, number_ = 0;
  std::array<std::size_t, 3> place_{};
  std::optional<std::size_t> element_, alternate_, insertion_, occupancy_, model_;
};

const RegisterReader registered{
    {"mmCIF polymer",
     {".cif", ".mmcif"},
     "C-alpha or P trace, or --atom NAME, as of .pdb; models are frames; no radii",
     "chain/residue/atom",
     {"--atom"}},
    read_by<Mmcif>};

}  // namespace
}  // namespace catena
