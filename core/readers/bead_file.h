#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/readers/reader.h"

namespace catena {

/// Beads of a simulation, known by their ids, which become spheres in the order of those. Strands run along
/// the bonds (see arrange_along_edges), and a bead without one is a strand of its own. Where no bond is told,
/// the beads of one molecule are tied in the order of their ids; where no molecule either, all are.
///
/// Memory: 8 bytes for a bead's id beside its sphere, 8 for its molecule where one is told, 8 for a bond.
class BeadFile {
 public:
  /// `file` is for errors.
  BeadFile(const ReadOptions& options, std::string file) : file_(std::move(file)), curves_(options) {}

  /// A bead of the frame under way; molecule 0: of none.
  void add(std::int64_t id, double x, double y, double z, float radius, std::int64_t molecule);
  /// The beads since the last call are a frame. Throws InputError for an id that comes twice, or another set
  /// of ids than that of the first frame. Other molecules than there are an error where no bond is told.
  void end_frame();
  /// A bond; of the beads of the first frame, once that has ended. The reason when it can be none, as it
  /// names a bead that is not there; empty when it is good.
  [[nodiscard]] std::string tie(std::int64_t a, std::int64_t b);
  void reserve(std::size_t beads, std::size_t bonds);

  CurveFile& about() { return curves_; }  ///< for radii, boxes and warnings

  /// Once. Throws InputError.
  CurveFile curves();

 private:
  /// None where there is no such bead.
  std::optional<std::uint32_t> place_of(std::int64_t id) const;
  std::vector<Pair> edges_without_bonds();
  void compare_molecules();

  std::string file_;
  CurveFile curves_;
  std::size_t frames_ = 0;
  std::vector<std::int64_t> ids_, molecules_;  ///< of the first frame; no molecules where all are 0
  std::vector<std::int64_t> later_ids_, later_molecules_;  ///< of the frame under way
  std::string other_molecules_;  ///< why molecules tell no strands: those of a later frame are others
  std::vector<Pair> bonds_;      ///< places of the first frame
};

}  // namespace catena
