#include <fmt/format.h>

#include <string>
#include <vector>

#include "catena/core/output_file.h"
#include "catena/core/periodic/overlap.h"
#include "catena/core/writers/point_row.h"
#include "catena/core/writers/strand_cell.h"
#include "catena/core/writers/writer.h"

/// VTK XML poly-data as ASCII, floats by their shortest exact text. A strand is a line, which ends where it
/// starts when the strand is closed; a strand of one sphere is a vertex. Point data: radius, strand, and of
/// what was found the number of collisions, the sphere that is overlapped deepest (-1: none), and how deep.
namespace catena {
namespace {

class Vtp {
 public:
  explicit Vtp(const std::filesystem::path& name) : file_(name) {}

  void write(const ExportedFrame& frame) {
    const Chain& chain = frame.chain;
    std::vector<std::vector<std::uint32_t>> lines, vertices;
    for (std::uint32_t s = 0; s < chain.strand_count(); ++s)
      if (auto cell = strand_cell(chain, s); !cell.empty())
        (cell.size() == 1 ? vertices : lines).push_back(std::move(cell));
    file_.write(
        fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
                    "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
                    "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
                    "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                    chain.size(), vertices.size(), lines.size()));
    file_.write("<PointData Scalars=\"radius\">\n");
    array("Float32", "radius", chain.size(), [&](std::uint32_t i) { return chain[i].radius; });
    write_strands(chain);
    if (frame.found != nullptr) write_found(frame);
    file_.write(
        "</PointData>\n<Points>\n<DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" "
        "format=\"ascii\">\n");
    std::string line;
    for (const Sphere& sphere : chain.spheres()) {
      line.clear();
      append_point(line, sphere, ' ');
      file_.write(line += '\n');
    }
    file_.write("</DataArray>\n</Points>\n");
    write_cells("Verts", vertices);
    write_cells("Lines", lines);
    file_.write("</Piece>\n</PolyData>\n</VTKFile>\n");
    file_.close();
  }

 private:
  /// value(i) for each i below n, a line each.
  template <class Value>
  void array(const char* type, const char* name, std::size_t n, const Value& value) {
    file_.write(fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n", type, name));
    std::string line;
    for (std::size_t i = 0; i < n; ++i) {
      line.clear();
      append_shortest(line, value(static_cast<std::uint32_t>(i)));
      file_.write(line += '\n');
    }
    file_.write("</DataArray>\n");
  }

  void write_strands(const Chain& chain) {
    std::uint32_t strand = 0;
    array("Int32", "strand", chain.size(), [&](std::uint32_t i) {
      while (chain.strands().first[strand + 1] <= i) ++strand;
      return strand;
    });
  }

  void write_found(const ExportedFrame& frame) {
    const Chain& chain = frame.chain;
    const Collisions& found = *frame.found;
    std::vector<std::int64_t> partner(chain.size(), -1);
    std::vector<double> depth(chain.size(), 0);
    for (const Pair& p : found.pairs) {
      const double deep = overlap_of(chain[p.i], chain[p.j], frame.box).depth;
      for (const auto& [from, to] : {std::pair(p.i, p.j), std::pair(p.j, p.i)})
        // Of two equally deep the one of the lower number, whatever order a variant found them in.
        if (partner[from] < 0 || deep > depth[from] || (deep == depth[from] && to < partner[from]))
          partner[from] = to, depth[from] = deep;
    }
    array("UInt32", "collisions", chain.size(), [&](std::uint32_t i) { return found.count[i]; });
    array("Int64", "contact", chain.size(), [&](std::uint32_t i) { return partner[i]; });
    array("Float64", "depth", chain.size(), [&](std::uint32_t i) { return depth[i]; });
  }

  void write_cells(const char* kind, const std::vector<std::vector<std::uint32_t>>& cells) {
    file_.write(
        fmt::format("<{}>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n", kind));
    std::string line;
    for (const auto& cell : cells) {
      line.clear();
      for (const std::uint32_t i : cell) append_shortest(line, i), line += ' ';
      line.back() = '\n';
      file_.write(line);
    }
    file_.write("</DataArray>\n");
    std::size_t end = 0;
    array("Int64", "offsets", cells.size(), [&](std::uint32_t c) { return end += cells[c].size(); });
    file_.write(fmt::format("</{}>\n", kind));
  }

  OutputFile file_;
};

const RegisterWriter registered{{.name = "VTK XML poly-data",
                                 .extensions = {".vtp"},
                                 .radii = true,
                                 .rule = false,
                                 .frames = false,
                                 .contacts = true,
                                 .box = false,
                                 .summary = "lines with radius and strand, exactly; with --contacts what "
                                            "each sphere collides with, for ParaView",
                                 .lines = true},
                                [](const std::filesystem::path& file, const ExportedFrames& frames) {
                                  Vtp(file).write(frames.at(frames.first));
                                }};

}  // namespace
}  // namespace catena
