#include "catena/core/readers/pdb_models.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/readers/file_bytes.h"

namespace catena {
void PdbModels::end_model(const TextLines& lines) {
  PdbTrace trace = tracer_.finish();
  if (trace.points.empty()) return;
  const bool first = curves_.spheres.empty();
  // A longer step in another model breaks no strand.
  if (!first) trace.labels.strand_names = curves_.labels.strand_names;
  if (first) {
    take_first(std::move(trace));
  } else if (trace.labels == curves_.labels) {
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
  if (curves_.spheres.empty())
    lines.fail(atom_.empty()
                   ? "the file ends without a C-alpha of a protein or a P of a nucleic acid"
                   : fmt::format("the file ends without an atom {} of a polymer", in_quotes(atom_)));
  return std::move(curves_);
}

void PdbModels::take_first(PdbTrace first) {
  for (const auto& point : first.points) {
    if (point.starts_strand) curves_.end_strand();
    curves_.add_point(point.x, point.y, point.z);
  }
  curves_.end_strand();
  curves_.labels = std::move(first.labels);
  say(first.breaks, "step longer than a bond is a break", "steps longer than a bond are breaks");
  say(first.parted, "part of a chain stands behind another chain, and is a strand of its own",
      "parts of chains stand behind other chains, and are strands of their own");
  const std::string atom = atom_.empty() ? "C-alpha or P" : in_quotes(atom_);
  say(first.without_atom, "residue without " + atom + " is left out",
      "residues without " + atom + " are left out");
  say(first.hetero, "HETATM residue is left out, as it is not of a chain",
      "HETATM residues are left out, as they are not of a chain");
}

void PdbModels::say(const PdbTrace::Note& note, const std::string& one, const std::string& many) {
  if (note.times == 0) return;
  curves_.warnings.push_back(fmt::format("{} {}: {}{}", note.times, note.times == 1 ? one : many, note.first,
                                         note.times == 1 ? "" : ", ..."));
}

}  // namespace catena
