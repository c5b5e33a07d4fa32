"""What spheres make of a tube: points and slopes from the lines of the run."""
import math
import statistics as plain
import unittest

import made
import pages
from pages import recomputes

MEASURES = {"deepest dip between spheres": "gap", "volume missing": "volume_deficit", "error of contact depth": "depth_error"}


class Tubes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lines = made.run()["catena"]["tube_errors"]
        cls.shown = pages.shown(made.run())

    def points(self, tube, key):
        return sorted((line["spacing"], line[key]) for line in self.lines if line["tube"] == tube)

    @recomputes("figure:tube-errors")
    def test_every_point_is_a_line_and_the_law_has_slope_two(self):
        for panel in self.shown.figures["tube-errors"].panels:
            *curves, law = panel.series
            self.assertEqual([series.name for series in curves], ["helix", "rod"])
            for series in curves:
                self.assertEqual(list(zip(series.x, series.y)), self.points(series.name, MEASURES[panel.title]))
            (x0, x1), (y0, y1) = law.x, law.y
            self.assertAlmostEqual(math.log(y1 / y0) / math.log(x1 / x0), 2)

    @recomputes("table:tube-slopes")
    def test_slopes_by_least_squares_over_the_smaller_half(self):
        head = self.shown.tables["tube-slopes"].columns
        slopes = []
        for row in self.shown.tables["tube-slopes"].rows:
            for title, cell in zip(head[1:], row[1:]):
                x, y = zip(*self.points(row[0].text, MEASURES[title])[:4])
                slopes.append(plain.linear_regression([*map(math.log, x)], [*map(math.log, y)]).slope)
                self.assertAlmostEqual(cell.raw, slopes[-1])
        self.assertIn(
            f"power {min(slopes):.2f} to {max(slopes):.2f}", self.shown.figures["tube-errors"].title
        )

    def test_the_larger_half_of_the_spacings_has_no_part_in_the_slope(self):
        value = made.run()
        value["catena"]["tube_errors"] = [
            {"tube": "helix", "n": 100, "spacing": h, **dict.fromkeys(MEASURES.values(), h * h if h <= 0.08 else 0.08 * h)}
            for h in (0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64, 1)
        ]
        shown = pages.shown(value)
        for cell in shown.tables["tube-slopes"].rows[0][1:]:
            self.assertAlmostEqual(cell.raw, 2)
        self.assertIn("power 2.00 to 2.00", shown.figures["tube-errors"].title)


if __name__ == "__main__":
    unittest.main()
