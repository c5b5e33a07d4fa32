#include <set>
#include <string>

#include "catena/core/csv_cell.h"
#include "catena/core/output_file.h"
#include "catena/core/writers/point_row.h"
#include "catena/core/writers/writer.h"

/// A table with the columns strand, closed, x, y, z, r, and in front id where the spheres have labels.
/// Strands have the names of the file where these tell them apart, or else their numbers.
namespace catena {
namespace {

void write_csv(const std::filesystem::path& name, const ExportedFrames& frames) {
  const Chain chain = frames.at(frames.first).chain;
  const bool labelled = frames.labels.size() > 0;
  const auto& names = frames.labels.strand_names;
  const bool named = !names.empty() && std::set(names.begin(), names.end()).size() == names.size();
  OutputFile file(name);
  file.write(labelled ? "id,strand,closed,x,y,z,r\n" : "strand,closed,x,y,z,r\n");
  std::string line;
  for (std::uint32_t s = 0; s < chain.strand_count(); ++s)
    for (std::uint32_t i = chain.strands().first[s]; i < chain.strands().first[s + 1]; ++i) {
      line.clear();
      if (labelled) append_csv_cell(line, frames.labels.of(i)), line += ',';
      append_csv_cell(line, named ? names[s] : std::to_string(s));
      line += chain.strands().closed[s] ? ",1," : ",0,";
      append_point(line, chain[i], ',');
      line += ',';
      append_shortest(line, chain[i].radius);
      file.write(line += '\n');
    }
  file.close();
}

const RegisterWriter registered{
    {.name = "CSV table",
     .extensions = {".csv"},
     .radii = true,
     .rule = false,
     .frames = false,
     .contacts = false,
     .box = false,
     .labels = true,
     .summary = "a row a sphere, exactly: strand, closed, x, y, z, r, and id where there are labels"},
    write_csv};

}  // namespace
}  // namespace catena
