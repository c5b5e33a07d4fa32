#include <fmt/format.h>

#include <string>

#include "catena/core/output_file.h"
#include "catena/core/writers/point_row.h"
#include "catena/core/writers/writer.h"

/// Extended XYZ (OVITO, ASE), a frame after the other: species X, position, radius, strand number and whether
/// it is closed; the periodic box as Lattice and pbc.
namespace catena {
namespace {

// An edge that does not repeat needs a length, too; where nothing repeats along it, any will do.
std::string lattice_of(const PeriodicBox& box) {
  const auto length = [&](std::size_t edge) { return box.length[edge] > 0 ? box.length[edge] : 1; };
  std::string text = "Lattice=\"";
  for (const double number : {length(0), 0.0, 0.0, box.xy, length(1), 0.0, box.xz, box.yz, length(2)}) {
    append_shortest(text, number);
    text += ' ';
  }
  text.back() = '"';
  const auto flag = [&](std::size_t edge) { return box.length[edge] > 0 ? 'T' : 'F'; };
  return text + fmt::format(" pbc=\"{} {} {}\" ", flag(0), flag(1), flag(2));
}

void write_xyz(const std::filesystem::path& name, const ExportedFrames& frames) {
  OutputFile file(name);
  for (std::uint32_t f = frames.first; f < frames.last; ++f) {
    const Chain chain = frames.at(f).chain;
    const auto& boxes = frames.boxes;
    file.write(fmt::format("{}\n{}Properties=species:S:1:pos:R:3:radius:R:1:strand:I:1:closed:I:1\n",
                           chain.size(), boxes.empty() ? "" : lattice_of(boxes[boxes.size() > f ? f : 0])));
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
     .box = true,
     .summary = "all frames in one file, exactly, with radius, strand and closed as properties"},
    write_xyz};

}  // namespace
}  // namespace catena
