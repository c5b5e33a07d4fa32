"""How sure a run is: false alarms against itself, and the slowdown that it would have seen."""
import re
import unittest
import unittest.mock

import made
import numpy
from catena_report import certainty, report, statistics, words
from catena_report.sections import environment, summary
from pages import of


class Certain(unittest.TestCase):
    def test_the_critical_u_is_the_tabulated_one(self):
        # Mann and Whitney's U at 5 % two-sided: at most 13 of 64 (8 against 8), 37 of 144 (12 against 12).
        self.assertEqual([certainty.critical(8), certainty.critical(12)], [64 - 13, 144 - 37])

    def test_samples_of_one_kind_raise_few_false_alarms_and_a_slowdown_is_seen(self):
        generator = numpy.random.default_rng(4)
        run = of(made.run(noise=0.03, repetitions=12))
        found = certainty.certainty(run)
        self.assertLess(found.false_alarms / found.cases, 0.08)
        self.assertEqual(found.cases, len(run.samples))
        seen = 0
        for _ in range(200):
            old = generator.normal(1, 0.03, 12)
            new = generator.normal(found.smallest[0], 0.03, 12)
            seen += statistics.mann_whitney(new, old) < 0.05
        self.assertGreater(seen / 200, 0.85)

    def test_the_smallest_slowdown_is_the_least_that_is_seen_in_nineteen_of_twenty(self):
        times = numpy.random.default_rng(5).lognormal(0, 1, 8)
        factor = certainty.smallest_slowdown(times, numpy.random.default_rng(2))
        old, new = numpy.random.default_rng(2).choice(times, (2, certainty.DRAWS, 8))

        def seen(by):
            above = (by * new[:, None, :] >= old[:, :, None]).sum(axis=(1, 2))
            return (above >= 64 - 13).mean()  # Mann and Whitney's table

        self.assertGreaterEqual(seen(factor * 1.000001), 0.95)
        self.assertLess(seen(factor * 0.999), 0.95)

    def test_of_all_cases_the_median_and_nine_in_ten_are_told(self):
        run = of(made.run(repetitions=12))
        factors = iter(range(1, 1 + len(run.samples)))
        with unittest.mock.patch.object(certainty, "smallest_slowdown", lambda *_: next(factors)):
            half, most = certainty.certainty(run).smallest
        self.assertAlmostEqual(half, 1 + 0.5 * (len(run.samples) - 1))
        self.assertAlmostEqual(most, 1 + 0.9 * (len(run.samples) - 1))

    def test_of_few_uncertain_cases_nine_in_ten_tell_and_half_do_not(self):
        """One case in six is of ten times the noise."""
        generator = numpy.random.default_rng(6)
        value = made.run(repetitions=12, noise=0.01)
        for row in value["benchmarks"]:
            if "/GPU1/" in row["name"]:
                row["real_time"] *= generator.lognormal(0, 0.2)
        share = sum("/GPU1/" in row["name"] for row in value["benchmarks"]) / len(value["benchmarks"])
        self.assertTrue(0.1 < share < 0.5)
        run = of(value)
        half, most = certainty.certainty(run).smallest
        told = [words.significant(100 * (factor - 1), 2) + " %" for factor in (half, most)]
        for text in (summary._certain(run, "")[0], environment._certain(report.Report([run]), run)):
            self.assertRegex(text, ".*".join(map(re.escape, told)))
        self.assertLess(half, 1.05)
        self.assertGreater(most, 1.1)

    def test_cases_of_too_few_samples_are_of_all_but_not_judged(self):
        value = made.run(repetitions=12)
        value["benchmarks"] = [
            row
            for row in value["benchmarks"]
            if "/GPU1/" not in row["name"] or row.get("repetition_index", 0) < certainty.FEWEST - 1
        ]
        run = of(value)
        found = certainty.certainty(run)
        self.assertEqual(found.of, len(run.samples))
        self.assertEqual(found.cases, sum(len(times) >= certainty.FEWEST for times in run.samples.values()))
        self.assertTrue(0 < found.cases < found.of)

    def test_a_load_that_comes_and_goes_in_every_round_is_a_false_alarm(self):
        value = made.run(repetitions=12)
        for row in value["benchmarks"]:
            if "repetition_index" in row:
                row["real_time"] *= 1 + 0.5 * (row["repetition_index"] % 2)
        found = certainty.certainty(of(value))
        self.assertEqual(found.false_alarms, found.cases)
        self.assertIn("(100.0 %) were called different", " ".join(summary._certain(of(value), "")))


if __name__ == "__main__":
    unittest.main()
