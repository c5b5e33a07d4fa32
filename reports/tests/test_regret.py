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
            self.assertEqual([cell.text for cell in row[1:4]], [one["chosen"], one["best"], one["clock"]])
            auto, best = plain.median(one["auto_ms"]), plain.median(one["best_ms"])
            self.assertAlmostEqual(row[4].raw, auto)
            self.assertAlmostEqual(row[5].raw, best)
            self.assertAlmostEqual(row[6].raw / (auto / best), 1, delta=0.02)

    def test_the_title_counts_and_averages(self):
        run, table, sizes = self.table()
        values = [row[6].raw for row in table.rows]
        near = sum(value <= 1.05 for value in values)
        mean = math.exp(sum(math.log(value) for value in values) / len(values))
        self.assertIn(f"on {near} of {len(values)} chains", sizes.title)
        self.assertIn(f"{mean:.3g} times", sizes.title)
        self.assertLess(near, len(values))

    @recomputes("table:regret-sizes")
    def test_every_size_is_summed_up(self):
        run, table, sizes = self.table()
        by_size = {}
        for row in table.rows:
            by_size.setdefault(int(row[0].text.rpartition("/n:")[2]), []).append(row[6].raw)
        self.assertEqual([row[0].raw for row in sizes.rows], sorted(by_size))
        for row in sizes.rows:
            values = by_size[row[0].raw]
            self.assertEqual(row[1].raw, len(values))
            self.assertAlmostEqual(row[2].raw, math.prod(values) ** (1 / len(values)))
            self.assertEqual(row[3].raw, max(values))
            self.assertEqual(row[4].raw, sum(value > 1.05 for value in values))

    def test_a_run_of_before_clocks_were_told_was_by_the_wall(self):
        for row in self.value["catena"]["regret"]:
            del row["clock"]
        run, table, sizes = self.table()
        self.assertEqual({row[3].text for row in table.rows}, {"wall"})

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
