// serpentine: a tube through every point of a box of a lattice, with a radius such that the spheres at a
// whole distance `reach` touch exactly. How many pairs collide is known in closed form.
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/serpentine_path.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

StillScene serpentine(const SceneSetup& setup, std::uint32_t side, std::uint32_t reach, bool face_centred,
                      bool rods) {
  const std::uint32_t n = side == 0 ? setup.n() : side * side * side;
  if (side == 0) side = side_of_cube(n);
  Strands strands;
  if (rods && n > 0) {
    for (std::uint32_t first = 0; first < n; first += side) strands.first.push_back(first);
    strands.first.push_back(n);
  }
  const auto place = [=](std::uint32_t i) {
    return setup.place(serpentine_point(serpentine_cell(i, side), side, face_centred), reach / 2.0);
  };
  return StillScene(Row::by_number(n, place), std::move(strands));
}

const RegisterScene registered{
    {"serpentine",
     "tube through every point of a lattice; the pairs are known in closed form",
     {{"side", "0", "points along each of three axes, side^3 spheres in place of n; 0: enough for n"},
      {"reach", "3", "spheres of points so many steps apart touch exactly; the radius is half of it"},
      {"lattice", "cubic", "cubic, or face-centred: all points whose coordinates have an even sum"},
      {"strands", "one", "one tube, to and fro, or rods: a bundle, each row a strand"},
      {"align", "axes", "axes: whole numbers, touching exactly; general: turned, then rounded"},
      {"radius", "1", "step of the lattice, in length units; the spheres' radius is reach / 2 of it"},
      {"spacing", "1.6", "not used: it is a step of the lattice"}},
     "many contacts of every sphere are exact ties, in up to 150 directions",
     {"reach=1", "reach=3", "reach=5,strands=rods", "reach=6,lattice=face-centred", "reach=3,offset=1048576",
      "reach=3,scale=9.313225746154785e-10"}},
    [](const Parameters& parameters) {
      const auto number = [&](const char* key, std::uint64_t least, std::uint64_t greatest) {
        return static_cast<std::uint32_t>(parameters.unsigned_integer(key, least, greatest));
      };
      return std::make_unique<StillScene>(serpentine(
          SceneSetup("serpentine", parameters), number("side", 0, 1290), number("reach", 0, 1u << 20),
          parameters.choice("lattice", {"cubic", "face-centred"}) == "face-centred",
          parameters.choice("strands", {"one", "rods"}) == "rods"));
    }};

}  // namespace
}  // namespace catena
