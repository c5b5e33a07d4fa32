#include "catena/core/readers/chain_format.h"
#include "catena/core/writers/writer.h"

namespace catena {
namespace {

const RegisterWriter registered{{.name = "catena chain",
                                 .extensions = {".chain"},
                                 .radii = true,
                                 .rule = true,
                                 .frames = false,
                                 .contacts = false,
                                 .box = false,
                                 .summary = "catena's own text, everything exactly",
                                 .joints = true},
                                [](const std::filesystem::path& file, const ExportedFrames& frames) {
                                  write_chain(file, frames.at(frames.first).chain, frames.joints);
                                }};

}  // namespace
}  // namespace catena
