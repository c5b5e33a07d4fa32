#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/commands/row_file.h"
#include "catena/core/readers/labels.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// The files of --pairs and --counts, a row for each pair or sphere:
///
///     frame,i,j,label_i,label_j,strand_i,strand_j,index_i,index_j[,depth][,margin]
///     frame,sphere,count,label,strand,index
///
/// i, j and sphere are numbers of the chain, from 0; a label is what identifies the sphere in the user's
/// file; the strand is its name in the file or else its number from 0, and the index that of the sphere in
/// it, from 0.
class AnswerFiles {
 public:
  struct Names {
    std::string pairs, counts;  ///< empty: no such file
    bool depth = false, margin = false;
  };

  /// The labels must outlive this object. Throws as RowFile does.
  AnswerFiles(const Names& names, const Labels& labels);

  /// Sorts the pairs of `found`.
  void write(std::uint32_t frame, const Chain& chain, Collisions& found);
  void close();

 private:
  std::string strand_name(std::uint32_t strand) const;

  Names names_;
  const Labels& labels_;
  std::optional<RowFile> pairs_, counts_;
};

}  // namespace catena
