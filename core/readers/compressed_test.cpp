#include "catena/core/readers/compressed.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include "catena/core/readers/base64.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/test_bytes.h"
#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

std::string gzipped(const std::string& content) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, content.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string any_content() {
  const auto piece = *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
  std::string content;
  for (auto times = *rc::gen::inRange(0, 400); times > 0; --times) content += piece;
  return content;
}

RC_GTEST_PROP(Gzip, UnpacksWhatIsPackedInAnyNumberOfMembers, ()) {
  const std::string first = any_content(), second = any_content();
  RC_ASSERT(gunzip(gzipped(first), "a") == first);
  RC_ASSERT(gunzip(gzipped(first) + gzipped(second), "a") == first + second);
  const auto size = *rc::gen::inRange<std::size_t>(0, 64);
  RC_ASSERT(gunzip_head(gzipped(first) + gzipped(second), size) == (first + second).substr(0, size));
}

RC_GTEST_PROP(Gzip, RefusesEveryTruncation, ()) {
  const std::string packed = gzipped(any_content());
  const auto size = *rc::gen::inRange<std::size_t>(0, packed.size());
  RC_ASSERT_THROWS_AS(gunzip(packed.substr(0, size), "a"), InputError);
}

RC_GTEST_PROP(Inflated, IsOfTheSizeThatWasTold, ()) {
  const std::string content = any_content();
  uLongf size = compressBound(content.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(content.data()),
           content.size());
  packed.resize(size);
  std::string got = "before";
  RC_ASSERT(append_inflated(packed, content.size(), got));
  RC_ASSERT(got == "before" + content);
  for (const std::uint64_t wrong :
       {content.size() + 1, content.size() - 1, std::uint64_t{1} << 60, ~std::uint64_t{0}})
    RC_ASSERT(!append_inflated(packed, wrong, got));
  RC_ASSERT(!append_inflated(std::string_view(packed).substr(0, packed.size() - 1), content.size(), got));
}

TEST(Gzip, FilesAreReadByTheNameInside) {
  EXPECT_EQ(read_text("a.xyzr.gz", gzipped("0 0 0 1\n")).spheres.size(), 1u);
  EXPECT_EQ(read_text("a.XYZR", gzipped("0 0 0 1\n")).spheres.size(), 1u);  // and by their first bytes
  EXPECT_COMPLAINT("1: a point is", "a.xyzr.gz", gzipped("0 0\n"));
  EXPECT_COMPLAINT(" the gzip data is damaged or cut off", "a.xyzr.gz", gzipped("0 0 0 1\n").substr(0, 20));
  const std::string packed = gzipped("0 0 0 1\n");  // ends with a sum and the size, of four bytes each
  EXPECT_EQ(complaint("a.xyzr.gz", packed.substr(0, packed.size() - 1)),
            "a.xyzr.gz: the gzip data is damaged or cut off after 8 bytes of content; check it with gzip -t");
  EXPECT_COMPLAINT(" holds nothing when unpacked", "a.xyzr.gz", gzipped(""));
}

/// Two kinds have one extension, and their first bytes tell which it is: those that were packed, not gzip's
/// own.
TEST(Gzip, HidesNotOfWhichKindAFileIs) {
  const std::string text = "t\n\n1 atoms\n\nAtoms # bond\n\n1 1 1 5 0 0\n";
  std::string hair;
  append(hair, 1), append(hair, 1), append(hair, 5.f), append(hair, 0.f), append(hair, 0.f);
  const auto named = [](std::string packed) {  // as gzip does unless it is told not to
    packed[3] = 8;
    return packed.insert(10, std::string("a.data\0", 7));
  };
  for (const std::string& content : {text, hair})
    for (const std::string& packed :
         {gzipped(content), named(gzipped(content)), gzipped("") + gzipped(content)})
      for (const char* name : {"a.data.gz", "a.lmp.gz", "a.data"}) {
        const CurveFile curves = read_text(name, packed);
        EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{5, 0, 0, 0}}));
        EXPECT_EQ(curves.labels.size(), content == text ? 1u : 0u) << name;
      }
  EXPECT_COMPLAINT(" the gzip data is damaged or cut off", "a.data.gz", gzipped(hair).substr(0, 12));
}

TEST(FirstBytes, AreThoseOfTheWholeFile) {
  const std::string content = "abcdefgh";
  const TestFile packed("a", gzipped(content)), plain("a", content);
  for (const std::size_t size : {0u, 1u, 4u, 8u, 9u, 1u << 20}) {
    EXPECT_EQ(first_bytes(packed.path(), size), content.substr(0, size));
    EXPECT_EQ(first_bytes(plain.path(), size), content.substr(0, size));
  }
}

TEST(Format, IsNamedWhereTheExtensionDoesNotTell) {
  const TestFile file("a.out", "0 0 0 1\n");
  EXPECT_EQ(ReaderRegistry::instance().read(file.path(), {.format = "xyzr"}).spheres.size(), 1u);
  EXPECT_EQ(ReaderRegistry::instance().read(file.path(), {.format = ".XYZR"}).spheres.size(), 1u);
  EXPECT_COMPLAINT(" no reader for '.out' files", "a.out", "0 0 0 1\n");
  EXPECT_COMPLAINT(" has no extension; name its format with --format", "plain", "0 0 0 1\n");
}

TEST(Base64, GoesOnAfterPaddingAndRefusesWhatIsNone) {
  std::string bytes;
  Base64 text("AQ==\n AgM=BAUG");
  EXPECT_TRUE(text.read(6, bytes));
  EXPECT_EQ(bytes, "\1\2\3\4\5\6");
  EXPECT_FALSE(text.read(1, bytes));
  for (const char* bad : {"A", "AQ=", "A===", "====", "AQ=A", "A*AA"})
    EXPECT_FALSE(Base64(bad).read(1, bytes)) << bad;
}

// The topology has no need to be packed, too.
TEST(Gzip, HidesNotWhatLiesBesideAFile) {
  const TestFile packed("a.dat.gz", gzipped("t = 0\nb = 9 9 9\nE = 0\n0 0 0\n1 0 0\n"));
  std::ofstream(packed.path().parent_path() / "a.top") << "2 1\n1 A -1 1\n1 C 0 -1\n";
  EXPECT_EQ(ReaderRegistry::instance().read(packed.path()).strand_first, (std::vector<std::uint32_t>{0, 2}));
}

}  // namespace
}  // namespace catena
