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

}  // namespace
}  // namespace catena::reference
