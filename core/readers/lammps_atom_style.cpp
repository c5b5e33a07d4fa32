#include "catena/core/readers/lammps_atom_style.h"

namespace catena {

std::span<const LammpsAtomStyle> lammps_atom_styles() {
  static constexpr LammpsAtomStyle styles[] = {
      {"amoeba", 7, 4, 1},
      {"angle", 6, 3, 1},
      {"atomic", 5, 2},
      {"body", 7, 4},
      {"bond", 6, 3, 1},
      {"bpm/sphere", 8, 5, 1, 3},
      {"charge", 6, 3},
      {"dielectric", 15, 4, 1, {}, true},
      {"dipole", 9, 3},
      {"dpd", 6, 3},
      {"edpd", 7, 4},
      {"electron", 8, 5},
      {"ellipsoid", 7, 4},
      {"full", 7, 4, 1},
      {"hybrid", 5, 2, {}, {}, true},
      {"line", 8, 5, 1},
      {"mdpd", 6, 3},
      {"molecular", 6, 3, 1},
      {"peri", 7, 4},
      {"rheo", 7, 4},
      {"rheo/thermal", 8, 5},
      {"smd", 13, 10, 2},
      {"sph", 8, 5},
      {"sphere", 7, 4, {}, 2},
      {"spin", 9, 2},
      {"tdpd", 5, 2, {}, {}, true},
      {"template", 8, 5, 1},
      {"tri", 8, 5, 1},
      {"wavepacket", 11, 8},
  };
  return styles;
}

}  // namespace catena
