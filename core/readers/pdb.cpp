#include <set>
#include <string>

#include "catena/core/readers/pdb_atom.h"
#include "catena/core/readers/pdb_models.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Proteins and nucleic acids of the PDB format: a trace of one atom a residue, in Angstrom, without radii;
/// see PdbTracer. Models are frames.
namespace catena {
namespace {

class Polymers {
 public:
  Polymers(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), models_(options, polymer_residues_) {}

  CurveFile curves() {
    read_sequence();
    lines_.read_once();
    bool due = false;  // the atoms of a model
    while (lines_.next() && !models_.over()) {
      const std::string_view record = trimmed(pdb_columns(lines_.line(), 1, 6));
      if (record == "TER") models_.end_chain();
      if (record == "ATOM" || record == "HETATM") models_.add(parse_pdb_atom(lines_));
      if (record == "MODEL" || record == "ENDMDL" || record == "END") models_.end_model(lines_);
      due = record == "MODEL" || (due && record != "ATOM" && record != "HETATM" && record != "ENDMDL");
    }
    if (due) lines_.fail("the file is truncated: it ends where the atoms of a model are due");
    models_.end_model(lines_);
    return models_.curves(lines_);
  }

 private:
  // First, as a residue of a later line of SEQRES or MODRES may come before it in a file without an order.
  void read_sequence() {
    const auto start = lines_.mark();
    while (lines_.next()) {
      const std::string_view record = trimmed(pdb_columns(lines_.line(), 1, 6));
      if (record == "MODRES") add_residue(13);
      if (record != "SEQRES") continue;
      for (std::size_t column = 20; column <= 68; column += 4) add_residue(column);
    }
    lines_.return_to(start);
  }

  void add_residue(std::size_t column) {
    const std::string_view name = trimmed(pdb_columns(lines_.line(), column, column + 2));
    if (!name.empty()) polymer_residues_.emplace(name);
  }

  TextLines lines_;
  std::set<std::string, std::less<>> polymer_residues_;
  PdbModels models_;
};

const RegisterReader registered{{"PDB polymer",
                                 {".pdb", ".ent"},
                                 "C-alpha or P trace, or --atom NAME; models are frames; no radii",
                                 "chain/residue/atom",
                                 {"--atom"}},
                                read_by<Polymers>};

}  // namespace
}  // namespace catena
