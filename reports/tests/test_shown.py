"""What figures and tables show where there is one of a thing, none of it, or a tie: on runs made for each."""
import copy
import unittest

import made
import pages
from catena_report import choice, claims, figure, page, paper, profiles, report, style, table, variant, words
from catena_report.figure import Axis, Figure, Panel, Series
from catena_report.sections import (
    advice, environment, exactness, memory, paper_tables, slowdown, stability, summary, times, tube_errors, work_precision,
)
from catena_report.sections import claims as claims_section
from catena_report.style import Look
from test_stability import LINE


class Base(unittest.TestCase):
    base = made.run(repetitions=6)

    def setUp(self):
        self.value = copy.deepcopy(self.base)
        self.catena = self.value["catena"]

    def keep(self, where):
        self.value["benchmarks"] = [row for row in self.value["benchmarks"] if where(row["name"])]

    def report(self, *values):
        return report.Report([pages.of(value) for value in values or (self.value,)])

    def blocks(self, module):
        return module.build(self.report()).blocks

    def table(self, module):
        return next(block for block in self.blocks(module) if hasattr(block, "rows"))


class Times(Base):
    def figure(self, key="times-find"):
        return next(block for block in self.blocks(times) if block.key == key)

    def test_a_peer_is_drawn_at_first_beside_the_exact_ones(self):
        self.catena["variants"]["FCL"] = made.described("FCL")
        self.value["benchmarks"] += [
            {**row, "name": row["name"].replace("/GPU1/", "/FCL/")} for row in self.value["benchmarks"] if "/GPU1/find" in row["name"]
        ]
        shown = {series.name: series.shown for series in self.figure().panels[0].series}
        self.assertEqual({name for name, at_first in shown.items() if not at_first}, {"aCPU2+CPU2/literal"})
        self.assertTrue(shown["FCL (peer)"])

    def test_where_all_round_they_are_drawn_at_first(self):
        self.keep(lambda name: "/literal/" in name)
        self.assertEqual({series.shown for panel in self.figure().panels for series in panel.series}, {True})

    def test_those_of_more_points_come_first(self):
        self.keep(lambda name: "/aGPU2+GPUv2/" not in name or "/n:1000/" not in name)
        names = [series.name for series in self.figure().panels[0].series]
        self.assertEqual([names.index("aGPU2+GPUv2"), names.index("GPU1")], [4, 3])

    def test_a_scene_of_one_size_has_no_curve(self):
        self.keep(lambda name: not name.startswith("path2") or "/n:1000/" in name)
        self.assertEqual([panel.title for panel in self.figure().panels], ["path1", "path1, for each sphere"])

    def test_a_tie_has_no_single_fastest(self):
        for row in self.value["benchmarks"]:
            if "path1/n:100000/aGPU2+GPU2/find" in row["name"] or "path1/n:100000/aGPU2+GPUv2/find" in row["name"]:
                row["real_time"] = 1.0 + row["repetition_index"]
        title = self.figure().title
        self.assertIn("no single fastest on path1", title)
        self.assertIn("aGPU2+GPUv2 is fastest on path2", title)


class Looks(unittest.TestCase):
    def test_colours_are_of_those_that_are_there_and_hollow_of_a_device_algorithm_on_the_host(self):
        of = lambda name: variant.Variant.of(name, made.described(name))  # noqa: E731
        several = [of(name) for name in ("aCPU2+CPU2", "Hybrid", "aGPU2@host+GPU2@host")]
        looks = style.Looks(several)
        self.assertEqual([looks.variant(one).colour for one in several], ["c0", "c2", "c1"])
        self.assertEqual([looks.construction(one).hollow for one in several], [False, False, True])
        self.assertEqual([looks.variant(one).hollow for one in several], [False, False, True])

    def test_a_peer_is_not_recommended_however_exact_it_is(self):
        peer = variant.Variant.of("FCL", made.described("FCL") | {"exact": True})
        self.assertEqual((peer.recommended, peer.rounded), (False, False))

    def test_rows_of_several_points_are_told_one_by_one(self):
        rows = Panel("", Axis("x"), Axis("", categories=["a", "b", "c"]), [Series("s", [1, 2, 3], [0, 1, 2], Look("c0"))])
        self.assertEqual(Figure("k", "", "", [rows]).alternative(), "Plot: rows over x. s 1, 2, 3.")
        rows.series[0] = Series("s", [1, 2], [0, 1], Look("c0"))
        self.assertEqual(Figure("k", "", "", [rows]).alternative(), "Plot: rows over x. s from 1 to 2.")
        rows.series = [Series(str(k), [1], [0], Look("c0")) for k in range(figure.TOLD + 2)]
        self.assertTrue(Figure("k", "", "", [rows]).alternative().endswith("7 1; and 2 more."))


    def test_what_no_cell_is_a_map_does_not_tell(self):
        heat = figure.Heat([[0, 2]], [("good", "c0"), ("bad", "c1"), ("open", "c2")], [["", ""]])
        panel = Panel("M", Axis("", categories=["x", "y"]), Axis("", categories=["u"]), heat=heat)
        self.assertEqual(Figure("k", "", "", [panel]).alternative(), "M: of 2 cells 1 good; 1 open.")


class Tables(unittest.TestCase):
    two = table.Table("t", "T", "", ["a", "b", "n"], [[table.Cell("x", kind="best"), table.Cell("y", kind="paper"), "1"], ["u", table.Cell("", kind="paper"), "2"]], words=2)

    def test_markdown_aligns_numbers_and_slants_what_is_the_papers(self):
        self.assertEqual(
            self.two.markdown(), "| a | b | n |\n| --- | --- | ---: |\n| x | *y* | 1 |\n| u |  | 2 |\n"
        )

    def test_latex_does_so_too(self):
        text = self.two.as_latex()
        self.assertIn(r"\begin{tabular}{llr}", text)
        self.assertIn("x & \\emph{y} & 1 \\\\\nu &  & 2 \\\\", text)
        shown = r"a $\le$ b$^2$, c $\ge$ \textasciitilde{}5 \%, 3 $\times$ 2 $\pm$ 1 -- \_\#"
        self.assertEqual(table.latex("a ≤ b², c ≥ ~5 %, 3 × 2 ± 1 – _#"), shown)


class Page(Base):
    def test_it_carries_no_view_and_nothing_that_was_computed_from_other_rows(self):
        self.catena["viewer"] = []
        computed = [{**row, "run_type": "aggregate"} for row in self.value["benchmarks"][:3]]
        self.value["benchmarks"] += computed
        (carried,) = page.data(self.report())
        self.assertEqual(set(carried["catena"]), set(self.catena) - {"viewer"})
        self.assertEqual(carried["benchmarks"], self.value["benchmarks"][:-3])

    def test_all_of_an_animation_begins_at_its_first_frame(self):
        of = self.report()
        self.assertEqual([of.chain(of.runs[0], f"{scene}/n:1000")["frame"] for scene in made.SCENES], [28, 0])

    def test_of_two_runs_of_a_machine_the_one_of_more_variants_keeps_a_chain(self):
        for counts in ((2, 3), (3, 2), (2, 2)):
            of = self.report(self.value, self.value)
            views = {run: {"a/n:1": dict.fromkeys(range(count))} for run, count in zip(of.runs, counts)}
            kept = of.best_informed(views)
            first = counts[0] >= counts[1]
            self.assertEqual([list(kept[run]) for run in of.runs], [["a/n:1"], []] if first else [[], ["a/n:1"]])

    def test_figures_of_several_runs_are_numbered_from_one(self):
        of = self.report(self.value, self.value)
        self.assertEqual([of.key(run) for run in of.runs], ["-1", "-2"])


class Advice(Base):
    def test_one_exact_variant_is_no_choice(self):
        self.keep(lambda name: "/aCPU2+" in name and "/aCPU2+Dual/" not in name)
        run = pages.of(self.value)
        view = {"path1/n:1000": {"aCPU2+CPU2": [1.0] * 6, "aCPU2+CPU2/literal": [2.0] * 6}}
        self.assertEqual((choice.choose(run, view), choice.advise(run, view)), ({}, []))
        self.assertEqual(profiles.slowdowns(run), {})

    def test_without_a_choice_the_page_says_why_there_is_no_advice(self):
        alone = lambda name: "/aCPU2+CPU2/" in name and "literal" not in name  # noqa: E731
        apart = lambda name: alone(name) and name.startswith("path1") or "/aCPU2+Dual/" in name and name.startswith("path2")  # noqa: E731
        for keep, said in (
            (alone, "one exact variant was timed end to end"),
            (apart, "no two exact variants were timed end to end on one chain"),
            (lambda name: "literal" in name, "no exact variant was timed end to end"),
        ):
            self.value = copy.deepcopy(self.base)
            self.keep(keep)
            first = self.blocks(summary)[0]
            self.assertEqual(first.text, f"<strong>No advice</strong>: {said}; to choose between them takes two.")
        self.value = copy.deepcopy(self.base)
        self.assertEqual(self.blocks(summary)[0].key, "advice-short")

    def test_one_chain_has_one_time(self):
        self.keep(lambda name: name.startswith("path1/n:1000/"))
        row = advice.summary_table(self.report()).rows[0]
        self.assertEqual(row[2].text, words.ms(row[2].value))
        self.assertEqual(row[1].text, "1,000 spheres (path1)")

    def test_the_next_of_a_chain_is_the_nearest_that_differs(self):
        """Three that are slower, one that cannot be told from the fastest, one that rounds."""
        fastest, alike, *slower = "aGPU2+GPU2", "aGPU2+GPUv2", "GPU1", "aCPU2+Dual", "aCPU2+CPU2"
        factors = {fastest: 1.0, alike: 1.001, "aCPU2+CPU2/literal": 1.5, **dict(zip(slower, (4.0, 2.0, 3.0)))}
        for row in self.value["benchmarks"]:
            row["real_time"] = factors.get(row["name"].split("/whole")[0].split("/", 2)[2], 9.0) * (1 + row.get("repetition_index", 0) / 100)
        table_ = next(b for b in self.blocks(advice) if getattr(b, "key", "") == "choice")
        rows = [[cell.text for cell in row] for row in table_.rows if row[1].text == "end to end"]
        self.assertEqual(len(rows), 8)
        for row in rows:
            self.assertEqual(row[2:5], [fastest, alike, "aCPU2+Dual"])
            self.assertEqual(row[5].split(" [")[0], "2.00")

    def test_two_chains_give_no_order(self):
        self.keep(lambda name: "/n:1000/" in name)
        self.assertIsNone(slowdown.headline(pages.of(self.value)))
        self.assertIn("Too few chains", slowdown._message(pages.of(self.value)))

    def test_a_variant_that_was_not_timed_on_all_chains_is_no_headline(self):
        self.keep(lambda name: "/aGPU2+GPU2/" not in name or name.startswith("path1"))
        name, _, near = slowdown.headline(pages.of(self.value))
        self.assertNotIn("aGPU2+GPU2", [name, *near])
        rows = {row[0].text: [cell.raw for cell in row] for row in self.table(slowdown).rows}
        self.assertEqual((rows["aGPU2+GPU2"][1], rows["aGPU2+GPU2"][6]), (4, 0.5))

    def test_few_samples_are_said_to_be_few(self):
        (said,) = summary._certain(pages.of(self.value), "")
        self.assertIn("at most 6 samples of a case, too few", said)


class Claims(Base):
    def test_verdicts_are_counted(self):
        self.catena["keyframes"] = []
        text = self.blocks(claims_section)[0].text
        judged = [claim.judge(pages.of(self.value)).verdict for claim in claims.CLAIMS]
        tally = {verdict: judged.count(verdict) for verdict in (claims.HOLDS, claims.FAILS)}
        self.assertGreater(min(tally.values()), 1)
        self.assertIn(f"Of {sum(tally.values())} verdicts", text)
        for verdict, number in tally.items():
            self.assertIn(f"{number} say “{verdict}”", text)

    def test_46_pairs_in_one_frame_refute_whatever_else_was_run(self):
        self.catena.update(keyframes=[], animation=[])
        for most, verdict in ((45, claims.UNTESTED), (46, claims.FAILS)):
            for scene in self.catena["scenes"]:
                scene.update(frame=28, pairs=most)
            for row in self.value["benchmarks"]:
                row["pairs"] = float(most)
            self.assertEqual(claims.pairs(pages.of(self.value)).verdict, verdict)

    def test_589824_spheres_are_the_limit_itself(self):
        for n, verdict in ((589_824, claims.UNTESTED), (589_825, claims.FAILS)):
            value = copy.deepcopy(self.value)
            value["benchmarks"] += [
                {"name": f"path1/n:{n}/aGPU2+GPU2/build", "run_type": "iteration", "real_time": 1.0, "time_unit": "ms"}
            ]
            self.assertEqual(claims.limit(pages.of(value)).verdict, verdict)


class Errors(Base):
    def test_no_error_at_all_is_no_point_on_a_logarithm(self):
        for line in self.catena["tube_errors"]:
            line["gap"] *= line["tube"] != "rod"
        gap = self.blocks(tube_errors)[0].panels[0]
        self.assertEqual([series.name for series in gap.series], ["helix", "slope 2"])
        self.assertEqual([row[1].text == "" for row in self.table(tube_errors).rows], [False, True])

    def test_a_law_is_fitted_to_spacings_up_to_a_radius(self):
        self.catena["tube_errors"] = [
            {"tube": "rod", "n": 9, "spacing": h, "gap": h**2 if h <= 1 else 9.0, "volume_deficit": h**2, "depth_error": h**2}
            for h in (0.25, 0.5, 0.75, 1.0, 1.5, 1.75, 1.9, 1.95, 1.99, 2.0)
        ]
        self.assertAlmostEqual(self.table(tube_errors).rows[0][1].raw, 2)

    def test_the_worst_and_the_fastest_wherever_they_stand(self):
        point = self.catena["work_precision"]["points"][0]
        variants = ["aCPU2+CPU2/literal", "aCPU2+Dual/literal", "aGPU2+GPU2/literal"]
        self.catena["variants"].update({name: made.described(name) for name in variants})
        for errors, ms in (((0.01, 0.04, 0.02), (3, 1, 2)), ((0.04, 0.02, 0.01), (1, 2, 3)), ((0.01, 0.02, 0.04), (2, 3, 1))):
            self.catena["work_precision"]["points"] = [
                {**point, "variant": name, "answer_error": error, "median_ms": time, "arithmetic": "literal"}
                for name, error, time in zip(variants, errors, ms)
            ]
            table_ = next(b for b in self.blocks(work_precision) if b.__class__.__name__ == "Table")
            (row,) = [dict(zip(table_.columns, row)) for row in table_.rows]
            self.assertEqual((row["pairs wrong"].raw, row["fastest, ms"].raw), (0.04, 1))
            self.assertEqual(row["fastest, ms"].hint, variants[ms.index(1)])
            message = next(b for b in self.blocks(work_precision) if getattr(b, "key", "") == "work-precision").title
            self.assertIn("iteral ones get up to 4 % of the pairs wrong", message)

    def test_one_chain_is_a_ratio_without_interval(self):
        self.keep(lambda name: name.startswith("path1/n:1000/"))
        cell = self.table(exactness).rows[0][2]
        self.assertEqual(cell.text, f"{cell.raw:.2f}")

    def test_right_counts_are_not_right_pairs(self):
        self.catena["stability"] = [
            {**LINE, **changed} for changed in ({}, {"outcome": "wrong", "wrong_counts": 2}, {"outcome": "wrong", "wrong_counts": 1}, {"outcome": "wrong", "missing": 1})
        ]
        self.assertEqual([cell.raw for cell in self.table(stability).rows[0][1:4]], [4, 0.75, 0.5])

    def test_names_are_cut_only_where_they_stay_apart(self):
        one, two, short = "a" * 30 + "1", "a" * 30 + "2", "b" * 30
        self.assertEqual(stability._narrow([one, two, short, "c"]), [one, two, "b" * 23 + "…", "c"])


class Held(Base):
    def test_the_least_and_the_most_are_told(self):
        for row in self.catena["memory"]:
            row["held_bytes"] *= 2 if row["variant"] == "aCPU2+Dual" else 1
        title = next(b for b in self.blocks(memory) if hasattr(b, "panels")).title
        self.assertTrue(title.startswith("From 48 bytes a sphere (aCPU2+CPU2) to 96 (aCPU2+Dual)"), title)

    def test_a_tie_has_a_margin_and_it_is_nought(self):
        self.catena["scenes"][0]["smallest_margin"] = 0.0
        self.catena["scenes"][1]["smallest_margin"] = None
        rows = next(b for b in self.blocks(environment) if getattr(b, "key", "") == "scenes").rows
        self.assertEqual([row[-1].text for row in rows[:2]], ["0.00e+00", ""])

    def test_what_the_host_ran_was_measured_on_the_host(self):
        places = {}
        for row in self.table(paper_tables).rows:
            if row[2].text != "the paper":
                places.setdefault(row[2].text, set()).add(row[0].text)
        self.assertEqual(places["a processor"] & places["a GPU"], set())
        self.assertEqual(places["a processor"], {name.partition(",")[0] for name in paper.ON_HOST} & set().union(*places.values()))


if __name__ == "__main__":
    unittest.main()
