"""The rank test over all chains: where it is made, and what it is of."""
import types
import unittest

import made
import pages
from catena_report import profiles


class Ranks(unittest.TestCase):
    def test_power_by_hand(self):
        self.assertEqual(profiles.signed_rank_power(5, 0.05), 0)  # 2 / 2^5 > 5 %
        self.assertAlmostEqual(profiles.signed_rank_power(6, 0.05), 0.9**6 + 0.1**6)

    def test_it_is_made_where_it_can_tell(self):
        value = made.run()
        value["benchmarks"] = [
            {**row, "name": row["name"].replace("/n:", f":copy={copy}/n:")}
            for row in value["benchmarks"]
            for copy in range(4)
        ]
        run = pages.of(value)
        test = profiles.rank_test(run, profiles.slowdowns(run))
        self.assertGreater(test.power, profiles.ENOUGH)
        self.assertEqual(test.first, "aGPU2+GPU2")
        self.assertTrue(all(p < 0.05 for p in test.p.values()))


class RankTest(unittest.TestCase):
    """Of 20 chains, whose ratios are known."""

    @staticmethod
    def p(first, other):
        found = {
            name: profiles.Slowdown({f"a/n:{k}": ratio for k, ratio in enumerate(ratios, 1)}, None, 20)
            for name, ratios in (("first", first), ("other", other))
        }
        run = types.SimpleNamespace(info=lambda name: types.SimpleNamespace(recommended=True))
        return profiles.rank_test(run, found).p["other"]

    def test_it_is_of_the_differences_to_the_first(self):
        slower, turns = [1 + k / 10 for k in range(1, 21)], [1 + k / 10 if k % 2 else 1 for k in range(1, 21)]
        others = [1 if k % 2 else 1 + k / 10 for k in range(1, 21)]
        self.assertLess(self.p([1] * 20, slower), 1e-4)
        self.assertEqual(self.p(slower, slower), 1)
        self.assertGreater(self.p(turns, others), 0.5)


if __name__ == "__main__":
    unittest.main()
