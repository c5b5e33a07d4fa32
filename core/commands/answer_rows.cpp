#include "catena/core/commands/answer_rows.h"

#include <fmt/format.h>

#include <string>

#include "catena/core/error.h"
#include "catena/core/periodic/overlap.h"
#include "catena/core/readers/text_lines.h"
#include "catena/core/writers/writer.h"

namespace catena {

std::vector<std::string> AnswerTables::pair_columns() const {
  std::vector<std::string> columns{"frame",    "i",        "j",       "label_i", "label_j",
                                   "strand_i", "strand_j", "index_i", "index_j"};
  if (depth) columns.push_back("depth");
  if (margin) columns.push_back("margin");
  return columns;
}

std::vector<std::string> AnswerTables::count_columns() {
  return {"frame", "sphere", "count", "label", "strand", "index"};
}

void leave_out_unread_pairs(Request& request, const AnswerTables& tables) {
  const bool read = !tables.pairs.empty() || request.pair_limit != Request{}.pair_limit;
  if (request.want == Request::Want::pairs && !read) request.want = Request::Want::counts;
}

void check_answer_options(const Request& request, const AnswerTables& tables) {
  for (const std::string& name : {tables.pairs, tables.counts}) {
    const std::string lower = lower_case(name);
    if (lower.ends_with(".gz"))
      throw InputError(fmt::format("{}: tables are not written packed; name a .csv or .jsonl file", name));
    if (lower.ends_with(".json"))  // it would hold CSV
      throw InputError(fmt::format("{}: tables are CSV or JSON lines; name a .csv or .jsonl file", name));
    for (const WriterInfo& writer : WriterRegistry::instance().writers())
      for (const std::string& extension : writer.extensions)
        if (extension != ".csv" && lower.ends_with(extension))
          throw InputError(fmt::format(
              "{}: tables are CSV or JSON lines; name a .csv or .jsonl file, or use catena export for {}",
              name, writer.name));
  }
  if ((tables.depth || tables.margin) && tables.pairs.empty())
    throw InputError("--depth and --margin are columns of --pairs; name its file, too");
  if (request.want == Request::Want::any && (!tables.pairs.empty() || !tables.counts.empty()))
    throw InputError("--any finds neither counts nor pairs; leave out --counts-only, --counts and --pairs");
  if (request.want == Request::Want::counts && !tables.pairs.empty())
    throw InputError("--counts-only keeps no pairs; leave out --pairs or --counts-only");
  if (request.want != Request::Want::pairs && request.pair_limit != Request{}.pair_limit)
    throw InputError(
        "--pair-limit is for pairs that are kept, and --counts-only and --any keep none; leave it out");
}

void put_pair_cells(RowText& row, const AnswerTables& tables, std::uint32_t frame, const NamedSphere& i,
                    const NamedSphere& j, const Sphere& at_i, const Sphere& at_j, const PeriodicBox* box) {
  row.number(frame).number(i.number).number(j.number);
  row.text(i.label).text(j.label).text(i.strand).text(j.strand);
  row.number(i.index).number(j.index);
  if (!tables.depth && !tables.margin) return;
  const Overlap overlap = overlap_of(at_i, at_j, box);
  if (tables.depth) row.real(overlap.depth);
  if (tables.margin) row.real(overlap.margin);
}

void put_count_cells(RowText& row, std::uint32_t frame, const NamedSphere& sphere, std::uint64_t count) {
  row.number(frame)
      .number(sphere.number)
      .number(count)
      .text(sphere.label)
      .text(sphere.strand)
      .number(sphere.index);
}

}  // namespace catena
