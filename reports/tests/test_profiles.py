"""The rank test over all chains: where it is made, and what it is of."""
import math
import types
import unittest
import unittest.mock

import made
import pages
from catena_report import profiles, statistics, style
from catena_report.sections import slowdown


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

    def test_a_power_is_never_told_as_more_than_it_is(self):
        said = profiles.in_words(profiles.RankTest("first", 8, 2, 0.799, {}))
        self.assertIn("with a probability of 0.79 only", said)


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

    def test_it_is_made_from_enough_power_itself_on(self):
        for power, made_ in ((profiles.ENOUGH, True), (math.nextafter(profiles.ENOUGH, 0), False)):
            with unittest.mock.patch.object(profiles, "signed_rank_power", return_value=power):
                found = {
                    name: profiles.Slowdown({f"a/n:{k}": ratio for k in range(1, 9)}, None, 8)
                    for name, ratio in (("first", 1.0), ("other", 2.0))
                }
                run = types.SimpleNamespace(info=lambda name: types.SimpleNamespace(recommended=True))
                self.assertEqual(bool(profiles.rank_test(run, found).p), made_, power)


class Slowdowns(unittest.TestCase):
    """Of three variants over four chains."""

    def setUp(self):
        ends = {"a": (1.0, 0.9, 1.2), "b": (1.3, 1.1, 1.5), "c": (1.5, 1.25, 1.8)}
        ratios = {"a/n:1": 1, "a/n:2": 1.05, "a/n:3": 1.5, "a/n:4": 2.5}
        self.found = {
            name: profiles.Slowdown(ratios, statistics.Interval(*end), 4) for name, end in ends.items()
        }
        info = lambda name: types.SimpleNamespace(recommended=True, peer=False, label=name)  # noqa: E731
        self.run_ = types.SimpleNamespace(info=info)

    def test_beside_the_best_are_those_whose_intervals_begin_below_the_end_of_its_own(self):
        with unittest.mock.patch.object(profiles, "slowdowns", return_value=self.found):
            name, _, near = slowdown.headline(self.run_)
        self.assertEqual((name, near), ("a", ["b"]))

    def test_no_interval_of_a_slowdown_begins_below_one(self):
        shared = types.SimpleNamespace(look=lambda run, name: style.Look("c0"), key=lambda run: "")
        with unittest.mock.patch.object(profiles, "slowdowns", return_value=self.found):
            figure = slowdown._figure(shared, self.run_, self.found)
        self.assertEqual([(s.low, s.high) for s in figure.panels[1].series], [([1.0], [1.2]), ([1.1], [1.5]), ([1.25], [1.8])])
        self.assertIn("a takes 1.00 [1.00, 1.20] times", figure.title)

    def test_twice_the_time_of_the_fastest_is_within_twice(self):
        slow = profiles.Slowdown({"a/n:1": 1.0, "a/n:2": 2.0, "a/n:3": 2.1}, None, 4)
        self.assertEqual([slowdown._within(slow, 2).text, slowdown._within(slow, 1.1).text], ["50 %", "25 %"])


if __name__ == "__main__":
    unittest.main()
