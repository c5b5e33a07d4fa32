#pragma once
#include <set>
#include <string>
#include <utility>

#include "catena/core/readers/pdb_trace.h"
#include "catena/core/readers/reader.h"

namespace catena {

/// The models of a file of atoms as frames: those of the same atoms as the first, up to one that has others.
/// What the first trace leaves out is said.
class PdbModels {
 public:
  /// `polymer_residues` as for PdbTracer.
  PdbModels(const ReadOptions& options, const std::set<std::string, std::less<>>& polymer_residues)
      : atom_(options.atom), curves_(options), tracer_(atom_, polymer_residues) {}
  PdbModels(const PdbModels&) = delete;
  PdbModels& operator=(const PdbModels&) = delete;

  void add(PdbAtom atom) { tracer_.add(std::move(atom)); }
  void end_chain() { tracer_.end_chain(); }
  void go_on() { tracer_.go_on(); }
  void end_model(const TextLines& lines);
  bool over() const { return over_; }  ///< nothing more is to be added

  /// Once, after the last end_model. Throws InputError at the current line when there is no point.
  CurveFile curves(const TextLines& lines);

 private:
  void take_first(PdbTrace first);
  void say(const PdbTrace::Note& note, const std::string& one, const std::string& many);

  std::string atom_;
  CurveFile curves_;
  PdbTracer tracer_;
  bool over_ = false;
};

}  // namespace catena
