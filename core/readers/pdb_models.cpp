#include "catena/core/readers/pdb_models.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/readers/file_bytes.h"

namespace catena {
namespace {

bool same_atoms(const PdbTrace& a, const PdbTrace& b) {
  return std::ranges::equal(a.points, b.points, {}, &PdbTrace::Point::label, &PdbTrace::Point::label);
}

}  // namespace

void PdbModels::end_model(const TextLines& lines) {
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
        lines.line_number()));
  }
}

CurveFile PdbModels::curves(const TextLines& lines) {
  if (first_.points.empty())
    lines.fail(atom_.empty()
                   ? "the file ends without a C-alpha of a protein or a P of a nucleic acid"
                   : fmt::format("the file ends without an atom {} of a polymer", in_quotes(atom_)));
  return std::move(curves_);
}

void PdbModels::take_first() {
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

void PdbModels::say(const PdbTrace::Note& note, const std::string& one, const std::string& many) {
  if (note.times == 0) return;
  curves_.warnings.push_back(fmt::format("{} {}: {}{}", note.times, note.times == 1 ? one : many, note.first,
                                         note.times == 1 ? "" : ", ..."));
}

}  // namespace catena
