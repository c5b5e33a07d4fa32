"""The statistics against values known otherwise."""
import math
import unittest

import numpy

import made  # noqa: F401  (finds the package)
from catena_report import statistics


class Intervals(unittest.TestCase):
    def test_median_covers_the_true_median(self):
        generator = numpy.random.default_rng(11)
        inside = sum(1.0 in statistics.median(generator.lognormal(0, 0.2, 25)) for _ in range(300))
        self.assertGreater(inside, 300 * 0.90)
        self.assertLess(inside, 300)  # an interval that always holds it is no 95 % interval

    def test_few_samples_give_their_range(self):
        self.assertEqual(statistics.median([3.0, 1.0, 2.0]), statistics.Interval(2.0, 1.0, 3.0))

    def test_median_takes_the_tabulated_order_statistics(self):
        """As bench/timing/median_interval_test.cpp: Conover 1999, two-sided 95 %."""
        for n, low, high in ((6, 1, 6), (9, 2, 8), (20, 6, 15), (50, 18, 33), (100, 40, 61)):
            self.assertEqual(statistics.rank_of_bound(n), low)
            found = statistics.median(range(n, 0, -1))
            self.assertEqual((found.low, found.high), (low, high), n)
        self.assertEqual(statistics.rank_of_bound(5), 0)
        self.assertEqual(statistics.median([1.0, 2.0]).value, 1.5)

    def test_ratio_covers_the_true_ratio(self):
        generator = numpy.random.default_rng(17)
        draw = lambda centre: centre * generator.lognormal(0, 0.2, 25)  # noqa: E731
        inside = sum(1.5 in statistics.ratio(draw(3), draw(2)) for _ in range(400))
        self.assertGreater(inside, 400 * 0.92)
        self.assertLess(inside, 400)

    def test_ratio_by_hand(self):
        # Six samples: the intervals are the ranges. Of new median 4 in [2, 8], of old 2 in [1, 4]: every end is
        # a factor 2 away, so the ratio's are 2^sqrt(2) away.
        found = statistics.ratio([2, 4, 4, 4, 4, 8], [1, 2, 2, 2, 2, 4])
        self.assertAlmostEqual(found.value, 2)
        self.assertAlmostEqual(found.low, 2 / 2 ** math.sqrt(2))
        self.assertAlmostEqual(found.high, 2 * 2 ** math.sqrt(2))
        self.assertEqual(statistics.ratio([2, 4, 8], [1, 2, 4]), statistics.Interval(2.0, 0.5, 8.0))

    def test_ratio_turned_around_is_its_inverse(self):
        new, old = [3, 4, 4, 4, 5, 20], [1, 1.9, 2, 2, 2, 2.1]  # of which one leans up and one down
        there, back = statistics.ratio(new, old), statistics.ratio(old, new)
        self.assertAlmostEqual(there.low * back.high, 1)
        self.assertAlmostEqual(there.high * back.low, 1)
        # By hand: down ln 4/3 and ln 2.1/2, up ln 20/4 and ln 2/1.
        self.assertAlmostEqual(there.low, 2 * math.exp(-math.hypot(math.log(4 / 3), math.log(1.05))))
        self.assertAlmostEqual(there.high, 2 * math.exp(math.hypot(math.log(5), math.log(2))))

    def test_ratio_of_five_is_in_their_range(self):
        self.assertEqual(
            statistics.ratio([2, 3, 4, 5, 8], [1, 2, 2, 2, 4]), statistics.Interval(2.0, 0.5, 8.0)
        )
        six, five = [2, 3, 4, 4, 5, 8], [1, 2, 2, 2, 4]
        self.assertEqual(statistics.ratio(six, five), statistics.Interval(2.0, 0.5, 8.0))
        self.assertEqual(statistics.ratio(five, six), statistics.Interval(0.5, 0.125, 2.0))

    def test_mean_log_is_students(self):
        # Logarithms 0, 1 and 2 times ln 2: their deviation is ln 2; t of 2 degrees of freedom 4.30265.
        found = statistics.mean_log([1, 2, 4])
        reach = 4.30265 * math.log(2) / math.sqrt(3)
        self.assertAlmostEqual(found.value, 2)
        self.assertAlmostEqual(math.log(found.high / found.value), reach, places=4)
        self.assertAlmostEqual(math.log(found.value / found.low), reach, places=4)
        self.assertAlmostEqual(statistics.mean_log([1, 4]).high, 2 * math.exp(12.7062 * math.log(2)), delta=1)
        self.assertEqual(statistics.mean_log([3.0]).low, 0)
        self.assertEqual(statistics.mean_log([3.0]).high, math.inf)

    def test_share_is_wilsons(self):
        for number, of, low, high in ((8, 10, 0.490162, 0.943318), (0, 10, 0, 0.277533), (10, 10, 0.722467, 1)):
            found = statistics.share(number, of)
            self.assertAlmostEqual(found.value, number / of)
            self.assertAlmostEqual(found.low, low, places=5)
            self.assertAlmostEqual(found.high, high, places=5)

    def test_ratio(self):
        generator = numpy.random.default_rng(5)
        found = statistics.ratio(generator.normal(3, 0.1, 40), generator.normal(2, 0.1, 40))
        self.assertAlmostEqual(found.value, 1.5, delta=0.05)
        self.assertTrue(1.4 < found.low < 1.5 < found.high < 1.6)
        self.assertTrue(math.isfinite(statistics.ratio([1.0, 1.0], [0.0, 0.0]).value))

    def test_exponent_of_a_power_law(self):
        ns = numpy.array([1e3, 1e4, 1e5, 1e6])
        found = statistics.exponent(ns, 3e-4 * ns**1.5)
        self.assertAlmostEqual(found.value, 1.5)
        self.assertAlmostEqual(found.high - found.low, 0, places=6)
        self.assertIsNone(statistics.exponent([10, 20, 30], [1, 2, 3]))
        self.assertIsNone(statistics.exponent([10, 10, 20, 30], [1, 2, 3, 4]))
        # What took no time that a clock sees is on no power law.
        self.assertAlmostEqual(statistics.exponent([1, 2, 4, 8, 16, 0], [1, 2, 4, 8, 0, 3]).value, 1)
        self.assertIsNone(statistics.exponent([1, 2, 4, 8], [0, 2, 4, 8]))

    def test_exponent_interval_is_students(self):
        # By hand: x = ln n = 0, 1, 2, 3; y = 0, 1, 2.3, 3; slope 1.03, residuals -.03, -.06, .21, -.12, s^2 = .0315,
        # s_b = sqrt(.0063)
        found = statistics.exponent(numpy.exp([0, 1, 2, 3]), numpy.exp([0, 1, 2.3, 3]))
        self.assertAlmostEqual(found.value, 1.03)
        self.assertAlmostEqual(found.high - found.value, 4.30265 * math.sqrt(0.0063), places=4)


class Tests(unittest.TestCase):
    def test_mann_whitney_exact(self):
        # Completely separated 5 and 5: two of the 252 orders.
        self.assertAlmostEqual(statistics.mann_whitney([1, 2, 3, 4, 5], [6, 7, 8, 9, 10]), 2 / 252)
        self.assertAlmostEqual(statistics.least_p(5, 5), 2 / 252)
        self.assertEqual(statistics.mann_whitney([1, 1], [1, 1]), 1.0)
        self.assertLess(statistics.mann_whitney([1] * 9, [2] * 9), 0.001)

    def test_holm(self):
        # Holm 1979's rule by hand: .01*4, .03*3, .04*2 (not below the one before), .005*... sorted .005 .01
        # .03 .04
        self.assertEqual(
            numpy.round(statistics.holm([0.01, 0.04, 0.03, 0.005]), 3).tolist(), [0.03, 0.06, 0.06, 0.02]
        )


class Best(unittest.TestCase):
    def test_separates_and_joins(self):
        generator = numpy.random.default_rng(2)
        samples = {
            "slow": generator.normal(2, 0.01, 20),
            "quick": generator.normal(1, 0.05, 20),
            "alike": generator.normal(1.001, 0.05, 20),
        }
        leader, alike = statistics.best(samples)
        self.assertEqual({leader, *alike}, {"quick", "alike"})

    def test_the_leader_has_the_least_median(self):
        samples = {"a": [2, 2, 2, 2, 90], "of the least mean": [3] * 5, "of the least sample": [0.1, 4, 4, 4, 4]}
        self.assertEqual(statistics.best(samples)[0], "a")

    def test_four_samples_apart_differ_at_5_percent_from_one_or_by_their_ranges_from_more(self):
        four = {name: range(first, first + 4) for name, first in (("a", 1), ("b", 5), ("c", 9))}
        self.assertGreater(statistics.least_p(4, 4), 0.025)
        self.assertEqual(statistics.best({"a": four["a"], "b": four["b"]}), ("a", []))
        self.assertGreater(2 * statistics.least_p(4, 4), 0.05)  # of two others no test can decide
        self.assertEqual(statistics.best(four), ("a", []))

    def test_few_samples_are_told_apart_by_their_ranges(self):
        leader, alike = statistics.best({"a": [1, 2, 3], "b": [2.5, 3, 4], "c": [100, 101, 102]})
        self.assertEqual((leader, alike), ("a", ["b"]))
        # Ranges that touch are not told apart; fewer than three samples, not within a factor of 2 of the worst.
        self.assertEqual(statistics.best({"a": [1, 2, 3], "b": [3, 4, 5]}), ("a", ["b"]))
        self.assertEqual(statistics.best({"a": [1, 1.1, 1.2], "b": [2.3], "c": [2.5]}), ("a", ["b"]))  # too few of one
        self.assertEqual(statistics.best({"a": [1, 1.1, 1.2], "b": [1.3, 1.4, 1.5]}), ("a", []))
        two = {"a": [1, 1.2], "b": [2.3, 2.5], "c": [2.5, 2.6]}
        self.assertEqual(statistics.best(two), ("a", ["b"]))


if __name__ == "__main__":
    unittest.main()
