"""Pivots: every cost is shown beside that of a rebuild, and the speed beside the published one."""
import unittest

import made
import pages
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
        self.assertEqual(table.title, "Several pivots at once cost less than a rebuild up to 64 of 100 points and 64 of 1,000 points")

    def test_the_title_has_the_fewest_pivots_that_cost_more(self):
        for row in self.value["catena"]["pivots"]["at_once"]:
            row["times"] = 0.5 if row["n"] == 1000 and row["pivots"] >= 8 else 2.0
        title = pages.Shown(pages.of(self.value)).tables["pivots"].title
        self.assertEqual(title, "Several pivots at once cost less than a rebuild up to 8 of 1,000 points")

    def test_the_published_speed_stands_beside(self):
        prose = pages.Shown(pages.of(self.value)).prose
        self.assertIn("1.50 µs an attempt", prose)
        self.assertIn("Published: 3.88 µs (somebody <b>)", prose)

    def test_answers_that_differ_are_told(self):
        self.value["catena"]["pivots"]["at_once"][0]["agree"] = False
        self.assertIn("1 answer DIFFER", pages.Shown(pages.of(self.value)).tables["pivots"].title)


if __name__ == "__main__":
    unittest.main()
