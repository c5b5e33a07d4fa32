#include <fmt/format.h>

#include <string>

#include "catena/core/output_file.h"
#include "catena/core/writers/point_row.h"
#include "catena/core/writers/writer.h"

/// Extended XYZ (OVITO, ASE), a frame after the other: species X, position, radius, strand number and whether
/// it is closed.
namespace catena {
namespace {

void write_xyz(const std::filesystem::path& name, const ExportedFrames& frames) {
  OutputFile file(name);
  for (std::uint32_t f = frames.first; f < frames.last; ++f) {
    const Chain chain = frames.at(f).chain;
    file.write(
        fmt::format("{}\nProperties=species:S:1:pos:R:3:radius:R:1:strand:I:1:closed:I:1\n", chain.size()));
    std::string line;
    for (std::uint32_t s = 0; s < chain.strand_count(); ++s)
      for (std::uint32_t i = chain.strands().first[s]; i < chain.strands().first[s + 1]; ++i) {
        line = "X ";
        append_point(line, chain[i], ' ');
        line += ' ';
        append_shortest(line, chain[i].radius);
        file.write(line += fmt::format(" {} {}\n", s, chain.strands().closed[s] ? 1 : 0));
      }
  }
  file.close();
}

const RegisterWriter registered{
    {.name = "extended XYZ",
     .extensions = {".xyz"},
     .radii = true,
     .rule = false,
     .frames = true,
     .contacts = false,
     .summary = "all frames in one file, exactly, with radius, strand and closed as properties"},
    write_xyz};

}  // namespace
}  // namespace catena
