#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace catena::bench {

/// What a source says of one tight knot or link, as a number that was not computed here.
struct PublishedKnot {
  enum class Of {
    polygon,  ///< this polygon, vertex by vertex: thickness by Rawdon, the lesser of its tightest bend and
              ///< half its least doubly critical distance
    curve,    ///< a smooth curve on which the vertices lie
    type      ///< every curve of the knot type: none is shorter, as is proved, or as far as anyone knows
  };
  std::string name = {};  ///< as `--knot` takes it
  std::string what = {};  ///< in words
  Of of = Of::polygon;
  double ropelength = 0;       ///< length over thickness, a tube's radius; 0: the thickness is what is told
  double thickness = 0;        ///< where ropelength is 0: in the units of the file
  double error = 0;            ///< of that number as it is printed
  std::uint64_t struts = 0;    ///< places where the tube touches itself; 0: none are told
  double strut_tolerance = 0;  ///< a strut may be longer than twice the thickness by this share
  std::string struts_of = {};  ///< the shape that they were told of, where it is another
  std::string source = {};     ///< who told it, and where the polygon is
};

/// All that the project carries. Numbers alone: no polygon of another's is.
std::span<const PublishedKnot> published_knots();

/// Throws InputError that names those there are.
const PublishedKnot& published_knot(const std::string& name);

}  // namespace catena::bench
