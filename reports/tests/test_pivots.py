"""Pivots: every cost is shown beside that of a rebuild, and the speed beside the published one."""
import re
import unittest

import made
import pages
from catena_report import report
from catena_report.sections import pivots
from pages import recomputes


class Pivots(unittest.TestCase):
    def setUp(self):
        self.value = made.run()

    @recomputes("table:pivots")
    def test_every_number_of_pivots_is_shown(self):
        table = pages.Shown(pages.of(self.value)).tables["pivots"]
        rows = self.value["catena"]["pivots"]["at_once"]
        self.assertEqual(len(table.rows), len(rows))
        for shown, row in zip(table.rows, rows):
            self.assertEqual([shown[k].raw for k in (0, 1, 2, 4)], [row[k] for k in ("n", "pivots", "us_per_attempt", "rebuild_us")])
            self.assertEqual(shown[5].raw, row["rebuild_us"] / row["us_per_attempt"])
            self.assertEqual(float(shown[3].text), round(row["acceptance"], 4))
        self.assertEqual(table.title, "Several pivots at once cost less than a rebuild up to 8 of 100 points and 8 of 1,000 points")

    def test_the_title_has_the_most_pivots_that_cost_less(self):
        rows = self.value["catena"]["pivots"]["at_once"]
        for dear, said in (
            (lambda row: False, "less than a rebuild"),
            (lambda row: row["n"] == 1000 and row["pivots"] >= 64, "less than a rebuild up to 64 of 100 points and 8 of 1,000 points"),
            (lambda row: row["n"] == 1000 and row["pivots"] >= 8, "less than a rebuild up to 64 of 100 points, and no less of 1,000 points"),
            (lambda row: True, "no less than a rebuild"),
        ):
            for row in rows:
                row["times"] = 0.5 if dear(row) else 2.0
            title = pivots.build(report.Report([pages.of(self.value)])).blocks[1].title
            self.assertEqual(title, f"Several pivots at once cost {said}")
            for k, n in re.findall(r"(\d+) of ([\d,]+) points", title):
                self.assertFalse(any(dear(row) for row in rows if row["n"] == int(n.replace(",", "")) and row["pivots"] <= int(k)))

    def test_the_published_speed_stands_beside(self):
        prose = pages.Shown(pages.of(self.value)).prose
        self.assertIn("1.50 µs an attempt on one core, and 12.0 bytes a point; 0.250 of 64,000 attempts were accepted", prose)
        self.assertIn("Published: 3.88 µs (somebody &lt;b&gt;)", prose)
        self.assertIn("<code>catena pivot --n 1000 --warm-up 4000 --moves 64000</code>", prose)

    def test_answers_that_differ_are_told(self):
        self.value["catena"]["pivots"]["at_once"][0]["agree"] = False
        self.assertIn("1 answer DIFFER", pages.Shown(pages.of(self.value)).tables["pivots"].title)


if __name__ == "__main__":
    unittest.main()
