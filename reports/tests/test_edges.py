"""What sections say where a rule of theirs turns: each just on either side of its limit, on data made for it."""
import copy
import html
import math
import unittest

import made
import pages
from catena_report import paper, report, words
from catena_report.sections import (
    arithmetic, coherence, counts, memory, paper_tables, savings, slowdown, stability, steps, summary, times, tube_errors,
    work_precision,
)
from catena_report.statistics import Interval

from test_stability import LINE


def blocks(module, value):
    return module.build(report.Report([pages.of(value)])).blocks


class Base(unittest.TestCase):
    base = made.run(repetitions=6)

    def setUp(self):
        self.value = copy.deepcopy(self.base)
        self.catena = self.value["catena"]


class Times(Base):
    def test_who_is_fastest_is_told_of_the_largest_n(self):
        for row in self.value["benchmarks"]:
            if "/n:100000/aGPU2+GPUv2/find" in row["name"]:
                row["real_time"] *= 100
        find = next(block for block in blocks(times, self.value) if block.key == "times-find")
        self.assertIn("aGPU2+GPU2 is fastest on path1 and path2", find.title)

    def test_two_are_enough_for_one_to_be_fastest(self):
        two = ("aGPU2+GPU2", "aCPU2+Dual")
        kept = lambda name: "/n:100000/" not in name or name.split("/")[2] in two  # noqa: E731
        self.value["benchmarks"] = [row for row in self.value["benchmarks"] if kept(row["name"])]
        for row in self.value["benchmarks"]:
            if "/n:100000/aGPU2+GPU2/find" in row["name"]:
                row["real_time"] *= 1000
        find = next(block for block in blocks(times, self.value) if block.key == "times-find")
        self.assertIn("aCPU2+Dual is fastest on path1 and path2", find.title)

    def test_a_power_within_more_than_one_is_open(self):
        for low, high, is_open in ((1.0, 1.99, False), (1.0, 2.01, True), (0.0, 3.0, True)):
            cell = times._fit(Interval((low + high) / 2, low, high))
            self.assertEqual((cell.kind == "open", "open" in cell.text), (is_open, is_open))


class Slowdown(Base):
    def test_a_mean_without_some_chain_is_grey(self):
        self.value["benchmarks"] = [
            row for row in self.value["benchmarks"] if not row["name"].startswith("path1/n:1000/aCPU2+Dual/")
        ]
        (means,) = [panel for b in blocks(slowdown, self.value) for panel in getattr(b, "panels", [])[1:]]
        self.assertEqual({series.name for series in means.series if series.look.colour == "faint"}, {"aCPU2+Dual"})


class Memory(Base):
    def test_a_stage_is_above_the_copy_from_twice_its_time_on(self):
        """64 bytes a sphere; 100 ns to build, 800 and 200 to find."""
        for gb_s, above in ((10.0, (16, 16)), (1.0, (0, 16)), (0.45, (0, 8)), (0.1, (0, 0))):
            self.catena["bandwidth"]["gb_s"] = [gb_s] * 6
            roofline = next(block for block in blocks(memory, self.value) if block.key == "roofline")
            told = [f"{count} of 16 {stage}" for count, stage in zip(above, ("constructions", "traversals")) if count]
            self.assertIn(" and ".join(told) or "Memory may bound every construction and every traversal", roofline.title)
            self.assertNotIn(" 0 of", roofline.title)
            told = [text for panel in roofline.panels for series in panel.series[1:] for text in series.hover]
            self.assertEqual(len(told), 32)
            rate = lambda text: float(text.partition(" GB/s")[0].rpartition(" ")[2])  # noqa: E731
            self.assertEqual(sum(2 * rate(text) < gb_s for text in told), sum(above))

    def test_variants_that_build_nothing_have_a_table_and_no_figure(self):
        for row in self.catena["memory"]:
            row["variant"] = "CPU1"
        self.catena["variants"]["CPU1"] = made.described("CPU1")
        self.assertEqual([type(block).__name__ for block in blocks(memory, self.value) if block.key == "memory"], ["Table"])


class Costs(Base):
    def test_a_copy_of_the_chain_is_told_from_half_the_time_down(self):
        """32 bytes read and written; 800 and 200 ns."""
        for gb_s, says in (
            (0.36, "at most half the time of all 16 searches"),
            (0.28, "at most half the time of 8 of 16 searches"),
            (0.09, "at most half the time of 8 of 16 searches"),
            (0.07, "each of 16 searches the chain could be copied less than twice"),
        ):
            for copied in self.catena["bandwidth"]["sizes"]:
                copied["gb_s"] = [gb_s] * 6
            (table,) = blocks(steps, self.value)
            self.assertIn(says, table.title, gb_s)

    def test_a_saving_whose_interval_holds_one_is_none(self):
        slow, quick = [1.0, 1.2, 1.3] * 3, [1.0, 1.1, 1.2] * 3
        for row, (with_ms, without_ms) in zip(self.catena["savings"], ((slow, quick), ([9.0] * 9, quick))):
            row.update(with_ms=with_ms, without_ms=without_ms)
        figure = blocks(savings, self.value)[0]
        self.assertEqual([value > 1 for value in figure.panels[0].series[0].x], [True, True])
        self.assertIn("was faster in 1 of 2 cases", figure.title)

    def test_updates_differ_by_five_per_cent_and_beyond_chance(self):
        steady = [1 + 1e-4 * k for k in range(8)]
        times = lambda factor: [factor * t for t in steady]  # noqa: E731
        wild = [0.1, 10.0] * 4
        rows = [
            (times(1.04), steady, "update is faster by less than 5 %"),
            (times(1.06), steady, "update is faster"),
            (steady, times(1.04), "rebuild is faster by less than 5 %"),
            (steady, times(1.06), "rebuild is faster"),
            (wild, steady, "no significant difference"),
        ]
        self.catena["coherence"] = [
            {"input": "path1/n:1000", "variant": "aCPU2+CPU2", "rebuild_ms": rebuild, "update_ms": update}
            for rebuild, update, _ in rows
        ]
        (table,) = blocks(coherence, self.value)
        self.assertEqual([row[2].text for row in table.rows], [verdict for *_, verdict in rows])

    def test_counts_of_rounded_variants_wait_in_the_legend(self):
        self.catena["counts"] += [
            {**row, "variant": "aCPU2+CPU2/literal"} for row in self.catena["counts"] if row["variant"] == "aCPU2+CPU2"
        ]
        seen = set()
        for panel in blocks(counts, self.value)[0].panels:
            for series in panel.series:
                self.assertEqual(series.shown, series.name != "aCPU2+CPU2/literal")
                seen.add(series.name)
        self.assertIn("aCPU2+CPU2/literal", seen)


class Stability(Base):
    def test_what_was_refused_is_in_no_share(self):
        wrong, refused = {"outcome": "wrong", "missing": 2}, {"outcome": "refused", "reason": "too long"}
        self.catena["stability"] = [{**LINE, **changed} for changed in ({}, wrong, refused, refused, {"outcome": "unavailable"})]
        run = pages.of(self.value)
        table = next(b for b in stability.build(report.Report([run])).blocks if hasattr(b, "rows"))
        self.assertEqual([[cell.raw for cell in row[:4]] for row in table.rows], [["literal arithmetic", 2, 0.5, 1.0]])
        self.assertIn("literal arithmetic in 50.0 % of 2 cases", summary._stable(run, "")[0])

    def test_an_exact_variant_that_is_wrong_is_told_as_such(self):
        literal = {**LINE, "outcome": "wrong", "missing": 2}
        for variants, told in (
            (("aCPU2+CPU2/literal",) * 3, "Wrong pairs in 3 of 3 cases, none of them of an exact variant"),
            (("aCPU2+CPU2/literal", "aCPU2+CPU2", "aCPU2+Dual"), "Wrong pairs in 3 of 3 cases, 2 of them of an exact variant"),
        ):
            self.catena["stability"] = [{**literal, "scene": f"s{k}", "variant": v} for k, v in enumerate(variants)]
            figure = next(b for b in blocks(stability, self.value) if hasattr(b, "panels"))
            self.assertEqual(figure.title, told)

    def test_where_an_arithmetic_begins_to_fail(self):
        self.catena["stability"] = [
            {
                **LINE,
                "scene": f"{scene}:n=5,{parameter}={value}",
                "outcome": "wrong" if value in wrong else "exact",
                "missing": int(value in wrong),
            }
            for scene, parameter, values, wrong in (
                ("far", "exponent", (4, 10, 20, 22), (10, 20, 22)),
                ("grazing", "margin", (1e-8, 1e-6, 1e-4, 1e-2), (1e-8, 1e-6)),
            )
            for value in values
        ]
        title = lambda: arithmetic.figure(report.Report([pages.of(self.value)]), pages.of(self.value)).title  # noqa: E731
        self.assertIn(f"{2.0**10:.2g} radii from the origin on and for contacts with a margin of 1e-06 and less", title())
        self.assertNotIn("none", title())  # nothing else was run
        self.catena["stability"] += [
            {**line, "variant": "aCPU2+CPU2", "missing": 0, "outcome": "exact"} for line in self.catena["stability"]
        ]
        self.assertTrue(title().endswith("; robust none"), title())


class Errors(Base):
    def test_the_law_goes_through_the_middle_point(self):
        for panel in blocks(tube_errors, self.value)[0].panels:
            first, law = panel.series[0], panel.series[-1]
            middle = len(first.x) // 2
            for x, y in zip(law.x, law.y):
                self.assertAlmostEqual(y / first.y[middle], (x / first.x[middle]) ** 2)

    def points(self, *rows):
        """Of (variant, n, error of the tube, quartiles and median, what else)."""
        base = self.catena["work_precision"]["points"][0]
        return [
            {
                **base, "variant": variant, "n": n, "tube_error": error, "lower_quartile_ms": low, "median_ms": ms,
                "upper_quartile_ms": high, "arithmetic": self.catena["variants"][variant]["arithmetic"], **more,
            }
            for variant, n, error, (low, ms, high), more in rows
        ]

    def test_a_front_is_beaten_beyond_the_quartiles(self):
        points = self.points(
            ("aCPU2+CPU2", 10, 0.1, (0.9, 1.0, 1.2), {}),
            ("aCPU2+Dual", 10, 0.1, (1.1, 1.3, 1.4), {}),  # later, but its quartiles begin before the other's end
            ("GPU1", 10, 0.1, (1.2, 1.3, 1.4), {}),  # they begin where the other's end
            ("aGPU2+GPU2", 10, 0.1, (1.3, 1.4, 1.5), {}),  # beaten
            ("aGPU2+GPUv2", 20, 0.05, (5.0, 6.0, 7.0), {}),
            ("aCPU2+CPU2/literal", 20, 0.01, (0.1, 0.1, 0.1), {}),
        )
        best = work_precision.front(pages.of(self.value), points)
        self.assertEqual({p["variant"] for p in best}, {"aCPU2+CPU2", "aCPU2+Dual", "GPU1", "aGPU2+GPUv2"})

    def test_the_worst_answer_and_the_quickest_time_may_be_of_two_variants(self):
        self.catena["variants"]["aCPU2+Dual/literal"] = made.described("aCPU2+Dual/literal")
        points = self.points(
            ("aCPU2+CPU2/literal", 10, 0.1, (1, 2, 3), {"answer_error": 0.01, "missing": 1, "invented": 0, "exact_pairs": 100}),
            ("aCPU2+Dual/literal", 10, 0.1, (4, 5, 6), {"answer_error": 0.04, "missing": 3, "invented": 1, "exact_pairs": 100}),
        )
        self.catena["work_precision"]["points"] = points
        table = next(b for b in blocks(work_precision, self.value) if hasattr(b, "rows"))
        (row,) = [dict(zip(table.columns, row)) for row in table.rows]
        self.assertEqual([row[name].raw for name in ("pairs wrong", "missing", "invented", "fastest, ms")], [0.04, 3, 1, 2])
        self.assertEqual(row["fastest, ms"].hint, "aCPU2+CPU2/literal")

    def test_a_ring_is_the_quickest_exact_point_of_a_tolerance(self):
        self.catena["work_precision"]["points"] = self.points(
            ("aCPU2+CPU2", 10, 0.1, (1, 2, 3), {"tolerance": 0.1}),
            ("aCPU2+Dual", 10, 0.1, (1, 1, 1), {"tolerance": 0.1}),
            ("aGPU2+GPU2", 90, 0.1, (3, 4, 5), {"tolerance": 0.1}),
            ("aCPU2+CPU2/literal", 10, 0.1, (0.1, 0.1, 0.1), {"tolerance": 0.1}),
        )
        panel = next(b for b in blocks(work_precision, self.value) if b.__class__.__name__ == "Figure" and "work" in b.key).panels[0]
        rings = [series for series in panel.series if series.name.startswith("a tolerance of")]
        self.assertEqual([(ring.name, ring.x, ring.y) for ring in rings], [("a tolerance of 0.1 radii: 10 spheres", [1], [0.1])])

    def test_what_was_left_out_opens_on_a_click_by_its_reason(self):
        out = blocks(work_precision, self.value)[-1]
        self.assertTrue(out.folded)
        self.assertEqual(out.text, "2 variants left out, with the reason")
        self.assertEqual(out.points, ["too slow: CPU1 and CPU1/double"])


class Paper(Base):
    def test_each_path_is_the_papers_table_of_it(self):
        """Table 3 is of path 1 (paper.txt), where CPU1 took longer at 10,000 spheres."""
        tables = [block for block in blocks(paper_tables, self.value) if hasattr(block, "rows")]
        self.assertEqual([(t.key, t.title.partition(" of")[0]) for t in tables], [("path1", "Table 3"), ("path2", "Table 4")])

    def test_a_cell_says_how_many_times_faster_than_the_paper_it_is(self):
        hint = paper_tables._cell([2.0] * 6, 30.0).hint
        self.assertIn("15.0 times faster than the paper's 30 ms", hint)
        self.assertIn("[2.00, 2.00] ms, 6 repetitions", hint)
        self.assertIn("[1.00, 6.00] ms, 6 repetitions; 2.00 times", paper_tables._cell([4.0, 1.0, 2.0, 6.0, 3.0, 5.0], 7.0).hint)
        self.assertEqual(set(paper.TABLES), set(made.SCENES))


class Summary(Base):
    def told(self):
        return "\n".join(summary.build(report.Report([pages.of(self.value)])).blocks[-1].points)

    def test_wrong_answers_are_told_whichever_way_they_are_wrong(self):
        self.assertIn("No wrong answer", self.told())
        for key in ("missing", "invented"):
            value = copy.deepcopy(self.value)
            for row in value["benchmarks"]:
                if row["name"].startswith("path2/n:1000/aCPU2+CPU2/literal/find"):
                    row[key] = 1.0
            points = summary._wrong(pages.of(value), "")
            self.assertIn("Wrong answers while timed", points[0])
            self.assertIn("aCPU2+CPU2/literal, on path2/n:1000.", points[0])

    def test_a_fault_is_no_refusal(self):
        self.assertIn(f"Refused</strong>: 1 measurement of bGPU2+GPU2 (“{html.escape('takes at most <1536>')}”)", self.told())
        self.value["benchmarks"][-1]["at_fault"] = True
        told = self.told()
        self.assertIn("Failed, by a fault of its own</strong>: 1 measurement of bGPU2+GPU2", told)
        self.assertNotIn("Refused", told)

    def test_what_was_compared_is_counted(self):
        del self.value["benchmarks"][:3]  # some cases have fewer
        samples = sum("real_time" in row for row in self.value["benchmarks"])
        self.assertIn(
            f"6 variants on 2 scenes (path1 and path2) of 1,000 to 100,000 spheres; {samples:,} timed samples, in 12.5 s",
            self.told(),
        )
        self.assertGreater(samples, 6 * 6 * 8)


class Written(unittest.TestCase):
    """Numbers and lists as the page has them."""

    def test_a_time_is_in_the_unit_that_it_says(self):
        for ms in (0.0, 3e-5, 0.0123, 0.0999, 0.1, 4.56, 999, 1000, 123456):
            number, unit = words.duration(ms).replace(",", "").split()
            self.assertAlmostEqual(float(number) * {"µs": 1e-3, "ms": 1, "s": 1e3}[unit], ms, delta=0.005 * ms)

    def test_one_is_no_plural_and_none_is(self):
        self.assertEqual([words.plural(n, "pair") for n in (0, 1, 2, 1000)], ["0 pairs", "1 pair", "2 pairs", "1,000 pairs"])

    def test_what_a_list_does_not_name_it_counts(self):
        names = list("abcdefg")
        for most in range(1, 9):
            told = words.listed(names, most)
            named = [name for name in names if name in told.replace(" and ", ", ").split(", ")]
            self.assertEqual(named, names[:most])
            self.assertEqual(f" {len(names) - most} more" in told, most < len(names))
        self.assertEqual([words.listed([]), words.listed("a"), words.listed("ab")], ["none", "a", "a and b"])

    def test_digits_are_as_many_as_asked_for(self):
        for value in (1234567.0, 1234.0, 12.34, 1.234, 0.01234, 1.234e-9, 0.9996):
            for digits in (2, 3, 4):
                text = words.significant(value, digits).replace(",", "")
                self.assertLessEqual(abs(float(text) / value - 1), 0.5 * 10 ** (1 - digits))
        self.assertEqual([words.significant(v, 3) for v in (None, 0, math.inf)], ["", "0", "inf"])


class Rows(Base):
    """What a run file says of a time."""

    def test_a_unit_is_heeded(self):
        for unit, factor in (("ns", 1e6), ("us", 1e3), ("ms", 1.0), ("s", 1e-3)):
            row = {"name": "a/n:10/V/find", "real_time": 2.5 * factor, "time_unit": unit}
            run = pages.of({"context": {}, "benchmarks": [row]})
            self.assertAlmostEqual(run.samples["a/n:10", "V", "find"][0], 2.5)

    def test_a_time_that_is_none_is_refused(self):
        for time in (-1.0, math.inf, math.nan, "soon", None):
            with self.assertRaises(Exception) as refused:
                pages.of({"context": {}, "benchmarks": [{"name": "a/n:10/V/find", "real_time": time, "time_unit": "ms"}]})
            self.assertIn("benchmarks[0]", str(refused.exception))


if __name__ == "__main__":
    unittest.main()
