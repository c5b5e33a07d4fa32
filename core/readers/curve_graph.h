#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/pair.h"
#include "catena/core/readers/reader.h"

namespace catena {

/// Makes strands of points that a file ties together by edges: the lines of a mesh, the bonds of a polymer. A
/// strand runs from an end, or from a branch, to where no new point follows, always over the first free edge
/// in the order of the file; a loop becomes a closed strand. What is left of the edges are joints: branches,
/// and loops that end on themselves. So neighbours are those of the graph.
///
/// `curves` holds every point of the file in its order, in each frame; afterwards only those that a strand
/// holds, in the order of the strands. Points without an edge become strands of one where `keep_free`,
/// otherwise they are left out, but for those with an edge to themselves: points that a file draws as such.
/// An edge that comes twice counts once. Edges name points of `curves`.
///
/// Returns for each sphere the point that it was. O(points + edges) time; 12 bytes a point and 8 an edge
/// beside the spheres, which are copied unless they stay in order.
std::vector<std::uint32_t> arrange_along_edges(CurveFile& curves, std::span<const Pair> edges,
                                               bool keep_free);

}  // namespace catena
