"""Three errors apart: what the page says of the tube, the arithmetic and the answer, from the raw lines."""
import json
import math
import statistics as plain
import unittest

import made
from catena_report import report, runfile, variant
from catena_report.sections import work_precision
import pages
from pages import recomputes

QUICK = made.REPORTS / "results" / "h200_quick.json.gz"


def of(value):
    return runfile.Run("run.json", json.loads(json.dumps(value)))


def with_rounded(answer_error=0.0):
    """Points of aCPU2+CPU2 and, a tenth faster, of its literal twin."""
    value = made.run()
    points = [p for p in value["catena"]["work_precision"]["points"] if p["variant"] == "aCPU2+CPU2"]
    quicker = {key: 0.9 for key in ("lower_quartile_ms", "median_ms", "upper_quartile_ms")}
    points += [
        {
            **p,
            **{key: p[key] * factor for key, factor in quicker.items()},
            "variant": "aCPU2+CPU2/literal",
            "arithmetic": "literal",
            "answer_error": answer_error,
            "exact_pairs": 100, "missing": round(100 * answer_error), "invented": 0, "worst_margin": 0.5,
            "depth_error": 0.25 if answer_error else 0.0, "stored_error": 0.125,
        }
        for p in points
    ]
    value["catena"]["work_precision"]["points"] = points
    return of(value)


class Headline(unittest.TestCase):
    def test_it_says_what_exactness_costs_and_what_rounding_loses(self):
        run = with_rounded(0.07)
        points = run.catena["work_precision"]["points"]
        self.assertEqual(work_precision._message(run, points), "Literal ones get up to 7 % of the pairs wrong, 1.11 times as quick where they do")

    def test_what_is_quick_by_losing_pairs_is_no_price_of_exactness(self):
        run = with_rounded()
        points = run.catena["work_precision"]["points"]
        self.assertIn("Exact answers take 1.11 [1.11, 1.11] times as long as literal ones;", work_precision._message(run, points))
        lossy = [{**p, "answer_error": 0.5, "median_ms": p["median_ms"] / 10, "tube": "far"} for p in points if "/" in p["variant"]]
        exact = [{**p, "tube": "far"} for p in points if "/" not in p["variant"]]
        said = work_precision._message(run, points + exact + lossy)
        self.assertIn("Exact answers take 1.11 [1.11, 1.11] times as long as literal ones that are right;", said)
        self.assertIn("50 % of the pairs wrong, 11.11 times as quick where they do", said)

    def test_variants_on_one_chain_are_one_ratio_of_it(self):
        run = with_rounded()
        points = run.catena["work_precision"]["points"]
        run._described["aCPU2+Dual/literal"] = variant.Variant.of("aCPU2+Dual/literal", made.described("aCPU2+Dual/literal"))
        other = [{**p, "variant": p["variant"].replace("CPU2+CPU2", "CPU2+Dual"), "median_ms": p["median_ms"] * (1 if "/" in p["variant"] else 4)} for p in points]
        (ratios,) = work_precision.prices(run, points + other).values()
        self.assertEqual(len(ratios), len(made.SIZES))
        for ratio in ratios:
            self.assertAlmostEqual(ratio, 2 / 0.9)

    def test_a_rounded_variant_is_on_no_front_however_fast(self):
        run = with_rounded()
        best = work_precision.front(run, run.catena["work_precision"]["points"])
        self.assertEqual({p["variant"] for p in best}, {"aCPU2+CPU2"})
        self.assertIn("no answer was wrong", work_precision._message(run, run.catena["work_precision"]["points"]))

    def test_errors_of_the_answer_have_panels_of_their_own(self):
        run = with_rounded(0.07)
        figure = work_precision._figure(report.Report([run]), run, run.catena["work_precision"]["points"])
        self.assertEqual(
            [panel.title for panel in figure.panels],
            ["helix: of the tube", "helix: of the answer", "helix: contact depth lost"],
        )
        self.assertEqual({y for series in figure.panels[2].series for y in series.y}, {0.25})
        tube = {y for s in figure.panels[0].series for y in s.y if s.name == "beaten, or rounded"}
        self.assertEqual(tube, {10 / n + 0.125 for n in made.SIZES})


class OfTheH200(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = runfile.load(QUICK)
        cls.blocks = work_precision.build(report.Report([cls.run_])).blocks

    def test_the_price_of_exactness_is_that_of_its_points(self):
        points = self.run_.raw["catena"]["work_precision"]["points"]
        exact = {(p["offset"], p["n"], p["variant"]): p["median_ms"] for p in points if p["arithmetic"] == "robust"}
        ratios = {}
        for p in points:
            if p["variant"].endswith("/literal") and p["answer_error"] == 0:
                ratio = exact[p["offset"], p["n"], p["variant"].removesuffix("/literal")] / p["median_ms"]
                ratios.setdefault((p["tube"], p["offset"], p["n"]), []).append(ratio)
        mean = plain.geometric_mean(map(plain.geometric_mean, ratios.values()))
        figure = next(b for b in self.blocks if getattr(b, "key", "") == "work-precision")
        self.assertIn(f"take {mean:.2f} [", figure.title.partition("double ones")[2])

    @recomputes("figure:arithmetic")
    def test_the_curves_of_the_arithmetic_are_the_lines_of_the_matrix(self):
        figure = next(b for b in self.blocks if getattr(b, "key", "") == "arithmetic")
        lines = self.run_.raw["catena"]["stability"]
        seen = 0
        for scene, option, panel in (("far", "exponent", 0), ("grazing", "margin", 2)):
            for series in figure.panels[panel].series:
                for x, y in zip(series.x, series.y):
                    mine = [
                        line for line in lines
                        if line["arithmetic"] == series.name
                        and line["scene"].startswith(f"{scene}:n={line['n']},{option}=")
                        and line["scene"].count(",") == 1
                        and math.isclose(float(line["scene"].rpartition("=")[2]), math.log2(x) if scene == "far" else x)
                    ]
                    worst = max((line["missing"] + line["invented"]) / max(1, line["exact_pairs"]) for line in mine)
                    self.assertAlmostEqual(y, 100 * worst)
                    seen += 1
        self.assertGreaterEqual(seen, 30)
        literal = next(s for s in figure.panels[0].series if s.name == "literal")
        self.assertGreater(literal.y[-1], 0)  # at 2^24 radii
        self.assertIn("for contacts with a margin of 1e-07 and less", figure.title)


class EveryPoint(unittest.TestCase):
    def setUp(self):
        self.value = with_rounded(0.07).raw
        self.points = self.value["catena"]["work_precision"]["points"]
        self.shown = pages.shown(self.value)

    @recomputes("figure:work-precision")
    def test_every_point_lies_at_its_median_and_its_error(self):
        tube, answer, depth = self.shown.figures["work-precision"].panels
        drawn = lambda panel: sorted(  # noqa: E731
            (x, y, low, high)
            for series in panel.series
            if series.markers
            for x, y, low, high in zip(series.x, series.y, series.low, series.high)
        )
        raw = lambda error, points: sorted(  # noqa: E731
            (p["median_ms"], error(p), p["lower_quartile_ms"], p["upper_quartile_ms"]) for p in points
        )
        wrong = [p for p in self.points if p["answer_error"] > 0]
        self.assertEqual(drawn(tube), raw(lambda p: p["tube_error"] + p.get("stored_error", 0), self.points))
        self.assertEqual(drawn(answer), raw(lambda p: p["answer_error"], wrong))
        self.assertEqual(drawn(depth), raw(lambda p: p["depth_error"], wrong))

    @recomputes("table:errors-apart")
    def test_of_each_arithmetic_the_worst_answer_and_the_least_time(self):
        head = self.shown.tables["errors-apart"].columns
        rows = [dict(zip(head, row)) for row in self.shown.raw("errors-apart")]
        self.assertEqual(len(rows), 2 * len(made.SIZES))
        for row in rows:
            mine = [p for p in self.points if (p["arithmetic"], p["n"]) == (row["arithmetic"], row["n"])]
            self.assertEqual(row["pairs wrong"], max(p["answer_error"] for p in mine))
            self.assertEqual(row["fastest, ms"], min(p["median_ms"] for p in mine))
            self.assertEqual(row["of the tube"], mine[0]["tube_error"])
            self.assertEqual(row["missing"], mine[0].get("missing", ""))


if __name__ == "__main__":
    unittest.main()
