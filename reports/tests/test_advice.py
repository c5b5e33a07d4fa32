"""What the page advises: by what a caller waits for, how much faster, how sure; each number computed here a
second time from the raw samples.
"""
import collections
import json
import math
import re
import statistics as plain
import unittest

import numpy

import made
import pages
from catena_report import choice, profiles, report, runfile, spans, statistics, waits
from catena_report.sections import advice, slowdown, summary
from pages import recomputes

QUICK = made.REPORTS / "results" / "h200_quick.json.gz"


def of(value):
    return runfile.Run("run.json", json.loads(json.dumps(value)))


def raw_medians(run, stage):
    """{input: {variant: median, ms}} of a stage, from the rows of the file alone."""
    found = collections.defaultdict(lambda: collections.defaultdict(list))
    for row in run.raw["benchmarks"]:
        name = row["name"].removesuffix("/manual_time").rsplit("/", 1)
        if name[1] == stage and "real_time" in row and not row.get("error_occurred"):
            scene, n, variant = name[0].split("/", 2)
            found[f"{scene}/{n}"][variant].append(row["real_time"] * runfile.TO_MS[row["time_unit"]])
    return {
        input_: {variant: plain.median(times) for variant, times in row.items()} for input_, row in found.items()
    }


def exact(run, row):
    return {name: time for name, time in row.items() if run.catena["variants"][name]["exact"]}


def covered(text):
    """{scene: [(least n, greatest n)]} of what a row says that it is for, taken apart again."""
    found = {}
    for sizes, scenes in re.findall(r"(\d[\d, toand]*?)(?: spheres)? \(([^)]+)\)", text):
        ends = [[int(n.replace(",", "")) for n in span.split(" to ")] for span in re.split(", | and ", sizes)]
        for scene in re.split(", | and ", scenes):
            found[scene] = [(span[0], span[-1]) for span in ends]
    return found


def said_of(text, timed):
    """The inputs that a reader takes a row to speak of."""
    spans = covered(text)
    ends = {name: (runfile.scene_of(name), runfile.n_of(name)) for name in timed}
    return {name for name, (scene, n) in ends.items() if any(low <= n <= high for low, high in spans.get(scene, ()))}


class ByWhatACallerWaitsFor(unittest.TestCase):
    def test_moves_between_memories_decide_end_to_end_and_not_on_the_device(self):
        run = of(made.run())
        for input_, chosen in choice.choose(run, waits.end_to_end(run)).items():
            self.assertEqual(chosen.leader, "aGPU2+GPU2", input_)  # aGPU2+GPUv2 pays made.MOVES_COST
        for input_, chosen in choice.choose(run, waits.resident(run)).items():
            self.assertEqual(chosen.leader, "aGPU2+GPUv2", input_)
        self.assertTrue(all("CPU" not in name for row in waits.resident(run).values() for name in row))

    def test_on_a_host_alone_the_stages_are_the_call(self):
        value = made.run()
        value["benchmarks"] = [row for row in value["benchmarks"] if "/whole" not in row["name"]]
        found = waits.end_to_end(of(value))
        self.assertEqual(set(found["path1/n:1000"]), {"aCPU2+CPU2", "aCPU2+Dual"})

    def test_a_moving_chain_waits_for_the_answer_too(self):
        value = made.run()
        for row in value["benchmarks"]:
            row["transfer_ms"] = {"build": 1.0, "find": 8.0}.get(row["name"].split("/")[-2], 0.0)
        run, still = of(value), of(made.run())
        now, then = (waits.moving(r)["path1/n:1000"]["aGPU2+GPU2"] for r in (run, still))
        numpy.testing.assert_allclose(now - then, 7.0)  # what came up is in update() already
        for row in value["benchmarks"]:
            row["transfer_ms"] = {"build": 8.0, "find": 1.0}.get(row["name"].split("/")[-2], 0.0)
        now = waits.moving(of(value))["path1/n:1000"]["aGPU2+GPU2"]
        numpy.testing.assert_allclose(now - then, 0.0)  # and no answer comes back in less than no time


class OfTheH200(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = runfile.load(QUICK)
        cls.report = report.Report([cls.run_])
        cls.medians = raw_medians(cls.run_, "whole")

    def test_the_advice_for_a_thousand_spheres_is_what_a_caller_waits_for_least(self):
        own = exact(self.run_, self.medians["path1/n:1000"])
        chosen = choice.choose(self.run_, waits.end_to_end(self.run_))["path1/n:1000"]
        self.assertEqual(chosen.leader, min(own, key=own.get))
        self.assertGreater(len(own), 20)

    @recomputes("table:choice")
    def test_every_row_of_the_choice_is_the_least_median_and_its_ratio(self):
        table = next(b for b in advice.build(self.report).blocks if getattr(b, "key", "") == "choice")
        rows = [[cell.raw for cell in row] for row in table.rows if row[1].text == "end to end"]
        self.assertEqual(len(rows), len(self.medians))
        for chain, _, fastest, _, next_, ratio, papers, _, median in rows:
            own = exact(self.run_, self.medians[chain])
            self.assertEqual(fastest, min(own, key=own.get), chain)
            self.assertAlmostEqual(median, own[fastest])
            self.assertAlmostEqual(ratio, own[next_] / own[fastest])
            self.assertAlmostEqual(papers, own["aCPU2+CPU2"] / own[fastest])

    @recomputes("table:advice-short")
    def test_every_row_of_the_first_screen(self):
        table = advice.summary_table(self.report)
        seen = []
        for row, advised in zip(table.rows, choice.advise(self.run_, waits.end_to_end(self.run_))):
            seen += advised.inputs
            self.assertEqual(said_of(row[1].text, self.medians), set(advised.inputs))
            mine = [self.medians[chain][row[0].text] for chain in advised.inputs]
            self.assertAlmostEqual(row[2].value, min(mine))
            name = advised.next.name
            own = [self.medians[chain][name] / time for chain, time in zip(advised.inputs, mine)]
            self.assertAlmostEqual(row[4].value, math.exp(sum(map(math.log, own)) / len(own)))
            told = {name: time / mine[0] for name, time in exact(self.run_, self.medians[advised.inputs[0]]).items()}
            if len(advised.inputs) == 1:  # who is nearer than the next is named
                nearer = {name for name, ratio in told.items() if ratio < row[4].value * (1 - 1e-9)} - {row[0].text}
                self.assertLessEqual(nearer, {entry.name for entry in advised.as_good})
                self.assertEqual(row[5].text, f"{told['auto']:.2f}" + row[5].text[row[5].text.index(" ["):])
            for chain, time in zip(advised.inputs, mine):  # never far from the fastest
                self.assertLess(time, 1.2 * min(exact(self.run_, self.medians[chain]).values()))
        self.assertEqual(sorted(seen), sorted(self.medians))

    @recomputes("table:slowdown")
    def test_the_mean_slowdowns(self):
        table = next(b for b in slowdown.build(self.report).blocks if getattr(b, "key", "") == "slowdown" and hasattr(b, "rows"))
        for name, timed, mean, least, greatest, tenth, twice in [[c.raw for c in row] for row in table.rows]:
            factors = self.slowdowns(name)
            self.assertEqual(timed, len(factors))
            self.assertAlmostEqual(mean, math.exp(sum(map(math.log, factors)) / len(factors)))
            self.assertAlmostEqual(least, min(factors))
            self.assertAlmostEqual(greatest, max(factors))
            self.assertAlmostEqual(tenth, sum(f <= 1.1 for f in factors) / len(self.medians))
            self.assertAlmostEqual(twice, sum(f <= 2 for f in factors) / len(self.medians))

    def slowdowns(self, shown):
        name = shown.removesuffix(" (peer)")
        return [row[name] / min(exact(self.run_, row).values()) for row in self.medians.values() if name in row]

    @recomputes("figure:slowdown")
    def test_the_curves_are_the_share_of_chains(self):
        figure = next(b for b in slowdown.build(self.report).blocks if hasattr(b, "panels"))
        for series in figure.panels[0].series:
            factors = self.slowdowns(series.name)
            for at in range(2, len(series.x) - 1, 2):  # the upper ends of the steps
                share = sum(factor <= series.x[at] * (1 + 1e-12) for factor in factors) / len(self.medians)
                self.assertGreaterEqual(share + 1e-12, series.y[at])
                self.assertEqual(series.y[at - 1], series.y[at - 2])  # level up to the step
            self.assertAlmostEqual(series.y[-1], sum(f <= series.x[-1] for f in factors) / len(self.medians))
        for series in figure.panels[1].series:
            factors = self.slowdowns(series.name)
            self.assertAlmostEqual(series.x[0], plain.geometric_mean(factors))

    def test_of_the_curves_shown_at_first_no_two_look_alike(self):
        """The peers are of one colour and one dash."""
        for figure in (block for block in slowdown.build(self.report).blocks + advice.build(self.report).blocks if hasattr(block, "panels")):
            for panel in figure.panels:
                seen = collections.Counter(
                    (s.look.colour, s.look.dash if s.line else "", (s.look.marker, s.look.hollow) if s.markers else "")
                    for s in panel.series if s.shown and s.legend
                )
                self.assertLessEqual(max(seen.values(), default=0), 1, (figure.key, panel.title))

    def test_no_rank_test_where_it_could_not_tell(self):
        test = profiles.rank_test(self.run_, profiles.slowdowns(self.run_))
        self.assertEqual((test.p, round(test.power, 3)), ({}, 0.314))
        self.assertIn("no rank test", profiles.in_words(test))


class RestsOn(unittest.TestCase):
    def test_what_a_row_rests_on_is_counted(self):
        run = of(made.run())
        (row,) = advice.summary_table(report.Report([run])).rows
        self.assertEqual(row[-1].text, "8 chains, 64 samples, against 4 exact variants")
        value = made.run()
        value["benchmarks"] = [r for r in value["benchmarks"] if r["name"].split("/")[2] in ("aCPU2+CPU2", "aCPU2+Dual")]
        (row,) = advice.summary_table(report.Report([of(value)])).rows
        self.assertEqual(row[-1].text, "8 chains, 64 samples, against 1 exact variant")


class TwoRunsOfOneMachine(unittest.TestCase):
    def test_the_one_that_timed_more_variants_advises(self):
        runs = [runfile.load(QUICK), runfile.load(made.H200)]
        rows = [[cell.text for cell in row] for row in advice.summary_table(report.Report(runs)).rows]
        quick, tables = ([row for row in rows if name in row[-1]] for name in ("h200_quick", "h200_tables"))
        timed_by_tables = {variant for _, variant, _ in runs[1].samples}
        self.assertTrue({row[0] for row in quick} - timed_by_tables)  # what only the one has timed is advised
        timed = [set(waits.end_to_end(run)) for run in runs]
        self.assertIn("path1/n:1000", timed[0] & timed[1])
        for row in rows:  # beside the other's rows, too
            self.assertEqual(len(said_of(row[1], timed[0] | timed[1])), int(row[-1].split()[0]), row)
        told = [point for point in summary.build(report.Report(runs)).blocks[1].points if "lives on the device" in point]
        on_device = [waits.resident(run) for run in runs]
        said = [said_of(part.partition(" for ")[2], {**on_device[0], **on_device[1]}) for point in told for part in point.split("; ")]
        self.assertEqual(len(set().union(*said)), sum(map(len, said)))  # no chain twice
        chains = [sum(int(row[-1].split()[0]) for row in of) for of in (quick, tables)]
        self.assertEqual(chains, [len(timed[0]), len(timed[1] - timed[0])])  # what both timed is quick's to advise
        whole = raw_medians(runs[1], "whole")
        for row in tables:  # one that is named was timed on all of them; the paper's seldom was
            named = re.fullmatch(r"[\d.]+ \[[\d., ]+\] times \((.+)\)", row[4])
            if named:
                self.assertTrue(all(named[1] in whole[input_] for input_ in said_of(row[1], timed[1] - timed[0])), row)
            else:
                self.assertIn(row[4], ("no further was timed on all of them", "all are as good"), row)
        of_some = [(row, re.fullmatch(r"[\d.]+ \[[\d., ]+\] times on (\d+) of (\d+) chains", row[6])) for row in tables]
        self.assertTrue(any(some for _, some in of_some))
        for row, some in of_some:
            of = said_of(row[1], timed[1] - timed[0])
            on = sum("aCPU2+CPU2" in waits.end_to_end(runs[1])[input_] for input_ in of)
            if some:
                self.assertEqual((on, len(of)), (int(some[1]), int(some[2])))
                self.assertLess(on, len(of))
            else:
                self.assertRegex(row[6], r"^[\d.]+ \[[\d., ]+\] times$" if on == len(of) else "^not timed$")

    def test_the_figure_of_a_run_speaks_of_that_run_and_says_whose_advice_stands(self):
        runs = [runfile.load(QUICK), runfile.load(made.H200)]
        first, second = [block for block in advice.build(report.Report(runs)).blocks if hasattr(block, "panels")]
        both = set(waits.end_to_end(runs[0])) & set(waits.end_to_end(runs[1]))
        for figure, run in ((first, runs[0]), (second, runs[1])):
            own = {v for row in waits.end_to_end(run).values() for v in row if run.catena["variants"][v]["exact"]}
            own = {v for v in own if not run.catena["variants"][v]["peer"]}
            self.assertTrue(figure.title.startswith(f"Of the {len(own)} exact variants that this run timed, end to end: "))
        self.assertNotIn("Another run", first.caption)
        self.assertIn(f"timed more variants: its advice stands end to end on {len(both)} chains", second.caption)

    def test_a_machine_is_a_host_and_its_gpu(self):
        for gpus, kept in ((("A", "A"), (False, True)), (("A", "B"), (True, True)), ((None, "A"), (True, True))):
            runs = [runfile.Run("run.json", {"context": {"cpu": "C", "gpu": gpu}, "benchmarks": []}) for gpu in gpus]
            views = {run: {"path1/n:10": {name: [1] for name in names}} for run, names in zip(runs, ("v", "vw"))}
            informed = report.Report.best_informed(None, views)
            self.assertEqual(tuple("path1/n:10" in informed[run] for run in runs), kept, gpus)

    def test_files_of_one_name_that_hold_two_chains_both_keep_their_advice(self):
        for hashes, kept in ((("1", "1"), (False, True)), (("1", "2"), (True, True)), ((None, "1"), (False, True))):
            runs = [
                runfile.Run("run.json", {"context": {"cpu": "C"}, "benchmarks": [], "catena": {
                    "scenes": [{"input": "a.csv/n:10", **({"hash": hash_} if hash_ else {})}]
                }}) for hash_ in hashes
            ]  # fmt: skip
            views = {run: {"a.csv/n:10": {name: [1] for name in names}} for run, names in zip(runs, ("v", "vw"))}
            informed = report.Report.best_informed(None, views)
            self.assertEqual(tuple("a.csv/n:10" in informed[run] for run in runs), kept, hashes)


class InWords(unittest.TestCase):
    def test_one_length_is_no_range(self):
        for inputs, others, text in (
            (["path1/n:1000"], [], "1,000 spheres (path1)"),
            (["b/n:1000", "a/n:1000"], [], "1,000 spheres (a and b)"),
            (["a/n:300", "a/n:1000"], ["b/n:500"], "300 to 1,000 spheres (a)"),
            (["a/n:300", "a/n:1000", "b/n:300"], ["b/n:500"], "300 spheres (b) and 300 to 1,000 (a)"),
            (["a/n:1", "a/n:2", "a/n:4", "a/n:6", "a/n:7"], ["a/n:3", "a/n:5", "a/n:9"], "1 to 2, 4 and 6 to 7 spheres (a)"),
        ):
            self.assertEqual(spans.in_words(inputs, inputs + others), text)
            self.assertEqual(said_of(text, inputs + others), set(inputs))


class Row(unittest.TestCase):
    def test_as_good_is_whose_interval_begins_at_one(self):
        ends = {"aCPU2+Dual": 1.0, "aGPU2+GPU2": 1.0001, "aCPU2+CPU2/literal": 0.5}
        slower = {name: statistics.Interval(1.2, low, 1.5) for name, low in ends.items()}
        chosen = choice.Choice("aCPU2+CPU2", [], statistics.Interval(1, 1, 1), slower)
        self.assertEqual(chosen.as_good(of(made.run(repetitions=1))), ["aCPU2+Dual"])

    def test_the_time_of_a_chain_has_both_ends_of_its_interval(self):
        value = made.run(repetitions=6)
        for row in value["benchmarks"]:
            if row["name"].startswith("path1/n:1000/aGPU2+GPU2/whole"):
                row["real_time"] = 1e3 * (51 + row["repetition_index"] ** 2)  # 51 to 76 us
        (table,) = [block for block in advice.build(report.Report([of(value)])).blocks if hasattr(block, "rows")]
        (row,) = [row for row in table.rows if (row[0].text, row[1].text) == ("path1/n:1000", "end to end")]
        self.assertEqual((row[2].text, row[-1].text), ("aGPU2+GPU2", "0.0575 [0.0510, 0.0760]"))


class Drawn(unittest.TestCase):
    @recomputes("figure:advice")
    def test_each_chain_is_drawn_once_in_the_colour_of_its_fastest(self):
        run = of(made.run())
        medians = raw_medians(run, "whole")
        panel = pages.Shown(run).figures["advice"].panels[0]
        for series in panel.series:
            if series.hover:
                for text, x, y in zip(series.hover, series.x, series.y):
                    chain = text.split("<br>")[1].partition(",")[0]
                    own = exact(run, medians.pop(chain))
                    self.assertEqual(series.name, min(own, key=own.get))
                    n = int(chain.rpartition(":")[2])
                    self.assertTrue(n <= x < 1.2 * n)  # set side by side
                    self.assertAlmostEqual(y, 45 / n)
        self.assertEqual(medians, {})


if __name__ == "__main__":
    unittest.main()
