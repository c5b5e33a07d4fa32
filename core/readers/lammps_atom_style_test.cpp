#include "catena/core/readers/lammps_atom_style.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace catena {
namespace {

/// The rows of section Atoms as https://docs.lammps.org/read_data.html prints them; of template, whose type
/// the page has in the second place, as LAMMPS itself reads and writes them
/// (src/MOLECULE/atom_vec_template.cpp).
const std::map<std::string_view, std::string> documented{
    {"amoeba", "atom-ID molecule-ID atom-type q x y z"},
    {"angle", "atom-ID molecule-ID atom-type x y z"},
    {"atomic", "atom-ID atom-type x y z"},
    {"body", "atom-ID atom-type bodyflag mass x y z"},
    {"bond", "atom-ID molecule-ID atom-type x y z"},
    {"bpm/sphere", "atom-ID molecule-ID atom-type diameter density x y z"},
    {"charge", "atom-ID atom-type q x y z"},
    {"dielectric", "atom-ID molecule-ID atom-type q x y z normx normy normz area ed em epsilon curvature"},
    {"dipole", "atom-ID atom-type q x y z mux muy muz"},
    {"dpd", "atom-ID atom-type theta x y z"},
    {"edpd", "atom-ID atom-type edpd_temp edpd_cv x y z"},
    {"electron", "atom-ID atom-type charge espin eradius x y z"},
    {"ellipsoid", "atom-ID atom-type ellipsoidflag density x y z"},
    {"full", "atom-ID molecule-ID atom-type q x y z"},
    {"hybrid", "atom-ID atom-type x y z"},
    {"line", "atom-ID molecule-ID atom-type lineflag density x y z"},
    {"mdpd", "atom-ID atom-type rho x y z"},
    {"molecular", "atom-ID molecule-ID atom-type x y z"},
    {"peri", "atom-ID atom-type volume density x y z"},
    {"rheo", "atom-ID atom-type status rho x y z"},
    {"rheo/thermal", "atom-ID atom-type status rho energy x y z"},
    {"smd", "atom-ID atom-type molecule-ID volume mass kradius cradius x0 y0 z0 x y z"},
    {"sph", "atom-ID atom-type rho esph cv x y z"},
    {"sphere", "atom-ID atom-type diameter density x y z"},
    {"spin", "atom-ID atom-type x y z spx spy spz sp"},
    {"tdpd", "atom-ID atom-type x y z"},
    {"template", "atom-ID molecule-ID template-index template-atom atom-type x y z"},
    {"tri", "atom-ID molecule-ID atom-type triangleflag density x y z"},
    {"wavepacket", "atom-ID atom-type charge espin eradius etag cs_re cs_im x y z"}};

/// Whose rows go on: with a number a species, what sub-styles need, or what some versions write besides.
const std::set<std::string_view> open_ended{"dielectric", "hybrid", "tdpd"};

TEST(LammpsAtomStyles, HaveTheColumnsThatLammpsDocuments) {
  ASSERT_EQ(lammps_atom_styles().size(), documented.size());
  for (const LammpsAtomStyle& style : lammps_atom_styles()) {
    std::vector<std::string> columns;
    std::istringstream words(documented.at(style.name));
    for (std::string word; words >> word;) columns.push_back(word);
    const auto place = [&](const char* column) {
      const auto found = std::ranges::find(columns, column);
      return found == columns.end() ? std::optional<std::size_t>() : found - columns.begin();
    };
    EXPECT_EQ(style.columns, columns.size()) << style.name;
    EXPECT_EQ(style.x, place("x")) << style.name;
    EXPECT_EQ(style.x + 2, place("z")) << style.name;
    EXPECT_EQ(style.molecule, place("molecule-ID")) << style.name;
    EXPECT_EQ(style.diameter, place("diameter")) << style.name;
    for (const std::size_t images : {0, 3}) EXPECT_TRUE(style.fits(columns.size() + images)) << style.name;
    EXPECT_FALSE(style.fits(columns.size() - 1)) << style.name;
    for (const std::size_t more : {1, 2, 4})
      EXPECT_EQ(style.fits(columns.size() + more), open_ended.contains(style.name)) << style.name;
  }
}

}  // namespace
}  // namespace catena
