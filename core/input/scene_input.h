#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "catena/core/scenes/animation.h"
#include "catena/core/input/input.h"

namespace catena {

/// Opens "name" or "name:key=value,..." from the scenes. One key is understood here, whatever the scene:
/// frame=F restricts the animation to that frame. A window of the options replaces the scene's own rule;
/// strands and extra pairs stay. Throws InputError: what SceneRegistry::open throws, a frame that is not
/// there, options for files.
std::unique_ptr<Animation> open_scene(const std::string& spec, const InputOptions& options);

/// The F of frame=F in the name of a scene, which is then all of its animation; 0 where there is none.
std::uint32_t written_frame(const std::string& spec);

/// The name in front of the colon.
std::string scene_name(const std::string& spec);

}  // namespace catena
