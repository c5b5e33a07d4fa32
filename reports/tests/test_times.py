"""Times over the number of spheres: every point and exponent from the rows of the run."""
import math
import statistics as plain
import unittest

import made
import pages
from pages import recomputes


class Times(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.value = made.run()
        cls.shown = pages.shown(cls.value)

    def milliseconds(self, scene, n, trace, stage):
        """The samples of a curve, from the rows alone; a construction's pools the variants that begin with it."""
        found = []
        for row in self.value["benchmarks"]:
            parts = row["name"].removesuffix("/manual_time").split("/")
            name, arithmetic = parts[2], "/".join(parts[3:-1])
            if stage in ("build", "update"):
                name = name.partition("+")[0]
            if (
                row.get("real_time")
                and parts[:2] == [scene, f"n:{n}"]
                and parts[-1] == stage
                and "/".join(filter(None, (name, arithmetic))) == trace
            ):
                found.append(row["real_time"] / 1e6)
        return found

    @recomputes("figure:times-build", "figure:times-update", "figure:times-find", "figure:times-whole")
    def test_points_are_the_medians_of_the_samples_and_bars_their_order_statistics(self):
        seen = 0
        for stage in ("build", "update", "find", "whole"):
            for panel in self.shown.figures[f"times-{stage}"].panels:
                scene, each, _ = panel.title.partition(", for each sphere")
                for series in panel.series:
                    for at, (n, y) in enumerate(zip(series.x, series.y)):
                        times = sorted(self.milliseconds(scene, n, series.name, stage))
                        self.assertTrue(times)
                        self.assertAlmostEqual(y, plain.median(times) * (1e6 / n if each else 1), places=9)
                        if not each and len(times) == 8:  # Conover: the first and the last of eight
                            self.assertAlmostEqual(series.low[at], times[0], places=12)
                            self.assertAlmostEqual(series.high[at], times[-1], places=12)
                        ns = series.hover[at].removesuffix(" ns a sphere").rpartition("<br>")[2].replace(",", "")
                        self.assertAlmostEqual(float(ns) * n / 1e6, plain.median(times), delta=0.006 * plain.median(times))
                        seen += 1
        self.assertGreater(seen, 100)

    def test_nobody_is_fastest_where_nobody_else_was_timed(self):
        """At the largest n that at least two were timed at; one alone beats nobody."""
        value = made.run()
        value["benchmarks"] = [
            row for row in value["benchmarks"] if "/n:100000/" not in row["name"] or "/aCPU2+CPU2/" in row["name"]
        ]
        title = pages.shown(value).figures["times-find"].title
        self.assertIn("aGPU2+GPUv2 is fastest on path1 and path2", title)

    @recomputes("table:exponents")
    def test_exponents_find_the_law_of_the_data_by_least_squares(self):
        head = self.shown.tables["exponents"].columns
        stages = {"construction": "build", "update of a moved frame": "update", "traversal": "find", "whole call": "whole"}
        for row in self.shown.tables["exponents"].rows:
            given = [(scene, cell) for scene, cell in zip(head[2:], row[2:]) if cell.text]
            self.assertEqual(len(given), 1 if row[0].text.startswith("update") else 2)  # path2 does not move
            for scene, cell in given:
                x = [math.log(n) for n in made.SIZES]
                y = [
                    math.log(plain.median(self.milliseconds(scene, n, row[1].text, stages[row[0].text])))
                    for n in made.SIZES
                ]
                self.assertAlmostEqual(cell.raw, plain.linear_regression(x, y).slope)
                self.assertAlmostEqual(cell.raw, 1, delta=0.05)

    @recomputes("table:times")
    def test_a_chain_alone_of_its_scene_has_its_times_in_a_table(self):
        """As a file has, and be it of one variant: no curve goes through one point."""
        value = made.run()
        value["benchmarks"] = [row for row in value["benchmarks"] if row["name"].startswith("path1/n:3000/aCPU2+")]
        for kept in (value["benchmarks"], [row for row in value["benchmarks"] if "/aCPU2+Dual/" in row["name"]]):
            shown = pages.shown({**value, "benchmarks": kept})
            self.assertNotIn("figure:times-find", shown.keys())
            table = shown.tables["times"]
            stages = {"construction": "build", "update of a moved frame": "update", "traversal": "find", "whole call": "whole"}
            for row in table.rows:
                for column, cell in zip(table.columns[2:], row[2:]):
                    stage = stages[column.removesuffix(", ms")]
                    times = [
                        one["real_time"] / 1e6 for one in kept
                        if one["name"].removesuffix("/manual_time") == f"path1/n:3000/{row[1].text}/{stage}"
                    ]
                    self.assertAlmostEqual(cell.raw, plain.median(times))
            named = {row["name"].removesuffix("/manual_time").split("/n:3000/")[1].rpartition("/")[0] for row in kept}
            self.assertEqual([row[0].text for row in table.rows], ["path1/n:3000"] * len(named))
            self.assertEqual({row[1].text for row in table.rows}, named)
            whole = [row[-1].raw for row in table.rows]
            self.assertEqual(whole, sorted(whole))
        self.assertNotIn("table:times", self.shown.keys())  # curves show all of it


if __name__ == "__main__":
    unittest.main()
