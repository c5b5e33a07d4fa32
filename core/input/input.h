#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/input/thinned.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/readers/labels.h"
#include "catena/core/readers/read_options.h"
#include "catena/core/scenes/animation.h"

namespace catena {

/// Whether a box repeats space, and whose. `told`: the file's, where the file says that it is periodic.
enum class BoxFrom { told, file, options, none };

/// What a user may say of an input besides its name.
struct InputOptions {
  std::optional<float> radius{};          ///< for files without radii; refused for files that have them
  bool radius_half_spacing = false;       ///< for files without radii: half the median step along the strands
  bool closed = false;                    ///< every strand is closed
  std::optional<std::uint32_t> window{};  ///< index window instead of the input's own rule
  std::optional<double> arc_window{};     ///< arc-length window factor instead; excludes `window`
  BoxFrom box_from = BoxFrom::told;
  PeriodicBox box{};                  ///< BoxFrom::options
  std::optional<double> tolerance{};  ///< leave out spheres that the tube does not need; see thin
  bool takes_box = false;             ///< of the caller: Input::boxes will be heeded
  bool centres_only = false;          ///< of the caller: radii do not matter; those that a file lacks are 0
  ReadOptions reading{};              ///< for files: how they are read
};

/// A scene or a file, opened.
struct Input {
  std::string name;  ///< as the user wrote it
  std::unique_ptr<Animation> animation;
  std::vector<std::string> warnings;  ///< what a reader had to assume, one line each, without the name
  std::vector<Pair> joints;           ///< of the file, see CurveFile; a scene has none
  Labels labels;                      ///< of the spheres in the user's file; a scene's have none
  double rounding = 0;                ///< the most that a coordinate of the file lost in binary32
  std::optional<Thinning> thinning;   ///< where a tolerance was given; everything else is of what is kept
  std::vector<PeriodicBox> boxes;     ///< that repeat space (see Periodic): one a frame, one for all, or none
};

/// Opens "scene:key=value,..." or a file by its extension. A file that exists wins over a scene of that name.
/// Throws InputError: unknown scene, unknown extension, unreadable file (with file, line and reason), options
/// that do not fit the input.
Input open_input(const std::string& spec, const InputOptions& options = {});

/// Throws what open_input throws of any of several, so that a name that is misspelt does not end the work on
/// those before it. Files are read, and read again when their turn comes; standard input, which is there
/// once, is not looked at.
void check_inputs(const std::vector<std::string>& specs, const InputOptions& options = {});

}  // namespace catena
