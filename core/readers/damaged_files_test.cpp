#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <sstream>

#include "catena/core/chain/chain.h"
#include "catena/core/readers/test_file.h"

/// Whatever happens to a file, reading it ends in curves that a chain can be made of, or in an InputError.
namespace catena {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

// The mutations that parsers fail at: cut off, a byte changed, a piece doubled or lost, a number swollen.
std::string damaged(std::string text) {
  for (auto left = *rc::gen::inRange(1, 4); left > 0; --left) {
    if (text.empty()) return text;
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    const auto length = *rc::gen::inRange<std::size_t>(1, 40);
    switch (*rc::gen::inRange(0, 5)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text[at] = static_cast<char>(*rc::gen::inRange(0, 256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.insert(at, *rc::gen::elementOf(std::vector<std::string>{"nan", "-", "99999999999", "e999", "\n",
                                                                     " ", "\xFF\xFF\xFF\x7F", "#"}));
    }
  }
  return text;
}

// Each mutation early in the file is worth more than one late: a few lines show all that a text format has.
std::string head(const std::filesystem::path& file, std::size_t skip) {
  return bytes_of(file).substr(skip, 3000);
}

void reads_or_complains(const std::string& name, const std::string& text) {
  const TestFile file(name, text);
  try {
    const CurveFile curves = ReaderRegistry::instance().read(file.path());
    RC_ASSERT(curves.strand_first.size() == curves.strand_closed.size() + 1);
    RC_ASSERT(curves.strand_first.back() == curves.spheres.size());
    for (std::uint32_t i = 0; i < curves.spheres.size(); ++i) curves.labels.of(i);
    for (const auto& frame : curves.later_frames) RC_ASSERT(frame.size() == curves.spheres.size());
    for (const std::string& warning : curves.warnings) RC_ASSERT(warning.find(name) == std::string::npos);
    Chain(curves.spheres, {curves.strand_first, curves.strand_closed}, curves.exclusion);
    for (const Pair& joint : curves.joints)
      RC_ASSERT(joint.i < curves.spheres.size() && joint.j < curves.spheres.size() && joint.i != joint.j);
  } catch (const InputError& error) {
    RC_ASSERT(std::string(error.what()).find(name) != std::string::npos);
  }
}

RC_GTEST_PROP(DamagedFiles, Swc, ()) {
  reads_or_complains("a.swc", damaged(head(example("Neuron.swc"), 1650)));
}
RC_GTEST_PROP(DamagedFiles, Pdb, ()) {
  reads_or_complains("a.pdb", damaged(head(example("1A8O.pdb"), 25500)));
}
RC_GTEST_PROP(DamagedFiles, Txt, ()) {
  reads_or_complains("a.txt", damaged(head(example("9_47-cubiclattice.txt"), 0)));
}
RC_GTEST_PROP(DamagedFiles, Xyz, ()) {
  const std::string title =
      "Lattice=\"9 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3:radius:R:1:strand:I:1\n";
  std::string text;
  for (int frame = 0; frame < 3; ++frame)
    text += "4\n" + title + "C 0 0 0 1 0\nO 1 0 0 1 0\nX 5 0 0 1e-3 1\nC 6.5 0 -1 1 0\n";
  reads_or_complains("a.xyz", damaged(text));
}
RC_GTEST_PROP(DamagedFiles, CsvOfStrands, ()) {
  reads_or_complains(
      "a.csv", damaged("id,strand,closed,x,y,z,d\np,a,1,0,0,0,1\nq,b,0,1,0,0,1\n\"r,r\",a,1,2,0,0,1\n"));
}
RC_GTEST_PROP(DamagedFiles, Csv, ()) {
  reads_or_complains("a.csv", damaged(head(example("Edin90_small_xyzr.csv"), 0)));
}
RC_GTEST_PROP(DamagedFiles, Chain, ()) {
  reads_or_complains("a.chain", damaged(bytes_of(example("rings.chain"))));
}

RC_GTEST_PROP(DamagedFiles, Vect, ()) {
  reads_or_complains("a.vect",
                     damaged("VECT\n2 5 1\n-3 2\n1 0\n0 0 0 # c\n1 0 0\n1 1 0\n5 5 5\n6 6 6\n0 1 0 1\n"));
}

RC_GTEST_PROP(DamagedFiles, Text, ()) {
  struct Whole {
    const char *name, *text;
  };
  const Whole whole = *rc::gen::elementOf(std::vector<Whole>{
      {"a.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 2 0 0\nLINES 1 "
       "4\n3 0 1 2\n"
       "POINT_DATA 3\nSCALARS radius float 1\nLOOKUP_TABLE default\n1 1 1\nMETADATA\nINFORMATION 0\n\n"},
      {"a.vtp",
       "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfVerts=\"0\"><Points><DataArray "
       "type=\"Float32\">0 0 0 1 0 0</DataArray>"
       "</Points><Lines><DataArray type=\"Int64\" Name=\"connectivity\">0 1</DataArray><DataArray "
       "type=\"UInt8\" Name=\"offsets\" "
       "format=\"binary\">AQAAAAI=</DataArray></Lines></Piece></PolyData></VTKFile>"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0 # c\nl 1 2 \\\n3\nl -1 1\nf 1 2 3\n"},
      {"a.data",
       "t\n\n2 atoms\n1 bonds\n\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nAtoms # full\n\n1 1 1 0.5 0 0 0\n2 "
       "1 1 0 1 0 0\n\nBonds\n\n1 1 1 2\n"},
      {"a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 9 1\n0 9 0\n0 9 "
       "0\nITEM: ATOMS id mol xs ys zs "
       "radius\n1 1 0 0 0 1\n2 1 0.5 0 0 1\n"},
      {"a.cif",
       "loop_\n_entity_poly_seq.mon_id\nGLY\n#\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_"
       "site.label_atom_id\n"
       "_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.Cartn_x\n_"
       "atom_site.Cartn_y\n_atom_site.Cartn_z\n"
       "ATOM C CA GLY A 1 0 0 0\nATOM C 'CA' GLY A 2 3.8 0 0\n#\n"},
      {"a.xyzr", "0 0 0 1\n1 0 0 1\n\n2,0,0,1 # c\n"},
      {"a.nucle3d", "TITLE\tK\nCHR\tchr1\n0,1,2,3\n1,2,3,4,p\nCHR\tchr2\n0,1,2,3\n"},
      {"a.3dg", "chr1\t0\t1\t2\t3\nchr1\t5\t2\t3\t4\nchr2\t0\t1\t2\t3\n"},
      {"a.tck",
       "mrtrix tracks\ndatatype: Float32LE\nfile: . 60\nEND\n             0123012301230123012301230123"}});
  reads_or_complains(whole.name, damaged(whole.text));
}

RC_GTEST_PROP(DamagedFiles, Binary, ()) {
  std::string trk("TRACK", 5), tfx("\0\0\x80@\2\0\0\0\2\0\0\0\xA0\0\0\0", 16);
  trk.resize(996, '\0');
  trk += std::string("\xE8\3\0\0\2\0\0\0", 8) + std::string(24, '\x3f');
  tfx.resize(160, '\0');
  tfx += std::string(64, '\x3f');
  std::string bcc("BCCDC0\3\2\2\0\0\0\0\0\0\0\3\0\0\0\0\0\0\0", 24);
  bcc.resize(64, '\0');
  bcc += std::string("\1\0\0\0", 4) + std::string(12, '\x3f') + "\xFE\xFF\xFF\xFF" + std::string(24, '\x3f');
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.trk", trk},
      {"a.tfx", tfx},
      {"a.bcc", bcc},
      {"a.data", std::string("\2\0\0\0\1\0\0\0", 8) + std::string(12, '\x3f') + std::string("\2\0\0\0", 4) +
                     std::string(24, '\x3f')}};
  const auto [name, whole] = *rc::gen::elementOf(files);
  reads_or_complains(name, damaged(whole));
}

RC_GTEST_PROP(DamagedFiles, Oxdna, ()) {
  const TestFile top("b.top", damaged("2 1\n1 A -1 1\n1 C 0 -1\n")),
      file("b.conf", damaged("t = 0\nb = 9 9 9\nE = 0\n0 0 0\n1 0 0\n"));
  try {
    ReaderRegistry::instance().read(file.path(), {.topology = top.path().string()});
  } catch (const InputError& error) {
    RC_ASSERT(std::string(error.what()).find("b.") != std::string::npos);
  }
}

RC_GTEST_PROP(DamagedFiles, Hair, ()) {
  std::string hair("HAIR\2\0\0\0\5\0\0\0\7\0\0\0", 16);
  hair.resize(128, '\0');
  hair += std::string("\2\0\1\0", 4) + std::string(5 * 16, '\x3f');
  reads_or_complains("a.hair", damaged(hair));
}

}  // namespace
}  // namespace catena
