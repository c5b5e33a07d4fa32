"""The stiff rope: shares of failing starts with their intervals, and no verdict from one start."""
import json
import unittest

import made
from catena_report import report, runfile, statistics
from catena_report.sections import motion
import pages
from pages import recomputes


def of(value):
    return runfile.Run("run.json", json.loads(json.dumps(value)))


class Share(unittest.TestCase):
    def test_wilson_as_in_newcombe_1998(self):
        for number, all_, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0, 0.1611)):
            found = statistics.share(number, all_)
            self.assertAlmostEqual(found.low, low, places=4)
            self.assertAlmostEqual(found.high, high, places=4)


class Verdicts(unittest.TestCase):
    def setUp(self):
        self.value = made.run()
        self.lines = self.value["catena"]["motion"]

    def test_the_arithmetic_is_at_fault_only_where_intervals_part(self):
        run = of(self.value)
        found = {(line["variant"], line["step"]): fault for line, _, fault in motion.faults(run, run.list("motion"))}
        self.assertEqual(found, {("aCPU2+CPU2/literal", 2.0): False, ("aCPU2+CPU2/literal", 1.0): True})
        figure = motion._shares(report.Report([run]), run, run.list("motion"))
        self.assertIn("literal at stiffness 100, step 1", figure.title)
        self.assertNotIn("step 2", figure.title)

    def test_a_few_more_failing_starts_are_chance(self):
        for line in self.lines:
            failing = 15 if "/" in line["variant"] else 8
            for start in line["starts"]:
                start["outcome"] = "slipped" if start["seed"] <= failing else "holds"
        run = of(self.value)
        self.assertEqual({fault for _, _, fault in motion.faults(run, run.list("motion"))}, {False})
        self.assertIn("no verdict", " ".join(motion._verdicts(run, run.list("motion")).points))

    def test_a_start_fails_by_slipping_and_by_diverging(self):
        outcomes = ["holds"] * 5 + ["slipped"] * 2 + ["diverged"]
        found = motion.failing({"starts": [{"outcome": outcome} for outcome in outcomes]})
        self.assertEqual(found, statistics.share(3, 8))

    def test_what_was_missed_and_invented_is_summed_over_the_starts(self):
        for line in self.lines:
            for start in line["starts"]:
                start.update(missed=3, invented=5, contacts=7)
        starts = len(self.lines[0]["starts"])
        said = " ".join(motion._verdicts(of(self.value), of(self.value).list("motion")).points)
        self.assertIn(f"It missed {3 * starts:,} and invented {5 * starts:,} of {7 * starts:,} contacts", said)

    def test_a_panel_of_the_drift_is_of_one_rope(self):
        far = [{**line, "offset": 1e7, "energy_drift": 0.5} for line in self.lines]
        near = [{**line, "offset": 0, "energy_drift": 0.25} for line in self.lines]
        near[0]["energy_drift"], near[1]["energy_drift"] = 0, "nan"  # no point of a logarithmic axis
        self.value["catena"]["motion"] = far + near
        run = of(self.value)
        panels = motion._drift(report.Report([run]), run, run.list("motion")).panels
        drifts = {panel.title: {y for series in panel.series for y in series.y} for panel in panels}
        self.assertEqual(drifts, {"stiffness 100": {0.25}, "stiffness 100, offset 1e+07": {0.5}})

    def test_a_rope_that_diverged_does_not_hold(self):
        for line, outcome in zip(self.lines, ("holds", "slipped", "diverged", "holds", "diverged", "holds")):
            line["outcome"] = outcome
        run = of(self.value)
        figure = motion._outcomes(report.Report([run]), run, run.list("motion"))
        self.assertIn("The rope holds in 3 of 6 first starts of motions", figure.title)

    def test_an_arithmetic_is_held_against_the_exact_one_of_the_same_place(self):
        for line in self.lines:
            if "/" not in line["variant"]:
                line["offset"] = 1e7
        self.assertEqual(motion.faults(of(self.value), of(self.value).list("motion")), [])

    def test_one_start_says_nothing(self):
        for line in self.lines:
            del line["starts"]
        run = of(self.value)
        self.assertIn("no arithmetic is called at fault", motion._verdicts(run, run.list("motion")).text)
        keys = [block.key for block in motion.build(report.Report([run])).blocks if hasattr(block, "panels")]
        self.assertNotIn("motion-shares", keys)

    @recomputes("figure:motion-shares")
    def test_every_share_is_counted_from_the_starts(self):
        run = of(self.value)
        figure = motion._shares(report.Report([run]), run, run.list("motion"))
        drawn = {
            figure.panels[0].y.categories[row]: (x, low, high)
            for series in figure.panels[0].series
            for row, x, low, high in zip(series.y, series.x, series.low, series.high)
        }
        self.assertEqual(len(drawn), len(self.lines))
        for line in self.lines:
            fails = sum(start["outcome"] != "holds" for start in line["starts"])
            name = f"stiffness 100, step {line['step']:g}: {line['variant']}"
            expected = statistics.share(fails, 32)
            self.assertEqual(drawn[name], (fails / 32, expected.low, expected.high))
        for series in figure.panels[0].series:
            of_series = [figure.panels[0].y.categories[row].rpartition(": ")[2] for row in series.y]
            self.assertEqual({f"{run.info(variant).arithmetic} arithmetic" for variant in of_series}, {series.name})


class EveryMotion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lines = made.run()["catena"]["motion"]
        cls.shown = pages.shown(made.run())

    @recomputes("figure:motion-outcome")
    def test_a_cell_is_the_outcome_of_its_line(self):
        figure = self.shown.figures["motion-outcome"]
        (panel,) = figure.panels
        cells = {
            (row, float(step)): value
            for row, values in zip(panel.y.categories, panel.heat.value)
            for step, value in zip(panel.x.categories, values)
            if value is not None
        }
        shown = [float(step) for step in panel.x.categories]
        self.assertEqual(shown, sorted(shown, reverse=True))
        told = " ".join(text for texts in panel.heat.hover for text in texts)
        for line in self.lines:
            self.assertIn(f"{line['missed_by_variant']} missed and {line['invented_by_variant']} invented", told)
        codes = {"holds": 0, "slipped": 1, "diverged": 2}
        self.assertEqual(
            cells, {(f"stiffness 100: {line['variant']}", line["step"]): codes[line["outcome"]] for line in self.lines}
        )
        held = sum(line["outcome"] == "holds" for line in self.lines)
        self.assertIn(f"holds in {held} of {len(self.lines)} first starts", figure.title)

    @recomputes("figure:motion-drift")
    def test_the_drift_of_every_line(self):
        (panel,) = self.shown.figures["motion-drift"].panels
        for series in panel.series:
            mine = sorted((x["step"], x["energy_drift"]) for x in self.lines if x["variant"] == series.name)
            self.assertEqual(list(zip(series.x, series.y)), mine)
        self.assertEqual({series.name for series in panel.series}, {line["variant"] for line in self.lines})

    @recomputes("table:motion")
    def test_every_number_of_the_table(self):
        keys = (
            "step", "energy_drift", "deepest_penetration", "contacts", "missed_by_variant", "invented_by_variant",
            "missed_against_fine_step", "ms_median",
        )
        self.assertEqual(
            [row[3:] for row in self.shown.raw("motion")], [[line[key] for key in keys] for line in self.lines]
        )


if __name__ == "__main__":
    unittest.main()
