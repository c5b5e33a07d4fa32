#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/periodic/periodic.h"
#include "catena/reference/reference.h"

namespace catena::bench {

/// What to measure on: a scene or file, its middle frame, where the most collides, or all of its frames.
struct WorkloadSpec {
  std::string input;        ///< "path1:n=10000", "neuron.swc"
  bool all_frames = false;  ///< a sample then goes through the whole animation
  /// What is said of the input besides; a box is heeded.
  InputOptions options = {.takes_box = true};
};

/// What a workload is called and how large it is, known before its chains are made.
struct WorkloadFacts {
  std::string label;         ///< how results name it: SCENE/n:N, see label_of
  std::uint64_t n = 0;       ///< spheres of a chain
  std::uint32_t frames = 1;  ///< of the input
  bool in_box = false;       ///< space repeats
};

/// Chains to measure on, with their exact answers.
struct Workload {
  std::string label;  ///< how results name it: SCENE/n:N, see label_of
  WorkloadSpec spec;
  std::uint32_t first_frame = 0;         ///< of the input; that of chains[0]
  std::uint32_t frames = 1;              ///< of the input
  std::vector<Chain> chains;             ///< one, or one for each frame
  std::vector<reference::Answer> exact;  ///< of each chain
  /// The frame before that of the only chain, or after it when that is the first: what chain it moves from.
  /// None when all frames are there, or the input has no other.
  std::optional<Chain> beside;
  /// Of the frames first_frame, ...; see Input::boxes. None: space does not repeat.
  std::vector<PeriodicBox> boxes;
  std::optional<PeriodicBox> box_beside;

  /// The box of one of the chains, or of the one beside; null without boxes.
  const PeriodicBox* box_of(const Chain& chain) const;
  /// A variant by its name, in the box of the first chain where there is one. Its build then puts the spheres
  /// into the box, makes their images at its faces and builds on both; its find decides what lies across a
  /// face exactly. So both are timed as they would be paid by a user, for whom each frame has other images
  /// (see Periodic).
  std::unique_ptr<Variant> make(const std::string& variant) const;
  /// The same, to be put into the boxes of other chains.
  std::unique_ptr<Variant> make(const std::string& variant, Periodic*& periodic) const;
};

/// SCENE/n:N. Parameters that are given besides n stay with the scene, "far:exponent=22/n:3000", as does
/// "frames=all"; of a file the name without its folder. What else is said of it follows, with the box in
/// which space repeats: "melt.data:radius=0.5,box=8x8x8/n:8"; "box=file" where the frames of a file have
/// different ones. Opens the input only when it does not say n.
std::string label_of(const WorkloadSpec& spec);

/// Throws InputError where two files have one name without their folders: their samples would be those of one
/// case, and their numbers of spheres points of one curve.
void require_names_apart(const std::vector<WorkloadSpec>& inputs);

/// Opens a file once; of a scene, whose frames are as many at every n, only the first of several that differ
/// in n alone. What had to be assumed of it is said on standard error, once. Throws what open_input throws,
/// and what check_box throws.
WorkloadFacts facts_of(const WorkloadSpec& spec);

/// An input of which more pairs collide than are compared with what a variant finds.
class TooManyPairs : public CapacityError {
 public:
  TooManyPairs(const std::string& label, const PairLimitExceeded& exceeded);
};

/// The chains and exact answers of `spec`. The last few workloads are kept, as making one takes longer than
/// measuring. Throws what open_input throws, and TooManyPairs.
std::shared_ptr<const Workload> workload(const WorkloadSpec& spec);

}  // namespace catena::bench
