#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "catena/reference/certificate.h"

namespace catena::reference {
namespace {

/// A search that tests neighbours accounts for them; they are no pair of the answer for that.
TEST(CertificateLines, ANeighbourThatIsTestedIsNoPair) {
  const Chain chain({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}});
  for (const Accounting accounting : {Accounting::from_both_ends, Accounting::each_pair}) {
    EvidenceTree tree(chain);
    tree.complete();
    CertificateChecker checker(chain, tree, accounting, {});
    for (std::uint32_t i = 0; i < 3; ++i)
      for (std::uint32_t j = 0; j < 3; ++j)
        if (i < j || (i > j && accounting == Accounting::from_both_ends)) checker.tested(i, j);
    EXPECT_TRUE(checker.report().holds()) << checker.report().fault();
    EXPECT_EQ(std::move(checker).answer().pairs, (std::vector<Pair>{{0, 2}}));
  }
}

/// Of leaves and of inner nodes, whichever stands first.
TEST(CertificateLines, BoundsThatMeetAreNotSeparate) {
  const Chain chain({{0, 0, 0, 1}, {3, 0, 0, 1}, {6, 0, 0, 1}, {9, 0, 0, 1}});
  for (const double radius : {2.5, 7.0}) {
    const Sphere64 left{1.5, 0, 0, radius}, right{7.5, 0, 0, radius};
    EvidenceTree tree(chain);
    const auto leaf = [&](std::uint32_t i) { return Sphere64{3.0 * i, 0, 0, 1}; };
    for (const std::uint32_t i : {0, 1}) tree.edge(4, left, i, leaf(i));
    for (const std::uint32_t i : {2, 3}) tree.edge(5, right, i, leaf(i));
    for (const std::uint32_t id : {4, 5}) tree.edge(6, Sphere64{4.5, 0, 0, 20}, id, id == 4 ? left : right);
    tree.complete();
    for (const auto& [a, b] : {std::pair(4, 5), {5, 4}, {0, 5}, {5, 0}, {2, 4}, {4, 2}}) {
      CertificateChecker checker(chain, tree, Accounting::from_both_ends, {});
      checker.discarded(a, b);
      EXPECT_EQ(checker.report().unknown, 0u);
      EXPECT_EQ(checker.report().not_separate, radius > 3) << a << ' ' << b << ' ' << radius;
    }
  }
}

}  // namespace
}  // namespace catena::reference
