"""What decides: which rows, frames, shares and words a section takes where several could be, on values made by hand."""
import contextlib
import copy
import io
import math
import pathlib
import tempfile
import unittest
import unittest.mock

import made
import pages
from catena_report import choice, claims, judges, paper, profiles, report, statistics, table, variant, waits, whole_file, work
from catena_report import __main__ as command
from catena_report.sections import (
    advice, animation, arithmetic, environment, judged, paper_tables,
    reproduce, slowdown, stability, summary, tube_errors,
)
from catena_report.sections import claims as claims_section
from test_stability import LINE


class Base(unittest.TestCase):
    base = made.run(repetitions=6)

    def setUp(self):
        self.value = copy.deepcopy(self.base)
        self.catena = self.value["catena"]

    def report(self, *values):
        return report.Report([pages.of(value) for value in values or (self.value,)])

    def table(self, module, *values):
        return next(block for block in module.build(self.report(*values)).blocks if hasattr(block, "rows"))


class Words(Base):
    def test_nought_is_a_number(self):
        self.assertEqual([table.Cell("none", 0).raw, table.Cell("none").raw], [0, "none"])

    def test_what_cannot_be_written_is_named_as_it_was_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            link = pathlib.Path(folder, "link")
            link.symlink_to(pathlib.Path(folder, "none", "file"))
            with self.assertRaises(OSError) as raised:
                whole_file.write(link, "text")
            self.assertEqual(raised.exception.filename, str(link))

    def test_a_package_that_lacks_a_file_is_to_be_installed_again(self):
        for name, advised in ((str(pathlib.Path(command.__file__).parent / "assets" / "x"), "install catena again"),
                              ("/elsewhere", "give --output a folder that can be written")):
            err = io.StringIO()
            with unittest.mock.patch("catena_report.page.write", side_effect=OSError(2, "No such file", name)):
                with contextlib.redirect_stderr(err):
                    self.assertEqual(command.main(["--output", "o", str(made.H200)]), 2)
            self.assertEqual(err.getvalue(), f"catena report: {name}: No such file; {advised}\n")

    def test_a_cache_of_a_mebibyte_has_one(self):
        self.assertEqual([environment._size(size) for size in (2**20 - 2**10, 2**20)], ["1023 KiB", "1 MiB"])

    def test_yes_and_no(self):
        self.assertEqual([environment._text("k", value) for value in (True, False, None)], ["yes", "no", ""])

    def test_a_construction_is_named_with_the_arithmetic_that_rounds(self):
        of = lambda name: variant.Variant.of(name, made.described(name)).construction_label()  # noqa: E731
        self.assertEqual([of(name) for name in ("aCPU2+CPU2", "aCPU2+CPU2/literal", "FCL")], ["aCPU2", "aCPU2/literal", "FCL (peer)"])
        peer = variant.Variant.of("FCL", made.described("FCL"))
        self.assertFalse(peer.rounded)

    def test_a_count_that_was_nought_has_grown_without_end(self):
        self.assertEqual([work.Change("i", "v", "c", old, 3).ratio for old in (0, 2)], [math.inf, 1.5])

    def test_two_runs_of_a_device_are_told_apart_by_their_files(self):
        one, two, other = (pages.of(self.value) for _ in range(3))
        one.path, two.path = pathlib.Path("a.json.gz"), pathlib.Path("b.json")
        other.context = {**other.context, "gpu": "another GPU"}
        self.assertEqual(report.Report([one, two, other]).labels, [f"{one.device}, a", f"{two.device}, b", "another GPU"])
        for first, second, told, given in (
            ("a/run.json", "b/run.json", ("a/run", "b/run"), "a/run.json b/run.json"),
            ("x/a/run.json", "y/a/run.json", ("x/a/run", "y/a/run"), "x/a/run.json y/a/run.json"),
            ("a/b.json", "a/b.json.gz", ("run 1", "run 2"), "b.json b.json.gz"),
            ("a/run.json", "a/run.json", ("run 1", "run 2"), "run.json"),  # a list of runs
        ):
            one.path, two.path = pathlib.Path(first), pathlib.Path(second)
            several = report.Report([one, two, other])
            self.assertEqual(several.labels[:2], [f"{one.device}, {name}" for name in told])
            other.path = pathlib.Path("c.json")
            self.assertTrue(reproduce.build(several).blocks[-1].text.endswith(f" --from {given} c.json"))

    def test_a_commit_that_lacks_what_was_built_is_said_to(self):
        run = pages.of(self.value)
        for commit, said in (
            ("0123", "git checkout 0123"),
            *((commit, "git checkout 0123  # it was built with changes that no commit has") for commit in ("0123-dirty", "0123+")),
        ):
            run.context["commit"] = commit
            lines = reproduce.build(report.Report([run])).blocks[0].text.splitlines()
            self.assertEqual((lines[0], lines[-1]), (said, "build/release/" + run.catena["command"]))

    def test_of_a_run_without_its_command_the_program_is_said_and_that_more_was_given(self):
        run = pages.of(self.value)
        run.catena.pop("command")
        run.context["executable"] = "build/bench"
        text = reproduce.build(report.Report([run])).blocks[0].text
        self.assertIn("\nbuild/bench --benchmark_out=run.json  # and the options of then, which", text)

    def test_others_are_those_that_the_interval_leaves_open(self):
        row = self.catena["judged"][0]
        self.catena["judged"] = [row] + [{**row, "open": True}] * 3
        self.assertEqual(
            self.table(judged).title, "All 1 number agree with what is published; the interval of 3 others is too wide to tell"
        )


class Chosen(Base):
    def test_of_those_alike_the_least_mean_of_logarithms(self):
        """One sample of each: alike within a factor of 2."""
        view = {"a/n:1": {"aCPU2+CPU2": [1.0], "aCPU2+Dual": [1.9]}, "a/n:2": {"aCPU2+CPU2": [150.0], "aCPU2+Dual": [100.0]}}
        (advised,) = choice.advise(pages.of(self.value), view)
        self.assertEqual((advised.inputs, advised.variant, advised.times), (["a/n:1", "a/n:2"], "aCPU2+CPU2", [1.0, 150.0]))

    def test_several_chains_take_from_the_least_to_the_most(self):
        row = advice.summary_table(self.report()).rows[0]
        low, _, high = row[2].text.partition(" to ")
        self.assertLess(float(low), float(high))
        self.assertEqual(row[2].value, min(choice.advise(pages.of(self.value), waits.end_to_end(pages.of(self.value)))[0].times))

    def test_without_a_peer_there_is_no_column_of_it(self):
        columns = advice.summary_table(self.report()).columns
        self.assertEqual((len(columns), "a general library takes" in columns), (8, False))
        self.assertEqual({len(row) for row in advice.summary_table(self.report()).rows}, {8})

    def test_who_took_longer_is_named_where_the_column_does_not_and_on_how_many_chains(self):
        one = choice.Beside("GPU1", statistics.Interval(2.0, 1.5, 3.0), 2)
        self.assertEqual(advice._times(one, "none", 2, named=False).text, "2.00 [1.50, 3.00] times")
        self.assertEqual(advice._times(one, "none", 2).text, "2.00 [1.50, 3.00] times (GPU1)")
        self.assertEqual(advice._times(one, "none", 3).text, "2.00 [1.50, 3.00] times on 2 of 3 chains (GPU1)")
        self.assertEqual(advice._times(None, "none").text, "none")

    def test_those_as_good_stand_with_their_ratios(self):
        beside = [choice.Beside(name, statistics.Interval(*ratio), 2) for name, ratio in (("GPU1", (0.98, 0.9, 1.1)), ("CPU1", (1.02, 1.0, 1.3)))]
        self.assertEqual(advice._as_good(unittest.mock.Mock(as_good=beside)), "GPU1 0.98 and CPU1 1.02")

    def test_why_none_is_next_is_said(self):
        for others, as_good, said in ((2, 2, "all are as good"), (3, 2, "no further was timed on all of them"), (1, 0, "no other was timed on all of them")):
            self.assertEqual(advice._no_next(unittest.mock.Mock(others=others, as_good=[None] * as_good)), said)

    def test_the_papers_own_is_said_to_be_it(self):
        for row in self.value["benchmarks"]:
            row["real_time"] = (1.0 if "/aCPU2+CPU2/whole" in row["name"] else 9.0) * (1 + row.get("repetition_index", 0) / 100)
        row = advice.summary_table(self.report()).rows[0]
        self.assertEqual([row[at].text for at in (0, 5, 6)], [choice.PAPERS, "not timed", "this is it"])

    def test_chains_at_one_place_are_set_side_by_side_and_none_is_at_no_height(self):
        for scene in self.catena["scenes"]:
            scene.update(density=0.0, pairs=0)
        run = pages.of(self.value)
        inputs = ["path1/n:1000", "path2/n:1000", "path1/n:3000"]
        run.density = lambda input_: 0.0
        places = advice._beside(run, inputs)
        self.assertEqual([round(places[input_]) for input_ in inputs], [1000, 1060, 3000])
        self.assertEqual(advice._height(run, inputs[0]), advice.FLOOR)

    def test_rings_are_about_chains_where_several_are_alike(self):
        run = pages.of(self.value)
        alike, alone = {"aCPU2+CPU2": [1.0] * 6, "aCPU2+Dual": [1.0] * 6}, {"aCPU2+CPU2": [1.0] * 6, "aCPU2+Dual": [5.0] * 6}
        panel = advice._panel(self.report(), run, {"path1/n:1000": alike, "path1/n:3000": alone}, "t")
        self.assertEqual((panel.series[0].name, panel.series[0].x), ("others are as good", [1000]))
        hovers = [text for series in panel.series[1:] for text in series.hover]
        self.assertEqual(sorted("as good" in text for text in hovers), [False, True])
        (none,) = advice._panel(self.report(), run, {"path1/n:3000": alone}, "t").series
        self.assertEqual(none.name, "aCPU2+CPU2")

    def test_what_moved_is_the_median_of_all_repetitions(self):
        for at, row in enumerate(row for row in self.value["benchmarks"] if "path1/n:1000/aGPU2+GPU2/find" in row["name"]):
            row["transfer_ms"] = [9.0, 1.0, 8.0, 2.0, 7.0, 3.0][at]
        self.assertIn(waits._median_moved(pages.of(self.value), ("path1/n:1000", "aGPU2+GPU2", "find")), (3.0, 7.0))


class Slowdowns(unittest.TestCase):
    def of(self, ratios, chains):
        return profiles.Slowdown({str(k): r for k, r in enumerate(ratios)}, statistics.mean_log(ratios), chains)

    def test_those_are_told_apart_whose_p_is_below_the_level(self):
        test = profiles.RankTest("a", 9, 3, 0.9, {"b": 0.01, "c": 0.049, "d": 0.051})
        self.assertTrue(profiles.in_words(test).endswith("at 5 % a is told from b and c"))

    def test_no_interval_begins_below_one(self):
        slow = self.of([1.0, 1.0, 1.0, 4.0], 4)
        self.assertLess(slow.mean.low, 1)
        self.assertEqual(slowdown.mean_text(slow).partition("[")[2].partition(",")[0], "1.00")

    def test_intervals_that_overlap_are_told(self):
        """Until the end of the first one's, not only its middle."""
        run = pages.of(made.run(repetitions=1))
        names = ("aCPU2+CPU2", "aCPU2+Dual", "GPU1")
        found = {name: self.of(ratios, 4) for name, ratios in zip(names, ([1, 1, 1, 1.3], [1.1, 1.11, 1.12, 1.13], [9, 9, 9, 9.1]))}
        self.assertGreater(found["aCPU2+Dual"].mean.low, found["aCPU2+CPU2"].mean.value)
        self.assertLess(found["aCPU2+Dual"].mean.low, found["aCPU2+CPU2"].mean.high)
        with unittest.mock.patch.object(profiles, "slowdowns", return_value=found):
            self.assertEqual(slowdown.headline(run)[2], ["aCPU2+Dual"])
            (row,) = [row for row in slowdown._figure(report.Report([run]), run, found).panels[1].series if row.name == "aCPU2+CPU2"]
        self.assertEqual(row.low, [1.0])

    def test_what_is_less_than_all_is_said_of_those_that_it_was_compared_with(self):
        run = pages.of(made.run(repetitions=1))
        run._described["FCL"] = variant.Variant.of("FCL", made.described("FCL"))
        fast, slow, peer = [2, 2.01, 2.02, 2.03], [9, 9, 9, 9.1], [1, 1, 1, 1.01]
        for names, ratios, said in (
            (("aCPU2+CPU2", "GPU1"), (fast, slow), ", less than any other exact variant of catena's that was timed"),
            (("aCPU2+CPU2", "GPU1", "aCPU2+Dual"), (fast, slow, [1.0, 1.0]), ", less than any other exact variant of catena's that was timed on all"),
            (("FCL", "aCPU2+CPU2", "GPU1"), (peer, fast, slow), ", less than any other exact variant of catena's that was timed; of the peers FCL 1.00 [1.00, 1.01]"),
            (("FCL", "aCPU2+CPU2"), (peer[:2], fast), ", less than any other exact variant of catena's that was timed"),
        ):
            found = {name: self.of(mine, 4) for name, mine in zip(names, ratios)}
            with unittest.mock.patch.object(profiles, "slowdowns", return_value=found):
                self.assertTrue(slowdown._message(run).endswith(said), slowdown._message(run))
                self.assertTrue(summary._overall(run, "")[0].endswith(said.replace("'", "&#x27;") + "."))


class Claims(Base):
    def test_half_takes_two_sizes(self):
        self.value["benchmarks"] = [row for row in self.value["benchmarks"] if row["name"].startswith("path1/n:1000/")]
        self.assertIn("at two sizes or more", claims.half(pages.of(self.value)).evidence)

    def test_an_animation_of_both_paths_is_all_of_them_where_no_frame_is_left_out(self):
        self.catena.update(keyframes=[], animation=[
            {**self.catena["animation"][0], "input": f"{scene}/n:10000"} for scene in made.SCENES
        ])
        for frames, verdict in ((50, claims.HOLDS), (51, claims.UNTESTED)):
            for scene in self.catena["scenes"]:
                scene.update(frame=28, frames=frames)
            self.assertEqual(claims.pairs(pages.of(self.value)).verdict, verdict)

    def test_a_win_is_all_of_the_interval(self):
        times = {"aGPU2+GPU2": [0.5, 0.5, 4.0] * 2, "aCPU2+CPU2": [1.0, 1.0, 1.0] * 2}
        self.value["benchmarks"] = [
            {"name": f"path1/n:20000/{name}/build", "run_type": "iteration", "real_time": t, "time_unit": "ms"}
            for name, several in times.items() for t in several
        ]
        self.assertEqual(claims.faster("aGPU2", "aCPU2", 20000, "build")(pages.of(self.value)).verdict, claims.UNTESTED)

    def test_a_curve_begins_where_it_is_asked_to(self):
        points = judges._curve(pages.of(self.value), "path1", "CPU2", 3000)
        self.assertEqual([n for n, _ in points], [3000, 10000, 100000])

    def test_sizes_are_those_of_the_papers_algorithms(self):
        self.value["benchmarks"].append({"name": "path1/n:7/Hybrid/find", "run_type": "iteration", "real_time": 1.0, "time_unit": "ms"})
        self.catena["variants"]["Hybrid"] = made.described("Hybrid")
        self.assertEqual(paper.sizes(pages.of(self.value), "path1"), list(made.SIZES))

    def test_every_keyframe_is_better_than_one(self):
        rows = [{**row, "name": row["name"].replace("path1/", "path1:frames=all/"), "real_time": 7e6} for row in self.value["benchmarks"]
                if "path1/n:1000/aCPU2+CPU2/find" in row["name"]]
        self.value["benchmarks"] += rows
        self.assertEqual(set(paper.samples(pages.of(self.value), "path1", 1000, "CPU2")[0]), {7.0})

    def test_one_run_has_no_column_of_runs(self):
        with unittest.mock.patch.object(claims_section, "stored_verdicts", return_value={}):
            self.assertNotIn("run", self.table(claims_section).columns)
            two = copy.deepcopy(self.value)
            two["context"]["gpu"] = "another GPU"
            self.assertIn("run", self.table(claims_section, self.value, two).columns)

    def test_what_a_committed_run_decides_is_counted_by_verdict(self):
        keys = [claim.key for claim in claims.CLAIMS][:3]
        self.value["benchmarks"], self.catena["keyframes"], self.catena["examine"] = [], [], []
        stored = {key: claims.Verdict(v, "") for key, v in zip(keys, (claims.HOLDS, claims.FAILS, claims.FAILS))}
        with unittest.mock.patch.object(claims_section, "stored_verdicts", return_value=stored):
            told_ = summary._claims(self.report())
        self.assertIn("3 claims that the committed run of a GPU decides; 1 of them hold there.", told_[0])

    def test_claims_that_hold_and_that_do_not_are_told_apart(self):
        told_ = "\n".join(summary._claims(self.report()))
        for claim in claims.CLAIMS:
            verdict = claim.judge(pages.of(self.value)).verdict
            for title, is_ in (("Claims of the paper that hold", claims.HOLDS), ("Claims that do not hold", claims.FAILS)):
                line = next(line for line in told_.splitlines() if title in line)
                text = summary.html.escape(claim.text.rstrip("."))
                self.assertEqual(text in line[line.index("</a>: ") + 6 : -1].split("; "), verdict == is_, (title, claim.key))


class Errors(Base):
    def test_the_law_goes_through_the_middle_of_points_of_another(self):
        lines = [{"tube": "rod", "n": 9, "spacing": h, "gap": h, "volume_deficit": h, "depth_error": h} for h in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7)]
        self.catena["tube_errors"] = lines
        law = tube_errors.build(self.report()).blocks[0].panels[0].series[-1]
        self.assertAlmostEqual(law.y[0] / law.x[0] ** 2, 0.4 / 0.4**2)

    def test_wrong_pairs_are_missing_and_invented_of_the_exact_or_of_one(self):
        self.assertEqual(arithmetic.wrong_share({**LINE, "exact_pairs": 4, "missing": 1, "invented": 2}), 0.75)
        self.assertEqual(arithmetic.wrong_share({**LINE, "exact_pairs": 0, "invented": 2}), 2.0)

    def test_of_each_setting_the_worst_variant_counts(self):
        self.catena["variants"]["aCPU2+Dual/literal"] = made.described("aCPU2+Dual/literal")
        self.catena["stability"] = [
            {**LINE, "scene": f"far:n=5,exponent={e}", "variant": v, "outcome": "wrong", "exact_pairs": 10, "missing": missing}
            for e in (10, 20, 22) for v, missing in (("aCPU2+CPU2/literal", e % 3), ("aCPU2+Dual/literal", 4))
        ]
        panel = arithmetic.figure(self.report(), pages.of(self.value)).panels[0]
        self.assertEqual([series.y for series in panel.series], [[40.0, 40.0, 40.0]])

    def test_who_refused_every_scene_has_no_column_and_is_named_with_the_reason(self):
        refused = {"outcome": "refused", "reason": "too long"}
        self.catena["stability"] = [
            {**LINE, "scene": scene, "variant": name, **(refused if name == "GPU1" or (name, scene) == ("aCPU2+Dual", "a") else {})}
            for scene in "ab" for name in ("aCPU2+CPU2", "aCPU2+Dual", "GPU1")
        ]
        figure = next(b for b in stability.build(self.report()).blocks if hasattr(b, "panels"))
        self.assertEqual(figure.panels[0].x.categories, ["aCPU2+CPU2", "aCPU2+Dual"])
        self.assertIn("Left out, since refused on every scene: GPU1 (too long).", figure.caption)

    def test_a_margin_of_none_is_no_place_on_a_logarithm(self):
        self.catena["stability"] = [{**LINE, "scene": f"grazing:n=5,margin={m}"} for m in (-1e-7, 0, 1e-8, 1e-4)]
        self.assertEqual([list(lines) for lines in arithmetic.sweep(pages.of(self.value), "grazing").values()], [[1e-8, 1e-4]])

    def test_what_was_not_answered_is_no_point_of_a_sweep(self):
        outcomes = ("exact", "refused", "unavailable", "undecided")
        self.catena["stability"] = [{**LINE, "scene": "grazing:n=5,margin=1e-4", "outcome": outcome} for outcome in outcomes]
        ((_, lines),) = arithmetic.sweep(pages.of(self.value), "grazing").items()
        self.assertEqual([line["outcome"] for line in lines[1e-4]], ["exact"])

    def test_stages_of_the_papers_tables(self):
        stages = {(row[0].text, row[1].text) for row in self.table(paper_tables).rows}
        self.assertLess({("aGPU2", "construction"), ("GPU2", "traversal"), ("aGPU2 + GPU2", "whole call")}, stages)

    def test_scenes_of_unlike_sizes_keep_them(self):
        lines = [{**LINE, "scene": f"far:n={n}", "n": n} for n in (5, 6)]
        self.assertEqual(stability._short(lines, ["far:n=5", "far:n=6"]), ("", ["far:n=5", "far:n=6"]))
        self.assertEqual(stability._short(lines[:1], ["far:n=5,a=1", "b:n=5", "c:a=1,n=5"]), ("scenes of 5 spheres", ["far:a=1", "b", "c:a=1"]))

    def test_a_film_of_one_frame_is_none(self):
        self.catena["animation"] = [{**row, "frames": row["frames"][:1]} for row in self.catena["animation"]]
        self.assertIsNone(animation.build(self.report()))

    def test_one_slow_frame_makes_no_variant_slower_and_two_films_no_more_of_them(self):
        frames = lambda *costs: [  # noqa: E731
            {"frame": at, "pairs": 0, "update_ms": 0.0, "find_ms": float(cost)} for at, cost in enumerate(costs)
        ]
        self.catena["animation"] = [
            {"input": input_, "variant": name, "frames": frames(*costs)}
            for input_ in ("path1/n:1000", "path2/n:1000")
            for name, costs in (("aCPU2+CPU2", (2, 2, 2, 2, 2)), ("aCPU2+Dual", (1, 1, 100, 1, 1)))
        ]
        (figure,) = animation.build(self.report()).blocks
        self.assertEqual(figure.title, "A frame takes 1.00 ms with aCPU2+Dual, the fastest of 2 variants")


if __name__ == "__main__":
    unittest.main()
