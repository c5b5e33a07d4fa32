"""What the page says of stiff and extreme scenes, counted here a second time from the lines of the run."""
import json
import unittest

import made
import pages
from catena_report import report, runfile
from catena_report.sections import stability, summary
from pages import recomputes

QUICK = made.REPORTS / "results" / "h200_quick.json.gz"
LINE = {
    "scene": "far:n=5", "n": 5, "variant": "aCPU2+CPU2/literal", "arithmetic": "literal", "outcome": "exact",
    "defect": False, "exact_pairs": 3, "missing": 0, "invented": 0, "worst_margin": 0.0, "wrong_counts": 0,
    "bounds": 8, "unenclosed": 0, "worst_shortfall": 0.0, "not_finite_nodes": 0,
}


class Cells(unittest.TestCase):
    def test_pairs_lead_then_counts_then_enclosure_by_size(self):
        short = {"outcome": "unenclosed", "unenclosed": 2}
        for changed, expected in (
            ({}, 0),
            ({**short, "worst_shortfall": 1e-16}, 1),
            ({**short, "worst_shortfall": 1e-12}, 2),
            ({**short, "worst_shortfall": 1e-9}, 2),
            ({**short, "worst_shortfall": 0.5}, 2),
            ({"outcome": "not finite", "not_finite_nodes": 1, "worst_shortfall": "nan"}, 3),
            ({"outcome": "wrong", "wrong_counts": 1}, 4),
            ({"outcome": "wrong", "missing": 1, "wrong_counts": 2}, 5),
            ({"outcome": "not finite", "not_finite_nodes": 1, "invented": 1}, 5),
            ({"outcome": "refused"}, 6),
            ({"outcome": "undecided"}, 6),
        ):
            self.assertEqual(stability.category({**LINE, **changed}), expected, changed)

    def test_cells_are_the_outcomes(self):
        value = made.run()
        (panel,) = pages.shown(value).figures["stability"].panels
        cells = sorted(cell for row in panel.heat.value for cell in row if cell is not None)
        codes = {"exact": 0, "unenclosed": 2, "wrong": 5, "not finite": 3, "refused": 6}
        self.assertEqual(cells, sorted(codes[line["outcome"]] for line in value["catena"]["stability"]))

    def test_a_bound_short_by_a_last_bit_is_no_failure(self):
        value = made.run()
        value["catena"]["stability"] = [
            {**LINE, "outcome": "unenclosed", "unenclosed": 3, "worst_shortfall": 3e-16}
        ]
        said = summary._stable(runfile.Run("run.json", json.loads(json.dumps(value))), "")
        self.assertIn("literal arithmetic in 100.0 % of 1 cases", said[0])


    def test_one_wrong_case_of_many_is_not_rounded_away(self):
        value = made.run(repetitions=1)
        value["catena"]["stability"] = [{**LINE, "variant": "aCPU2+CPU2"}] * 2049 + [{**LINE, "variant": "aCPU2+CPU2", "missing": 1}]
        run = pages.of(value)
        self.assertIn("robust arithmetic in &gt; 99.9 % of 2,050 cases", summary._stable(run, "")[0])
        (row,) = stability._table(report.Report([run]), run).rows
        self.assertEqual((row[2].text, row[3].text, row[7].text), ("> 99.9 %", "100.0 %", "100.0 %"))


class OfTheH200(unittest.TestCase):
    @recomputes("table:stability-shares")
    def test_every_share_is_counted_from_the_lines(self):
        run = runfile.load(QUICK)
        table = next(b for b in stability.build(report.Report([run])).blocks if hasattr(b, "rows"))
        for row in table.rows:
            name, cases, pairs, counts, missing, invented, trees, *sizes = [cell.raw for cell in row]
            whose = {"variant": name.removesuffix(" (peer)")}
            if name.endswith(" arithmetic"):
                whose = {"arithmetic": name.removesuffix(" arithmetic")}
            lines = [x for x in run.raw["catena"]["stability"] if whose.items() <= x.items()]
            of = [x for x in lines if x["bounds"] or x["not_finite_nodes"]]
            self.assertEqual((cases, trees), (len(lines), len(of)))
            self.assertAlmostEqual(pairs, sum(x["missing"] == x["invented"] == 0 for x in lines) / cases)
            self.assertAlmostEqual(counts, sum(x["wrong_counts"] == 0 for x in lines) / cases)
            self.assertEqual(int(missing.replace(",", "")), sum(x["missing"] for x in lines))
            self.assertEqual(int(invented.replace(",", "")), sum(x["invented"] for x in lines))
            finite = [x for x in of if not x["not_finite_nodes"]]
            short = [x["worst_shortfall"] for x in finite if x["unenclosed"]]
            bands = [sum(low <= value < high for value in short) for low, high in ((0, 1e-12), (1e-12, 1e-6), (1e-6, 1e99))]
            expected = [len(finite) - len(short), *bands, len(of) - len(finite)]
            for share, number in zip(sizes, expected):
                if trees:
                    self.assertAlmostEqual(share, number / trees)
                else:  # a peer shows no tree
                    self.assertEqual((share, number), ("", 0))

    @recomputes("figure:stability")
    def test_the_figure_has_every_line(self):
        run = runfile.load(QUICK)
        figure = next(b for b in stability.build(report.Report([run])).blocks if hasattr(b, "panels"))
        cells = [value for row in figure.panels[0].heat.value for value in row if value is not None]
        variants = figure.panels[0].x.categories  # an empty column parts the groups, and a word is where one begins
        begins = [at for at in range(len(variants)) if at == 0 or not variants[at - 1]]
        self.assertEqual([line.at + 0.5 for line in figure.panels[0].lines], begins)
        wrong = sum(x["missing"] + x["invented"] > 0 for x in run.raw["catena"]["stability"])
        self.assertEqual((len(cells), cells.count(5)), (len(run.raw["catena"]["stability"]), wrong))
        exact = sum(x["missing"] + x["invented"] > 0 and run.info(x["variant"]).exact for x in run.raw["catena"]["stability"])
        self.assertIn(f"Wrong pairs in {wrong:,} of", figure.title)
        self.assertIn(f", {exact or 'none'} of them of an exact variant", figure.title)


if __name__ == "__main__":
    unittest.main()
