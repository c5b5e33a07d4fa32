#include <array>
#include <cstring>
#include <limits>

#include "catena/core/readers/test_bytes.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

/// Tracts and hair: binary strands of points without radii.
namespace catena {
namespace {

std::vector<std::vector<Sphere>> any_strands() {
  std::vector<std::vector<Sphere>> strands(*rc::gen::inRange<std::size_t>(1, 5));
  for (auto& strand : strands)
    for (auto left = *rc::gen::inRange(1, 5); left > 0; --left)
      strand.push_back({*any_finite(), *any_finite(), *any_finite(), 0});
  return strands;
}

void are_the_strands(const CurveFile& curves, const std::vector<std::vector<Sphere>>& strands) {
  RC_ASSERT(curves.strand_closed == std::vector<std::uint8_t>(strands.size(), 0));
  RC_ASSERT(!curves.has_radii);
  for (std::size_t s = 0; s < strands.size(); ++s) {
    RC_ASSERT(curves.strand_first[s + 1] - curves.strand_first[s] == strands[s].size());
    RC_ASSERT(std::memcmp(&curves.spheres[curves.strand_first[s]], strands[s].data(),
                          strands[s].size() * sizeof(Sphere)) == 0);
  }
}

template <class Real>
std::string tck_of(const std::vector<std::vector<Sphere>>& strands, bool big_endian) {
  std::string text = std::string("mrtrix tracks\ncount: 0000000\ndatatype: ") +
                     (sizeof(Real) == 4 ? "Float32" : "Float64") + (big_endian ? "BE" : "LE") +
                     "\nfile: . 90\nEND\n";
  text.resize(90, '\0');
  const auto triple = [&](Real x, Real y, Real z) {
    append(text, x, big_endian), append(text, y, big_endian), append(text, z, big_endian);
  };
  for (const auto& strand : strands) {
    for (const Sphere& p : strand)
      triple(static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z));
    const Real nan = std::numeric_limits<Real>::quiet_NaN();
    triple(nan, nan, nan);
  }
  const Real infinity = std::numeric_limits<Real>::infinity();
  triple(infinity, infinity, infinity);
  return text;
}

RC_GTEST_PROP(TckReader, ReadsWhatIsWritten, (bool wide, bool big_endian)) {
  const auto strands = any_strands();
  const CurveFile curves =
      read_text("a.tck", wide ? tck_of<double>(strands, big_endian) : tck_of<float>(strands, big_endian));
  are_the_strands(curves, strands);
  RC_ASSERT(curves.warnings.empty());
}

TEST(TckReader, RefusesTracksInTheHeader) {
  EXPECT_COMPLAINT("4: the tracks are said to begin at byte 0", "a.tck",
                   "mrtrix tracks\ndatatype: Float32LE\nfile: . 0\nEND\n" + std::string(56, '\0'));
}

TEST(TckReader, ReadsHeadersOfAnyCaseAndALastTrackWithoutItsEnd) {
  std::string text = "mrtrix tracks\nof\nDataType: Float32LE\nFILE: . 53\nEND\n\n";
  ASSERT_EQ(text.size(), 53u);
  for (const float value : {1.f, 2.f, 3.f, 4.f, 5.f, 6.f}) append(text, value);
  for (int k = 0; k < 3; ++k) append(text, std::numeric_limits<float>::infinity());
  const CurveFile curves = read_text("a.tck", text);
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{1, 2, 3, 0}, {4, 5, 6, 0}}));
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(curves.strand_closed.size(), 1u);
}

TEST(TckReader, SaysWhatIsWrong) {
  EXPECT_COMPLAINT("3: the header lacks", "a.tck", "mrtrix tracks\ndatatype: Float32LE\nEND\n");
  const std::string wide = "mrtrix tracks\ndatatype: Float64LE\nfile: . 49\nEND\n";
  ASSERT_EQ(wide.size(), 49u);
  for (const int large : {0, 1, 2}) {
    std::string text = wide;
    for (const int axis : {0, 1, 2}) append(text, axis == large ? 1e300 : 1.);
    EXPECT_NE(complaint("a.tck", text).find("the coordinate 1e+300 before this is no finite 32-bit float"),
              std::string::npos);
  }
  EXPECT_COMPLAINT("2: the offset in '. -1' is no position", "a.tck", "mrtrix tracks\nfile: . -1\nEND\n");

  EXPECT_COMPLAINT("1: the file does not start with", "a.tck", "tracks\n");
  EXPECT_COMPLAINT("2: the datatype 'Float16LE'", "a.tck", "mrtrix tracks\ndatatype: Float16LE\nEND\n");
  EXPECT_COMPLAINT("2: the tracks are in another file", "a.tck", "mrtrix tracks\nfile: b.dat 0\nEND\n");
  EXPECT_COMPLAINT("2: the header lacks", "a.tck", "mrtrix tracks\nEND\n");
  const std::string header = "mrtrix tracks\ndatatype: Float32LE\nfile: . 53\nEND\n";
  for (const std::size_t size :
       {header.size(), std::size_t{52}})  // where the tracks would begin is the end, or beyond
    EXPECT_COMPLAINT(" byte 49: the data is said to begin at byte 53 of " + std::to_string(size), "a.tck",
                     header + std::string(size - header.size(), '\0'));
  // One number that is none neither ends a track nor the file.
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                  infinity = std::numeric_limits<float>::infinity();
  for (const auto& [x, y, z] : {std::array{nan, 0.f, 0.f},
                                {0.f, nan, nan},
                                {nan, nan, 0.f},
                                {infinity, 0.f, 0.f},
                                {infinity, infinity, 0.f},
                                {0.f, infinity, infinity},
                                {nan, infinity, nan}})
    EXPECT_NE(complaint("a.tck", tck_of<float>({{{1, 2, 3, 0}, {x, y, z, 0}}}, false))
                  .find("is no finite 32-bit float"),
              std::string::npos);
  const std::string whole = tck_of<float>({{{1, 2, 3, 0}}}, false);
  EXPECT_EQ(read_text("a.tck", whole.substr(0, whole.size() - 12)).warnings.size(), 1u);
  EXPECT_COMPLAINT(" byte ", "a.tck", whole.substr(0, whole.size() - 5));
}

std::string trk_of(const std::vector<std::vector<Sphere>>& strands, bool big_endian, std::uint16_t scalars,
                   std::uint16_t properties, std::int32_t announced) {
  std::string bytes("TRACK", 5);
  bytes.resize(36, '\0');
  append(bytes, scalars, big_endian);
  bytes.resize(238, '\0');
  append(bytes, properties, big_endian);
  bytes.resize(988, '\0');
  append(bytes, announced, big_endian), append(bytes, std::int32_t{2}, big_endian),
      append(bytes, std::int32_t{1000}, big_endian);
  for (const auto& strand : strands) {
    append(bytes, static_cast<std::int32_t>(strand.size()), big_endian);
    for (const Sphere& p : strand) {
      append(bytes, p.x, big_endian), append(bytes, p.y, big_endian), append(bytes, p.z, big_endian);
      bytes.append(4u * scalars, '\x7f');
    }
    bytes.append(4u * properties, '\x7f');
  }
  return bytes;
}

RC_GTEST_PROP(TrkReader, ReadsWhatIsWritten, (bool big_endian)) {
  const auto strands = any_strands();
  const auto scalars = *rc::gen::inRange<std::uint16_t>(0, 3),
             properties = *rc::gen::inRange<std::uint16_t>(0, 3);
  for (const auto announced : {0, static_cast<int>(strands.size())}) {
    const CurveFile curves = read_text("a.trk", trk_of(strands, big_endian, scalars, properties, announced));
    are_the_strands(curves, strands);
    RC_ASSERT(curves.warnings.empty());
  }
}

TEST(TrkReader, SaysWhatIsWrong) {
  EXPECT_EQ(read_text("a.trk", trk_of({{{1, 2, 3, 0}}, {}, {{4, 5, 6, 0}}}, false, 1, 2, 3)).spheres,
            (std::vector<Sphere>{{1, 2, 3, 0}, {4, 5, 6, 0}}));  // a track without points has its properties
  EXPECT_COMPLAINT(" byte 1004: the file is truncated: 12 bytes left, too few for 2 points of 12 bytes",
                   "a.trk", trk_of({{{1, 2, 3, 0}, {4, 5, 6, 0}}}, false, 0, 0, 1).substr(0, 1016));
  EXPECT_COMPLAINT(" byte 1004: the file is truncated: 24 bytes left, too few for 2 points of 16 bytes",
                   "a.trk", trk_of({{{1, 2, 3, 0}, {4, 5, 6, 0}}}, false, 1, 0, 1).substr(0, 1028));
  EXPECT_EQ(read_text("a.trk", trk_of({{{1, 2, 3, 0}}}, false, 0, 0, 5)).warnings,
            std::vector<std::string>{"the header says 5 tracks, the file has 1; all of them are read"});
  EXPECT_EQ(read_text("a.trk", trk_of({{{1, 2, 3, 0}}, {{4, 5, 6, 0}}}, false, 0, 0, 1)).warnings,
            std::vector<std::string>{"the header says 1 track, the file has 2; all of them are read"});
  EXPECT_COMPLAINT(" holds no points", "a.trk", trk_of({}, false, 0, 0, 0));
  EXPECT_COMPLAINT(" byte 5: the file does not start with TRACK", "a.trk", "TRUCK");
  EXPECT_COMPLAINT(" byte ", "a.trk", trk_of({{{1, 2, 3, 0}}}, false, 0, 0, 1).substr(0, 1010));
  EXPECT_COMPLAINT(" byte 1000: the header does not say", "a.trk", "TRACK" + std::string(1000, '\0'));
}

RC_GTEST_PROP(TfxReader, ReadsWhatIsWritten, ()) {
  const auto size = *rc::gen::inRange<std::uint32_t>(1, 5);
  std::vector<std::vector<Sphere>> strands(*rc::gen::inRange<std::size_t>(1, 5));
  for (auto& strand : strands)
    for (std::uint32_t k = 0; k < size; ++k)
      strand.push_back({*any_finite(), *any_finite(), *any_finite(), 0});
  std::string bytes;
  append(bytes, 4.0f), append(bytes, static_cast<std::uint32_t>(strands.size())), append(bytes, size),
      append(bytes, std::uint32_t{160});
  bytes.resize(160, '\0');
  for (const auto& strand : strands)
    for (const Sphere& p : strand)
      append(bytes, p.x), append(bytes, p.y), append(bytes, p.z), append(bytes, 1.0f);
  are_the_strands(read_text("a.tfx", bytes), strands);
}

TEST(TfxReader, SaysWhatIsWrong) {
  std::string bytes;
  append(bytes, 3.0f);
  EXPECT_COMPLAINT(" byte 4: the version is 3", "a.tfx", bytes);
  std::string later;
  append(later, 5.0f), append(later, 1u), append(later, 1u), append(later, 16u);
  EXPECT_COMPLAINT(" byte 4: the version is 5", "a.tfx", later + std::string(16, '\0'));
  std::string cut_off;
  append(cut_off, 4.0f), append(cut_off, 1u), append(cut_off, 2u), append(cut_off, 160u);
  cut_off.resize(160, '\0');
  EXPECT_COMPLAINT(" byte 160: the file is truncated: 31 bytes left, too few for 2 points of 16 bytes",
                   "a.tfx", cut_off + std::string(31, '\0'));
  bytes.clear();
  append(bytes, 4.0f), append(bytes, 2u), append(bytes, 1u << 31), append(bytes, 160u);
  bytes.resize(160, '\0');
  EXPECT_COMPLAINT(" byte 160: the file is truncated: 0 bytes left, too few for 4294967296 points", "a.tfx",
                   bytes);
  for (const std::uint32_t offset : {0u, 10u, 159u}) {
    std::string inside;
    append(inside, 4.0f), append(inside, 1u), append(inside, 1u), append(inside, offset);
    EXPECT_COMPLAINT(
        " byte 16: the points are said to begin at byte " + std::to_string(offset) + ", in the header of 160",
        "a.tfx", inside + std::string(160, '\0'));
  }
}

}  // namespace
}  // namespace catena
