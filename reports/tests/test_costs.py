"""What is counted, asked for, left out, updated and paid for exactness: each number a second time from the raw rows."""
import math
import statistics as plain
import unittest

import scipy.stats

import made
import pages
from catena_report import words
from pages import recomputes


def spread(samples):
    """(median, low, high) of eight samples: no order statistics but the first and the last hold it in 95 %."""
    return plain.median(samples), min(samples), max(samples)


def ratio(new, old):
    """The ratio of medians and its interval by MOVER on logarithms, written out for two sets of eight."""
    (a, a_low, a_high), (b, b_low, b_high) = spread(new), spread(old)
    down = math.hypot(math.log(a / a_low), math.log(b_high / b))
    up = math.hypot(math.log(a_high / a), math.log(b / b_low))
    return a / b, a / b * math.exp(-down), a / b * math.exp(up)


class Costs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.value = made.run()
        cls.catena = cls.value["catena"]
        # Another chain in motion, with other pairs; of one frame nothing is drawn.
        frames = cls.catena["animation"][0]["frames"]
        others = [{**frame, "pairs": 7 * frame["pairs"] + 1} for frame in frames]
        cls.catena["animation"] += [
            {"input": "path2/n:10000", "variant": "aCPU2+CPU2", "frames": others},
            {"input": "path1/n:1000", "variant": "aCPU2+CPU2", "frames": frames[:1]},
        ]
        cls.shown = pages.shown(cls.value)

    def close(self, found, expected):
        self.assertEqual(len(found), len(expected))
        for one, other in zip(found, expected):
            self.assertAlmostEqual(one, other)

    @recomputes("figure:counts", "table:counts")
    def test_counts(self):
        names = {"pair tests": "pair_tests", "node visits": "node_visits", "bytes moved": "bytes"}
        seen = 0
        for panel in self.shown.figures["counts"].panels:
            scene, _, kind = panel.title.partition(": ")
            for series in panel.series:
                for n, y, told in zip(series.x, series.y, series.hover):
                    (row,) = [
                        row for row in self.catena["counts"]
                        if (row["input"], row["variant"]) == (f"{scene}/n:{n}", series.name)
                    ]
                    self.assertAlmostEqual(y, row[names[kind]] / n)
                    self.assertAlmostEqual(y, float(told.split()[-3].replace(",", "")), delta=0.01 * y)
                    seen += 1
        self.assertEqual(seen, 3 * len(self.catena["counts"]))
        rows = {(row["input"], row["variant"]): [row[key] for key in names.values()] for row in self.catena["counts"]}
        self.assertEqual({(i, v): numbers for i, v, *numbers in self.shown.raw("counts")}, rows)

    def test_a_count_of_none_is_shown_and_one_that_was_not_made_is_not(self):
        value = made.run()
        row = value["catena"]["counts"][0]
        row["node_visits"] = 0
        del row["bytes"]
        (shown,) = (cells for cells in pages.shown(value).rows("counts") if cells[:2] == [row["input"], row["variant"]])
        self.assertEqual(shown[3:], ["0", ""])

    @recomputes("table:exactness")
    def test_what_exactness_costs(self):
        """Geometric mean over the chains of the ratios of medians, and its t interval."""
        times = {}
        for row in self.value["benchmarks"]:
            if "real_time" in row:
                times.setdefault(row["name"].removesuffix("/manual_time"), []).append(row["real_time"])
        ((name, construction, traversal),) = self.shown.tables["exactness"].rows
        self.assertEqual(name.text, "aCPU2+CPU2/literal")
        every = []
        for cell, stage in ((construction, "build"), (traversal, "find")):
            logs = [
                math.log(
                    plain.median(times[f"{scene}/n:{n}/aCPU2+CPU2/{stage}"])
                    / plain.median(times[f"{scene}/n:{n}/aCPU2+CPU2/literal/{stage}"])
                )
                for scene in made.SCENES
                for n in made.SIZES
            ]
            every += logs
            self.assertEqual(cell.hint, f"{len(logs)} chains, {math.exp(min(logs)):.2f} to {math.exp(max(logs)):.2f}")
            mean, reach = plain.mean(logs), scipy.stats.t.ppf(0.975, len(logs) - 1) * plain.stdev(logs) / len(logs) ** 0.5
            self.assertAlmostEqual(cell.raw, math.exp(mean))
            self.assertEqual(
                cell.text, f"{math.exp(mean):.2f} [{math.exp(mean - reach):.2f}, {math.exp(mean + reach):.2f}]"
            )
        self.assertIn(f"take {math.exp(plain.mean(every)):.2f} times as long", self.shown.tables["exactness"].title)
        self.assertIn(f"of {len(every)} cases", self.shown.tables["exactness"].title)

    def test_what_is_quick_by_losing_pairs_is_no_price_of_exactness(self):
        for stage, wrong in (("find", "missing"), ("build", "missing"), ("find", "invented")):  # one of them tells of both
            value = made.run()
            for row in value["benchmarks"]:
                if f"/n:1000/aCPU2+CPU2/literal/{stage}" in row["name"]:
                    row |= {"real_time": row["real_time"] / 1000, wrong: 40.0}
            lossy = pages.shown(value).tables["exactness"]
            self.assertIn("2 pairs of chain and variant left out", lossy.caption)
            value["benchmarks"] = [row for row in value["benchmarks"] if "/n:1000/aCPU2+CPU2/literal" not in row["name"]]
            self.assertEqual(lossy.as_csv(), pages.shown(value).tables["exactness"].as_csv())

    @recomputes("table:wants")
    def test_what_is_asked_for(self):
        rows = self.shown.raw("wants")
        self.assertEqual(self.shown.tables["wants"].columns[2:], ["any, ms", "counts, ms", "pairs, ms"])
        self.assertEqual(3 * len(rows), len(self.catena["wants"]))
        for input_, variant, *found in rows:
            mine = {
                row["want"]: plain.median(row["ms"])
                for row in self.catena["wants"]
                if (row["input"], row["variant"]) == (input_, variant)
            }
            self.close(found, [mine[want] for want in ("any", "counts", "pairs")])

    @recomputes("figure:savings", "table:savings")
    def test_savings(self):
        series = self.shown.figures["savings"].panels[0].series[0]
        saved = [row for row in self.catena["savings"] if row["what"] != "hierarchy"]
        ratios = sorted((ratio(row["with_ms"], row["without_ms"]) for row in saved), reverse=True)
        self.close(series.x, [value for value, _, _ in ratios])
        self.close(series.low, [low for _, low, _ in ratios])
        self.close(series.high, [high for _, _, high in ratios])
        faster = sum(low > 1 for _, low, _ in ratios)
        self.assertIn(f"was faster in {faster} of {len(ratios)} cases", self.shown.figures["savings"].title)
        for row, raw in zip(self.shown.raw("savings"), saved, strict=True):
            self.assertEqual(row[:4], [raw["input"], raw["what"], raw["reason"], "identical"])
            self.close(
                row[4:],
                [plain.median(raw["with_ms"]), plain.median(raw["without_ms"]), ratio(raw["with_ms"], raw["without_ms"])[0]],
            )

    def test_what_is_slower_without_is_told_by_the_worst(self):
        value = made.run()
        row = value["catena"]["savings"][0]
        self.assertNotIn("slower", self.shown.figures["savings"].title)
        left_out = {"what": "hierarchy", "reason": "of 20 spheres (--no-omit hierarchy)"}
        for several, slower in enumerate((8, 2), 1):
            value["catena"]["savings"].append({**row, **left_out, "without_ms": [slower * ms for ms in row["with_ms"]]})
            title = pages.shown(value).figures["savings"].title
            self.assertTrue(title.endswith(f", slower in {several}: up to 8 times (hierarchy, {row['input']})"), title)

    def test_of_many_savings_those_that_make_the_most_difference_have_bars(self):
        value = made.run()
        row = next(row for row in value["catena"]["savings"] if row["what"] != "hierarchy")
        many = [
            {**row, "input": f"path1/n:{n}", "with_ms": [factor * ms for ms in row["without_ms"]]}
            for n, factor in enumerate([*(1 + k / 100 for k in range(50)), 1 / 8])
        ]
        many[1]["identical"] = False  # though it has no bar
        value["catena"]["savings"] = many
        shown = pages.shown(value)
        figure, bars = shown.figures["savings"], shown.figures["savings"].panels[0].series[0]
        self.close(bars.x, [*(1 + k / 100 for k in range(49, 10, -1)), 1 / 8])
        self.assertIn(" of 51 cases, slower in 1: up to 8 times", figure.title)
        self.assertTrue(figure.title.endswith(", and gave another result in 1"), figure.title)
        self.assertIn("Shown are the 40 cases that make the most difference; the table has all 51.", figure.caption)
        self.assertEqual(len(shown.raw("savings")), 51)
        self.assertNotIn("Shown are", self.shown.figures["savings"].caption)

    @recomputes("figure:crossover", "table:crossover")
    def test_the_scan_over_n_is_a_crossover_and_no_saving(self):
        rows = [row for row in self.catena["savings"] if row["what"] == "hierarchy"]
        figure = self.shown.figures["crossover"]
        self.assertEqual(figure.title, "Comparing all pairs is faster than a hierarchy up to 30 spheres, and slower from 100 on")
        for series, key in zip(figure.panels[0].series, ("with_ms", "without_ms"), strict=True):
            self.assertEqual([f"path1/n:{n}" for n in series.x], [row["input"] for row in rows])
            self.close(series.y, [plain.median(row[key]) for row in rows])
        for shown, raw in zip(self.shown.raw("crossover"), rows, strict=True):
            self.assertEqual(shown[:3], [raw["input"], raw["reason"], "identical"])
            medians = [plain.median(raw[key]) for key in ("with_ms", "without_ms")]
            self.close(shown[3:], [*medians, medians[0] / medians[1]])

    def test_lengths_that_do_not_cross_once_are_told_one_by_one(self):
        value = made.run()
        scan = [row for row in value["catena"]["savings"] if row["what"] == "hierarchy"]
        scan[-1]["with_ms"], scan[-1]["without_ms"] = [8.0] * 6, [1.0] * 6
        self.assertEqual(
            pages.shown(value).figures["crossover"].title,
            "Comparing all pairs is faster than a hierarchy at 10, 30 and 3,000 spheres, and slower at 100 spheres",
        )

    def test_a_scan_of_which_one_side_is_not_seen(self):
        value = made.run()
        rows = value["catena"]["savings"] = [row for row in value["catena"]["savings"] if row["what"] == "hierarchy"]
        shown = pages.shown(value)
        self.assertNotIn("savings", shown.figures)
        self.assertNotIn("savings", shown.tables)
        rows[0]["identical"] = False
        for factor, said in ((1e6, "at no length, and slower at 10, 30, 100 and 3,000 spheres"),
                             (1e-12, "at 10, 30, 100 and 3,000 spheres, and slower at no length")):
            for row in rows:
                row["without_ms"] = [factor * ms for ms in row["without_ms"]]
            title = pages.shown(value).figures["crossover"].title
            self.assertEqual(title, f"Comparing all pairs is faster than a hierarchy {said}; another result in 1")

    def test_the_greatest_saving_is_drawn_first(self):
        value = made.run()
        rows = value["catena"]["savings"]
        for turn in (list, reversed):
            value["catena"]["savings"] = [
                {**row, "what": f"saved {saved}", "with_ms": [saved * ms for ms in row["without_ms"]]}
                for saved, row in turn([*enumerate(rows, start=1)])
            ]
            (panel,) = pages.shown(value).figures["savings"].panels
            self.close(panel.series[0].x, range(len(rows), 0, -1))
            said = [f"saved {saved}" for saved in range(len(rows), 0, -1)]
            self.assertEqual([name.rpartition(": ")[2] for name in panel.y.categories], said)

    def test_a_saving_that_changes_the_answer_is_said(self):
        value = made.run()
        value["catena"]["savings"][0].update(identical=False, with_ms=[1e-3] * 8)  # drawn last
        shown = pages.shown(value)
        self.assertIn("gave another result in 1", shown.figures["savings"].title)
        self.assertEqual(shown.rows("savings")[0][3], "DIFFERENT")

    @recomputes("table:coherence")
    def test_update_against_a_new_chain(self):
        for row, raw in zip(self.shown.raw("coherence"), self.catena["coherence"], strict=True):
            self.assertEqual(row[:3], [raw["input"], raw["variant"], "update is faster"])
            expected = [plain.median(raw["rebuild_ms"]), plain.median(raw["update_ms"])]
            self.close(row[3:], [*expected, expected[0] / expected[1]])

    def test_who_is_faster_is_told_by_the_medians(self):
        """Mann-Whitney tells these apart, though the interval of their ratio holds 1."""
        slow = [1.12, 1.22, 1.19, 1.19, 1.28, 1.0, 1.06, 0.99, 1.11, 1.22]
        quick = [1.0, 1.05, 0.81, 1.01, 0.91, 1.18, 1.09, 1.09, 0.99, 1.06]
        for rebuild, update, verdict in ((slow, quick, "update is faster"), (quick, slow, "rebuild is faster")):
            value = made.run()
            value["catena"]["coherence"] = [{**value["catena"]["coherence"][0], "rebuild_ms": rebuild, "update_ms": update}]
            (row,) = pages.shown(value).rows("coherence")
            self.assertEqual(row[2], verdict)

    @recomputes("figure:animation")
    def test_frames(self):
        figure = self.shown.figures["animation"]
        rows = [row for row in self.catena["animation"] if len(row["frames"]) > 1]
        took = {}
        for input_, (times, pairs) in zip(dict.fromkeys(row["input"] for row in rows), zip(*[iter(figure.panels)] * 2), strict=True):
            mine = [row for row in rows if row["input"] == input_]
            for series, row in zip(times.series, mine, strict=True):
                self.assertEqual((series.name, series.x), (row["variant"], [frame["frame"] for frame in row["frames"]]))
                self.assertEqual([chain["frame"] for chain in series.chains], series.x)
                self.close(series.y, [frame["update_ms"] + frame["find_ms"] for frame in row["frames"]])
                took.setdefault(series.name, []).extend(series.y)
                for frame, text in zip(row["frames"], series.hover):
                    self.assertIn(f"update {words.ms(frame['update_ms'])}, find {words.ms(frame['find_ms'])} ms", text)
            self.assertEqual(pairs.series[0].y, [frame["pairs"] for frame in mine[0]["frames"]])
        medians = {name: plain.median(those) for name, those in took.items()}
        fastest = min(medians, key=medians.get)
        self.assertIn(f"A frame takes {medians[fastest]:.3f} ms with {fastest}", figure.title)


if __name__ == "__main__":
    unittest.main()
