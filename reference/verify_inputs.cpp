#include "catena/reference/verify_inputs.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "catena/core/installed_files.h"
#include "catena/core/readers/reader.h"
#include "catena/core/scenes/scene.h"

namespace catena::reference {
namespace {

std::vector<std::string> sample_files() {
  std::vector<std::string> files;
  for (const auto& folder :
       {installed_files() / "examples", std::filesystem::path(CATENA_EXAMPLES_IN_SOURCE)}) {
    std::error_code absent;  // a program that was only installed has no source tree, and the other way round
    for (const auto& entry : std::filesystem::directory_iterator(folder, absent))
      if (ReaderRegistry::instance().knows(entry.path())) files.push_back(entry.path().string());
    if (!files.empty()) break;
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

std::vector<std::string> default_inputs() {
  const auto& scenes = SceneRegistry::instance();
  std::vector<std::string> inputs;
  // 1,500 spheres: short enough for bGPU2's one block.
  for (const auto& scene : scenes.scenes()) inputs.push_back(scene.name + ":n=1500");
  for (const std::string extreme :
       {"coil:n=1500,offset=1e6", "coil:n=1500,scale=1e-25", "rod:n=1500,scale=1e30"})
    if (scenes.contains(extreme.substr(0, extreme.find(':')))) inputs.push_back(extreme);
  std::ranges::copy(sample_files(), std::back_inserter(inputs));
  return inputs;
}

Input open_for_verification(const std::string& spec, InputOptions options, bool sample) {
  const auto& readers = ReaderRegistry::instance();
  std::error_code unknown;
  if (sample && !options.radius && std::filesystem::is_regular_file(spec, unknown) && readers.knows(spec))
    options.radius_half_spacing = !readers.read(spec, options.reading).has_radii;
  return open_input(spec, options);
}

}  // namespace catena::reference
