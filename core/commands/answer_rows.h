#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/commands/row_file.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/sphere.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// The tables of --pairs and --counts, a row for each pair or sphere:
///
///     frame,i,j,label_i,label_j,strand_i,strand_j,index_i,index_j[,depth][,margin]
///     frame,sphere,count,label,strand,index
///
/// i, j and sphere are numbers of the chain, from 0; a label is what identifies the sphere in the user's
/// file; the strand is its name in the file or else its number from 0, and the index that of the sphere in
/// it, from 0.
struct AnswerTables {
  std::string pairs, counts;  ///< files; empty: no such file
  bool depth = false, margin = false;

  std::vector<std::string> pair_columns() const;
  static std::vector<std::string> count_columns();
};

/// Throws InputError when a table is asked for that the request does not fill, or by the name of a packed
/// file, which none is.
void check_answer_options(const Request& request, const AnswerTables& tables);

/// Asks for counts instead of pairs where nothing is done with pairs: there is no table of them, and no other
/// limit to them than the usual one.
void leave_out_unread_pairs(Request& request, const AnswerTables& tables);

/// A sphere as the rows name it.
struct NamedSphere {
  std::uint64_t number;
  std::string label, strand;
  std::uint64_t index;
};

/// The cells of a row; the caller ends it. Depth and margin are those in the box, where there is one.
void put_pair_cells(RowText& row, const AnswerTables& tables, std::uint32_t frame, const NamedSphere& i,
                    const NamedSphere& j, const Sphere& at_i, const Sphere& at_j, const PeriodicBox* box);
/// The same of a sphere and its collisions, `count` of them.
void put_count_cells(RowText& row, std::uint32_t frame, const NamedSphere& sphere, std::uint64_t count);

}  // namespace catena
