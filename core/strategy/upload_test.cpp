#include "catena/core/strategy/upload.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena {
namespace {

/// A device whose memory is the host's: what is not moved to it is not there.
class Memory final : public Device {
 public:
  ChainView to_device(const ChainView& host, const Moved& moved) override {
    if (full) throw std::runtime_error("no room");
    const bool known = host.topology != 0 && host.topology == topology_;
    topologies += !known, topology_ = host.topology;
    spheres_.resize(host.size);
    const auto move = [&](const SphereRange& range) {
      spheres += range.size();
      std::memcpy(spheres_.data() + range.begin, host.spheres + range.begin, range.size() * sizeof(Sphere));
    };
    if (!known || moved.everything())
      move({0, host.size});
    else
      for (const SphereRange& range : moved.ranges()) move(range.within(host.size));
    ChainView view = host;
    view.spheres = spheres_.data();
    return view;
  }
  HierarchyView<Sphere> to_device(const HierarchyView<Sphere>& tree) override { return tree; }
  HierarchyView<Sphere64> to_device(const HierarchyView<Sphere64>& tree) override { return tree; }
  HierarchyView<Sphere> to_host(const HierarchyView<Sphere>& tree) override { return tree; }
  HierarchyView<Sphere64> to_host(const HierarchyView<Sphere64>& tree) override { return tree; }
  Times run(const Work&) override { return {}; }
  void clear(const ResidentAnswer&, std::uint32_t, StreamHandle) override {}
  Times answer(std::uint32_t, const Request&, Collisions&, const Search&,
               const std::function<void(const ResidentState&)>&) override {
    return {};
  }
  Times answer_by_graph(std::uint32_t, const Request&, Collisions&, const Search&,
                        const std::function<void(const ResidentState&)>&,
                        const std::function<void()>&) override {
    return {};
  }
  void flush_cache() override {}

  bool full = false;
  std::size_t topologies = 0, spheres = 0;  ///< moved so far

 private:
  std::uint64_t topology_ = 0;
  std::vector<Sphere> spheres_;
};

Upload upload(const char* what) { return Upload(Parameters("test", with_upload({}), what)); }

Chain row(float from) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 40; ++i) spheres.push_back({from + static_cast<float>(i), 0, 0, 1});
  return Chain(std::move(spheres));
}

/// Spheres 10 to 12 of the chain lie elsewhere.
Chain with_some_moved(const Chain& chain) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (int i = 10; i < 13; ++i) spheres[i].y = 5;
  return chain.moved(std::move(spheres));
}

bool same(const ChainView& there, const Chain& chain) {
  return there.size == chain.size() &&
         std::memcmp(there.spheres, chain.spheres().data(), chain.size() * sizeof(Sphere)) == 0;
}

/// The same chain lies there with what is left out and without.
TEST(Upload, LeavesOutWhatLiesThere) {
  const Chain first = row(0), second = with_some_moved(first);
  const SphereRange moved[] = {{10, 13}};
  for (const char* what : {"", "upload=all"}) {
    const bool all = *what != 0;
    Memory memory;
    Upload of_test = upload(what);
    EXPECT_TRUE(same(of_test.run(memory, first.view(), {}), first));
    EXPECT_FALSE(of_test.told()[0].left_out) << "it was not there";
    EXPECT_TRUE(same(of_test.run(memory, second.view(), Moved(moved)), second));
    EXPECT_EQ(memory.topologies, all ? 2u : 1u);
    EXPECT_EQ(memory.spheres, all ? 80u : 43u);
    EXPECT_EQ(of_test.told()[0].left_out, !all);
    EXPECT_EQ(of_test.told()[0].reason, all ? "all is moved all the same"
                                            : "strands and neighbours lay there, and 3 of 40 spheres moved");
    EXPECT_EQ(of_test.told()[0].removed, all ? "" : "592 bytes of spheres");
  }
}

/// Of a range that goes on beyond the chain what is of the chain.
TEST(Upload, CountsWhatMovedWithinTheChain) {
  const Chain chain = row(0);
  const SphereRange beyond[] = {{3, 5}, {30, 1000}};
  Memory memory;
  Upload of_test = upload("");
  of_test.run(memory, chain.view(), {});
  of_test.run(memory, chain.view(), Moved(beyond));
  EXPECT_EQ(of_test.told()[0].reason, "strands and neighbours lay there, and 12 of 40 spheres moved");
  EXPECT_EQ(of_test.told()[0].removed, "448 bytes of spheres");
}

/// Where there is one open strand, the device gets a table only where it is asked for.
TEST(Upload, MovesAStrandTableWhereOneIsRead) {
  const Chain chain = row(0);
  for (const bool read : {false, true}) {
    Memory memory;
    Upload of_test = upload(read ? "strands=read" : "");
    EXPECT_EQ(of_test.run(memory, chain.view(), {}).exclusion.one_open_strand, !read);
    EXPECT_EQ(of_test.told()[1].step, "strand table");
    EXPECT_EQ(of_test.told()[1].left_out, !read);
  }
}

TEST(Upload, TakesNothingForThereThatIsNot) {
  const Chain one = row(0), another = row(3);
  Memory memory;
  Upload of_test = upload("");
  of_test.run(memory, one.view(), {});
  of_test.run(memory, another.view(), {});
  EXPECT_FALSE(of_test.told()[0].left_out) << "another chain";
  of_test.run(memory, another.view(), {});
  EXPECT_TRUE(of_test.told()[0].left_out);
  EXPECT_EQ(of_test.told()[0].removed, "0 bytes of spheres") << "everything may have moved";
  ChainView unknown = another.view();
  unknown.topology = 0;
  for (int k = 0; k < 2; ++k) of_test.run(memory, unknown, {});
  EXPECT_FALSE(of_test.told()[0].left_out) << "nobody knows whether it is the same chain";
  of_test.run(memory, another.view(), {});
  of_test.run(memory, another.view(), {});
  ASSERT_TRUE(of_test.told()[0].left_out);
  memory.full = true;
  EXPECT_THROW(of_test.run(memory, another.view(), {}), std::runtime_error);
  EXPECT_FALSE(of_test.told()[0].left_out) << "nor is what lay there before";
  memory.full = false;
  of_test.run(memory, another.view(), {});
  EXPECT_FALSE(of_test.told()[0].left_out) << "after what threw nothing is known";
}

}  // namespace
}  // namespace catena
