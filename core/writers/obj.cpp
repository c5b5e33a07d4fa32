#include <fmt/format.h>

#include <string>

#include "catena/core/output_file.h"
#include "catena/core/writers/point_row.h"
#include "catena/core/writers/strand_cell.h"
#include "catena/core/writers/writer.h"

/// Wavefront OBJ: vertices, and a line element for each strand, which ends where it starts when the strand is
/// closed; a strand of one sphere is a point element.
namespace catena {
namespace {

void write_obj(const std::filesystem::path& name, const ExportedFrames& frames) {
  const Chain chain = frames.at(frames.first).chain;
  OutputFile file(name);
  std::string line;
  for (const Sphere& sphere : chain.spheres()) {
    line = "v ";
    append_point(line, sphere, ' ');
    file.write(line += '\n');
  }
  for (std::uint32_t s = 0; s < chain.strand_count(); ++s) {
    const auto cell = strand_cell(chain, s);
    if (cell.empty()) continue;
    line.assign(1, cell.size() == 1 ? 'p' : 'l');
    for (const std::uint32_t i : cell) line += fmt::format(" {}", i + 1);
    file.write(line += '\n');
  }
  file.close();
}

const RegisterWriter registered{{.name = "OBJ lines",
                                 .extensions = {".obj"},
                                 .radii = false,
                                 .rule = false,
                                 .frames = false,
                                 .contacts = false,
                                 .box = false,
                                 .summary = "vertices and a line for each strand, exactly, without radii",
                                 .lines = true},
                                write_obj};

}  // namespace
}  // namespace catena
