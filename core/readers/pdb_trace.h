#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/readers/labels.h"
#include "catena/core/readers/pdb_atom.h"

namespace catena {

/// One model of a PDB file as a trace: an atom for each residue of its polymers.
struct PdbTrace {
  struct Point {
    double x, y, z;
    bool starts_strand;
  };
  std::vector<Point> points;
  Labels labels;  ///< of the points, chain/residue/atom: "A/MSE151/CA"; the strands have the names of their
                  ///< chains

  /// What was left out, or is a break: how many, and the first.
  struct Note {
    std::size_t times = 0;
    std::string first;
    void add(std::string what) {
      if (times++ == 0) first = std::move(what);
    }
  };
  Note breaks;        ///< steps longer than a bond can be
  Note parted;        ///< strands of chains that went on behind another chain
  Note without_atom;  ///< residues of a polymer that lack the atom
  Note hetero;        ///< HETATM residues that have the atom, but are not of the chain
};

/// Makes a trace of the atoms of a model, in their order.
///
/// The atom of a residue is its C-alpha, or else the P of a nucleotide; or the one the user names. Of
/// alternate locations the one of the best occupancy counts, the first of equals. HETATM residues are of the
/// chain when the chain was not ended by TER, and SEQRES or MODRES names them or they have the polymer's
/// other atoms.
class PdbTracer {
 public:
  /// `atom`: the user's, or empty. `polymer_residues`: names in SEQRES and MODRES.
  PdbTracer(std::string_view atom, const std::set<std::string, std::less<>>& polymer_residues)
      : wanted_(atom), polymer_residues_(polymer_residues) {}

  void add(PdbAtom atom);
  void end_chain();   ///< TER
  void go_on();       ///< after end_chain: the chain of the last point was not at its end
  PdbTrace finish();  ///< at the end of the model; the next one begins

 private:
  void end_residue();
  const PdbAtom* atom_named(std::string_view name) const;  ///< of the residue, the best occupied
  const PdbAtom* chosen();
  void add_point(const PdbAtom& atom);

  std::string_view wanted_;
  const std::set<std::string, std::less<>>& polymer_residues_;
  PdbTrace trace_;
  std::vector<PdbAtom> residue_;  ///< under way
  bool continues_ = false;        ///< the next point may be of the strand of the last
  PdbAtom last_atom_{};
  std::string label_;                          ///< under way
  std::set<std::string, std::less<>> ended_;   ///< chains that a TER has ended
  std::set<std::string, std::less<>> traced_;  ///< chains that have points
};

}  // namespace catena
