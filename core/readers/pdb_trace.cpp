#include "catena/core/readers/pdb_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace catena {
namespace {

/// A longer step is a residue that the experiment did not see, in Angstrom: C-alphas are 3.8 apart when
/// bonded, and six bonds in a row of a nucleotide's backbone reach no further than 8. None is known of other
/// atoms.
double longest_step(std::string_view atom) {
  return atom == "CA" ? 4.5 : atom == "P" ? 8 : std::numeric_limits<double>::infinity();
}

/// A chain's letter, or its segment where it has none.
std::string_view chain_of(const PdbAtom& atom) { return atom.chain.empty() ? atom.segment : atom.chain; }

void append_residue(std::string& text, const PdbAtom& atom) {
  text += chain_of(atom);
  text += '/';
  text += atom.residue;
  text += atom.number;
  if (atom.insertion != ' ') text += atom.insertion;
}

void append_label(std::string& text, const PdbAtom& atom) {
  append_residue(text, atom);
  text += '/';
  text += atom.name;
}

std::string residue_name(const PdbAtom& atom) {
  std::string text;
  append_residue(text, atom);
  return text;
}

std::string label_of(const PdbAtom& atom) {
  std::string text;
  append_label(text, atom);
  return text;
}

}  // namespace

void PdbTracer::add(PdbAtom atom) {
  // Where two atoms are no alternatives of each other, numbers of residues are used twice.
  const auto repeats = [&](const PdbAtom& other) {
    const bool alternates = other.alternate != ' ' && atom.alternate != ' ';
    if (other.residue != atom.residue) return !alternates;
    return other.name == atom.name && (!alternates || other.alternate == atom.alternate);
  };
  if (!residue_.empty() && (!residue_.front().same_residue(atom) || std::ranges::any_of(residue_, repeats)))
    end_residue();
  residue_.push_back(std::move(atom));
}

void PdbTracer::end_chain() {
  end_residue();
  if (continues_) ended_.emplace(chain_of(last_atom_));
  continues_ = false;
}

void PdbTracer::go_on() {
  end_residue();
  continues_ = !trace_.points.empty();
  if (!continues_) return;
  if (const auto ended = ended_.find(chain_of(last_atom_)); ended != ended_.end()) ended_.erase(ended);
}

PdbTrace PdbTracer::finish() {
  end_residue();
  continues_ = false;
  ended_.clear(), traced_.clear();
  return std::exchange(trace_, {});
}

const PdbAtom* PdbTracer::atom_named(std::string_view name) const {
  const PdbAtom* best = nullptr;
  for (const PdbAtom& atom : residue_)
    if (atom.name == name && !atom.calcium && (best == nullptr || atom.occupancy > best->occupancy))
      best = &atom;
  return best;
}

const PdbAtom* PdbTracer::chosen() {
  const auto of_polymer = [&] {
    return (atom_named("N") && atom_named("C")) || atom_named("C1'") || atom_named("C1*");
  };
  const PdbAtom* atom = wanted_.empty() ? atom_named("CA") : atom_named(wanted_);
  if (atom == nullptr && wanted_.empty()) atom = atom_named("P");
  const bool hetero = residue_.front().hetero;
  if (atom != nullptr && !hetero) return atom;
  const bool ended = hetero && ended_.contains(chain_of(residue_.front()));
  if (atom == nullptr) {
    if (!ended && of_polymer()) trace_.without_atom.add(residue_name(residue_.front()));
    return nullptr;
  }
  const bool listed = atom->residue == "MSE" || polymer_residues_.contains(atom->residue);
  if (!ended && (listed || of_polymer())) return atom;
  if (!ended && atom->name != "P") trace_.hetero.add(residue_name(*atom));  // a P alone is a phosphate
  return nullptr;
}

void PdbTracer::end_residue() {
  if (residue_.empty()) return;
  if (const PdbAtom* atom = chosen()) add_point(*atom);
  residue_.clear();
}

void PdbTracer::add_point(const PdbAtom& atom) {
  bool behind_ter = false;
  if (const auto ended = ended_.find(chain_of(atom)); ended != ended_.end())
    ended_.erase(ended), behind_ter = true;  // a TER in a chain that goes on, or another of its letter
  bool starts = !continues_ || chain_of(atom) != chain_of(last_atom_);
  if (!starts) {
    const double step = std::hypot(atom.x - last_atom_.x, atom.y - last_atom_.y, atom.z - last_atom_.z);
    starts = step > std::max(longest_step(atom.name), longest_step(last_atom_.name));
    if (starts)
      trace_.breaks.add(fmt::format("{} to {}, {:.1f} Angstrom", label_of(last_atom_), label_of(atom), step));
  }
  if (starts) trace_.labels.strand_names.emplace_back(chain_of(atom));
  const bool comes_again = starts && !traced_.emplace(chain_of(atom)).second;
  if (comes_again && !behind_ter && chain_of(atom) != chain_of(last_atom_)) trace_.parted.add(label_of(atom));
  label_.clear();
  append_label(label_, atom);
  trace_.labels.add(std::string_view(label_));
  trace_.points.push_back({atom.x, atom.y, atom.z, starts});
  last_atom_ = atom;
  continues_ = true;
}

}  // namespace catena
