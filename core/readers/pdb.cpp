#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/pdb_atom.h"
#include "catena/core/readers/pdb_trace.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Proteins and nucleic acids of the PDB format: a trace of one atom a residue, in Angstrom, without radii;
/// see PdbTracer. Models are frames.
namespace catena {
namespace {

bool same_atoms(const PdbTrace& a, const PdbTrace& b) {
  return std::ranges::equal(a.points, b.points, {}, &PdbTrace::Point::label, &PdbTrace::Point::label);
}

class Polymers {
 public:
  Polymers(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), atom_(options.atom), curves_(options), tracer_(atom_, polymer_residues_) {}

  CurveFile curves() {
    read_sequence();
    while (lines_.next() && !over_) {
      const std::string_view record = trimmed(pdb_columns(lines_.line(), 1, 6));
      if (record == "TER") tracer_.end_chain();
      if (record == "ATOM" || record == "HETATM") tracer_.add(parse_pdb_atom(lines_));
      if (record == "MODEL" || record == "ENDMDL" || record == "END") end_model();
    }
    end_model();
    if (first_.points.empty())
      lines_.fail(atom_.empty()
                      ? "the file ends without a C-alpha of a protein or a P of a nucleic acid"
                      : fmt::format("the file ends without an atom {} of a polymer", in_quotes(atom_)));
    return std::move(curves_);
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

  void end_model() {
    PdbTrace trace = tracer_.finish();
    if (trace.points.empty()) return;
    if (first_.points.empty()) {
      first_ = std::move(trace);
      take_first();
    } else if (same_atoms(first_, trace)) {
      curves_.begin_later_frame();
      for (const auto& point : trace.points) curves_.add_point(point.x, point.y, point.z);
    } else {
      over_ = true;
      curves_.warnings.push_back(fmt::format(
          "line {}: the model that ends here is not of the same atoms as the first; it and what follows are "
          "not read",
          lines_.line_number()));
    }
  }

  void take_first() {
    for (const auto& point : first_.points) {
      if (point.starts_strand) {
        curves_.end_strand();
        curves_.labels.strand_names.push_back(point.chain);
      }
      curves_.labels.add(std::string_view(point.label));
      curves_.add_point(point.x, point.y, point.z);
    }
    curves_.end_strand();
    say(first_.breaks, "step longer than a bond is a break", "steps longer than a bond are breaks");
    const std::string atom = atom_.empty() ? "C-alpha or P" : in_quotes(atom_);
    say(first_.without_atom, "residue without " + atom + " is left out",
        "residues without " + atom + " are left out");
    say(first_.hetero, "HETATM residue is left out, as it is not of a chain",
        "HETATM residues are left out, as they are not of a chain");
  }

  void say(const PdbTrace::Note& note, const std::string& one, const std::string& many) {
    if (note.times == 0) return;
    curves_.warnings.push_back(fmt::format("{} {}: {}{}", note.times, note.times == 1 ? one : many,
                                           note.first, note.times == 1 ? "" : ", ..."));
  }

  TextLines lines_;
  std::string atom_;
  CurveFile curves_;
  std::set<std::string, std::less<>> polymer_residues_;
  PdbTracer tracer_;
  PdbTrace first_;
  bool over_ = false;
};

const RegisterReader registered{{"PDB polymer",
                                 {".pdb", ".ent"},
                                 "C-alpha or P trace, or --atom NAME; models are frames; no radii",
                                 "chain/residue/atom",
                                 {"--atom"}},
                                read_by<Polymers>};

}  // namespace
}  // namespace catena
