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
        (table,) = regret.build(report.Report([run])).blocks
        return run, table

    @recomputes("table:regret")
    def test_every_row_is_shown_with_its_medians(self):
        run, table = self.table()
        given = {row["input"]: row for row in run.list("regret")}
        self.assertEqual({row[0].text for row in table.rows}, set(given))
        for row in table.rows:
            one = given[row[0].text]
            self.assertEqual([row[1].text, row[2].text], [one["chosen"], one["best"]])
            auto, best = plain.median(one["auto_ms"]), plain.median(one["best_ms"])
            self.assertAlmostEqual(row[3].raw, auto)
            self.assertAlmostEqual(row[4].raw, best)
            self.assertAlmostEqual(row[5].raw / (auto / best), 1, delta=0.02)

    def test_the_title_counts_and_averages(self):
        run, table = self.table()
        values = [row[5].raw for row in table.rows]
        near = sum(value <= 1.05 for value in values)
        mean = math.exp(sum(math.log(value) for value in values) / len(values))
        self.assertIn(f"on {near} of {len(values)} chains", table.title)
        self.assertIn(f"{mean:.3g} times", table.title)
        self.assertLess(near, len(values))

    def test_a_row_without_times_is_left_out(self):
        self.value["catena"]["regret"][0]["best_ms"] = []
        run, table = self.table()
        self.assertEqual(len(table.rows), len(run.list("regret")) - 1)

    def test_no_rows_no_section(self):
        del self.value["catena"]["regret"]
        run = runfile.Run("run.json", json.loads(json.dumps(self.value)))
        self.assertIsNone(regret.build(report.Report([run])))


if __name__ == "__main__":
    unittest.main()
