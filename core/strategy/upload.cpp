#include "catena/core/strategy/upload.h"

#include <fmt/format.h>

#include <utility>

#include "catena/core/counted.h"
#include "catena/core/strategy/step_names.h"

namespace catena {

std::vector<ParameterInfo> with_upload(std::vector<ParameterInfo> own) {
  own.push_back(
      {"upload", "changed", "what is moved to the device of a chain that lies there: what changed, or all"});
  own.push_back(strands_parameter());
  return own;
}

Upload::Upload(const Parameters& parameters)
    : strands_(parameters), all_(parameters.choice("upload", {"changed", "all"}) == "all") {}

ChainView Upload::run(Device& device, const ChainView& chain, const Moved& moved) {
  const std::uint64_t lay = std::exchange(topology_, 0);
  known_ = false;
  ChainView asked = strands_.seen(chain);
  if (all_) asked.topology = 0;  // which no device takes for one that it has
  const ChainView view = device.to_device(asked, all_ ? Moved() : moved);
  topology_ = chain.topology;
  known_ = lay != 0 && lay == chain.topology && !all_;
  spheres_ = moved_ = chain.size;
  if (known_ && !moved.everything()) {
    moved_ = 0;
    for (const SphereRange& range : moved.ranges()) moved_ += range.within(chain.size).size();
  }
  return view;
}

Plan Upload::told() const {
  Decision move{upload_step, known_,
                all_ ? "all is moved all the same" : "no frame of the same chain lay there"};
  if (known_) {
    move.reason = fmt::format("strands and neighbours lay there, and {} of {} moved", moved_,
                              counted(spheres_, "sphere"));
    move.removed = fmt::format("{} bytes of spheres", std::uint64_t{spheres_ - moved_} * sizeof(Sphere));
  }
  return {std::move(move), strands_.told()};
}

}  // namespace catena
