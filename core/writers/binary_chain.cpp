#include "catena/core/readers/binary_chain.h"

#include <cstring>

#include "catena/core/output_file.h"
#include "catena/core/writers/writer.h"

namespace catena {
namespace {

template <class Value>
void write_array(OutputFile& file, std::span<const Value> values) {
  file.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

void write_binary(const std::filesystem::path& name, const Chain& shown) {
  // Not those of a rest shape: a reader measures the spheres that are written.
  const Chain chain({shown.spheres().begin(), shown.spheres().end()}, shown.strands(), shown.exclusion());
  const Exclusion& exclusion = chain.exclusion();
  const bool arcs = exclusion.rule == Exclusion::Rule::arc_window;
  const ExclusionView view = chain.view().exclusion;
  BinaryChain::Header header{{}, chain.size(), chain.strand_count(), exclusion.extra_pairs.size(), arcs, exclusion.window,
                             exclusion.factor, 0};
  std::memcpy(header.magic, BinaryChain::magic, sizeof header.magic);
  OutputFile file(name);
  write_array(file, std::span<const BinaryChain::Header>(&header, 1));
  write_array(file, chain.spheres());
  for (std::uint32_t s = 0; s < chain.strand_count(); ++s) {
    const bool closed = chain.strands().closed[s] != 0;
    const BinaryChain::Strand strand{chain.strands().first[s], closed, arcs && closed ? view.loop_length[s] : 0};
    write_array(file, std::span<const BinaryChain::Strand>(&strand, 1));
  }
  for (const Pair& pair : exclusion.extra_pairs) {
    const BinaryChain::Neighbours neighbours{pair.i, pair.j};
    write_array(file, std::span<const BinaryChain::Neighbours>(&neighbours, 1));
  }
  if (arcs) write_array(file, std::span<const double>(view.arc, chain.size()));
  file.close();
}

const RegisterWriter registered{{.name = "catena binary",
                                 .extensions = {".catena"},
                                 .radii = true,
                                 .rule = true,
                                 .frames = false,
                                 .contacts = false,
                                 .box = false,
                                 .summary = "catena's own arrays, of which ranks read a part each"},
                                [](const std::filesystem::path& file, const ExportedFrames& frames) {
                                  write_binary(file, frames.at(frames.first).chain);
                                }};

}  // namespace
}  // namespace catena
