"""The regret of auto, computed a second time from the rows of the run."""
import json
import math
import statistics as plain
import unittest

import made
from catena_report import report, runfile
from catena_report.sections import regret
from pages import recomputes


class Made(unittest.TestCase):
    def setUp(self):
        self.value = made.run()

    def table(self):
        run = runfile.Run("run.json", json.loads(json.dumps(self.value)))
        sizes, table = regret.build(report.Report([run])).blocks
        return run, table, sizes

    @recomputes("table:regret")
    def test_every_row_is_shown_with_its_medians(self):
        run, table, sizes = self.table()
        given = {row["input"]: row for row in run.list("regret")}
        self.assertEqual({row[0].text for row in table.rows}, set(given))
        for row in table.rows:
            one = given[row[0].text]
            self.assertEqual(
                [cell.text for cell in row[1:5]], [one["first"], one["chosen"], one["best"], one["clock"]]
            )
            first, best = plain.median(one["first_ms"]), plain.median(one["best_first_ms"])
            self.assertAlmostEqual(row[5].raw, first)
            self.assertAlmostEqual(row[6].raw, best)
            self.assertAlmostEqual(row[7].raw / (first / best), 1, delta=0.02)
            settled = plain.median(one["auto_ms"]) / plain.median(one["best_ms"])
            self.assertAlmostEqual(row[8].raw / settled, 1, delta=0.02)

    def test_the_title_counts_and_averages(self):
        run, table, sizes = self.table()
        values = [row[7].raw for row in table.rows]
        near = sum(value <= 1.05 for value in values)
        mean = math.exp(sum(math.log(value) for value in values) / len(values))
        self.assertIn(f"on {near} of {len(values)} chains", sizes.title)
        self.assertTrue(sizes.title.startswith("At once auto took"), sizes.title)
        self.assertIn(f"{mean:.3g} times as much", sizes.title)
        settled = [row[8].raw for row in table.rows]
        self.assertIn(f"after some 40 searches {math.prod(settled) ** (1 / len(settled)):.3g} times", sizes.title)
        self.assertLess(near, len(values))

    @recomputes("table:regret-sizes")
    def test_every_size_is_summed_up(self):
        run, table, sizes = self.table()
        by_size = {}
        for row in table.rows:
            by_size.setdefault(int(row[0].text.rpartition("/n:")[2]), []).append((row[7].raw, row[8].raw))
        self.assertEqual([row[0].raw for row in sizes.rows], sorted(by_size))
        for row in sizes.rows:
            values, settled = zip(*by_size[row[0].raw])
            self.assertEqual(row[1].raw, len(values))
            self.assertAlmostEqual(row[2].raw, math.prod(values) ** (1 / len(values)))
            self.assertEqual(row[3].raw, max(values))
            self.assertEqual(row[4].raw, sum(value > 1.05 for value in values))
            self.assertAlmostEqual(row[5].raw, math.prod(settled) ** (1 / len(settled)))
            self.assertEqual(row[6].raw, max(settled))

    def test_a_slow_first_choice_shows_though_it_was_mended(self):
        for row in self.value["catena"]["regret"]:
            row["first_ms"] = [8 * ms for ms in row["best_first_ms"]]
            row["auto_ms"] = row["best_ms"]
        run, table, sizes = self.table()
        self.assertIn(f"on 0 of {len(table.rows)} chains", sizes.title)
        self.assertIn("8.00 times as much", sizes.title)
        self.assertIn("after some 40 searches 1.00 times", sizes.title)

    def test_a_run_of_before_the_first_choice_was_measured_claims_nothing_of_it(self):
        for row in self.value["catena"]["regret"]:
            del row["first"], row["first_ms"], row["best_first_ms"]
        run, table, sizes = self.table()
        given = {row["input"]: row for row in run.list("regret")}
        for row in table.rows:
            one = given[row[0].text]
            self.assertEqual([cell.text for cell in row[1:4]], [one["chosen"], one["best"], one["clock"]])
            settled = plain.median(one["auto_ms"]) / plain.median(one["best_ms"])
            self.assertAlmostEqual(row[6].raw / settled, 1, delta=0.02)
        self.assertTrue(sizes.title.startswith("After some 40 searches auto took at most 5 % more"), sizes.title)
        self.assertIn("was not measured", sizes.caption)

    def test_a_run_of_before_clocks_were_told_was_by_the_wall(self):
        for row in self.value["catena"]["regret"]:
            del row["clock"]
        run, table, sizes = self.table()
        self.assertEqual({row[4].text for row in table.rows}, {"wall"})

    def test_five_per_cent_are_not_more_than_five(self):
        self.assertEqual([cell.raw for cell in regret._summed([1.05, 1.0500001, 1.0])[2:]], [1])

    def test_a_row_without_times_is_left_out(self):
        self.value["catena"]["regret"][0]["best_ms"] = []
        run, table, sizes = self.table()
        self.assertEqual(len(table.rows), len(run.list("regret")) - 1)

    def test_no_rows_no_section(self):
        del self.value["catena"]["regret"]
        run = runfile.Run("run.json", json.loads(json.dumps(self.value)))
        self.assertIsNone(regret.build(report.Report([run])))


if __name__ == "__main__":
    unittest.main()
