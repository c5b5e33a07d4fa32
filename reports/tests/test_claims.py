"""The paper's claims: verdicts that rest on all that they need, and the committed ones beside them."""
import json
import math
import os
import statistics as plain
import tempfile
import unittest

import made
import pages
from catena_report import claims, committed, report, runfile
from catena_report.sections import claims as section
from pages import recomputes

RESULTS = made.REPORTS / "results"


def of(value):
    return runfile.Run("run.json", json.loads(json.dumps(value)))


def judged(key, value):
    return next(claim for claim in claims.CLAIMS if claim.key == key).judge(of(value))


class Pairs(unittest.TestCase):
    def test_it_holds_only_after_every_keyframe_of_both_paths(self):
        value = made.run()
        value["catena"]["animation"] = []
        for scene in value["catena"]["scenes"]:
            scene["frame"] = 28
        self.assertEqual(judged("pairs", value).verdict, claims.HOLDS)
        value["catena"]["keyframes"] = value["catena"]["keyframes"][:1]
        one_path = judged("pairs", value)
        self.assertEqual(one_path.verdict, claims.UNTESTED)
        self.assertIn("path1: at most 45 pairs in all 56 keyframes; path2: at most 45 pairs in the one frame", one_path.evidence)
        value["catena"]["keyframes"] = []
        self.assertEqual(judged("pairs", value).verdict, claims.UNTESTED)  # 45 in one frame of each

    def test_an_animation_with_frames_left_out_is_not_all_of_it(self):
        value = made.run()
        value["catena"]["keyframes"] = []
        for scene in value["catena"]["scenes"]:
            scene["frame"], scene["frames"] = 28, 51  # 50 are in the animation
        self.assertEqual(judged("pairs", value).verdict, claims.UNTESTED)

    def test_one_frame_refutes(self):
        value = made.run()
        value["catena"]["keyframes"][0]["pairs"][3] = 46
        self.assertEqual(judged("pairs", value).verdict, claims.FAILS)
        value = made.run()  # so does one of a path that was counted twice
        value["catena"]["keyframes"].append({**value["catena"]["keyframes"][0], "pairs": [45] * 55 + [46]})
        self.assertEqual(judged("pairs", value).verdict, claims.FAILS)
        for row in value["catena"]["keyframes"]:
            row["pairs"] = [44] * 56
        value["catena"]["scenes"] = []
        value["benchmarks"] = [{**row, "pairs": 44.0} for row in value["benchmarks"]]
        self.assertEqual(judged("pairs", value).verdict, claims.FAILS)
        value["catena"]["keyframes"][0]["pairs"] = [45] * 56  # of one path alone
        self.assertEqual(judged("pairs", value).verdict, claims.FAILS)


class Sizes(unittest.TestCase):
    def test_three_sizes_give_no_law(self):
        value = made.run()
        self.assertEqual(judged("growth-aCPU2-nlogn", value).verdict, claims.HOLDS)
        value["benchmarks"] = [row for row in value["benchmarks"] if "/n:3000/" not in row["name"]]
        self.assertEqual(judged("growth-aCPU2-nlogn", value).verdict, claims.UNTESTED)


class Brute(unittest.TestCase):
    """CPU1 at 10,000 spheres: a few samples beside another load decide nothing."""

    def verdict(self, times):
        value = made.run()
        value["catena"]["variants"]["CPU1"] = made.described("CPU1")
        value["benchmarks"] += [
            {"name": "path1/n:10000/CPU1/find", "run_type": "iteration", "real_time": t, "time_unit": "ms"} for t in times
        ]
        return judged("cpu1-slow", value).verdict

    def test_it_takes_six_samples(self):
        self.assertEqual(self.verdict([1600] * 4), claims.UNTESTED)
        self.assertEqual(self.verdict([1600] * 6), claims.HOLDS)
        self.assertEqual(self.verdict([60] * 6), claims.FAILS)


class Undecided(unittest.TestCase):
    """A verdict takes intervals that lie on one side: samples made by hand, whose median alone would say more."""

    def judge(self, key, times):
        """Of {(path, n, variant, stage): milliseconds}."""
        value = made.run(repetitions=1)
        value["catena"]["variants"]["CPU1"] = made.described("CPU1")
        value["benchmarks"] = [
            {"name": f"{path}/n:{n}/{variant}/{stage}", "run_type": "iteration", "real_time": t, "time_unit": "ms"}
            for (path, n, variant, stage), several in times.items()
            for t in several
        ]
        return judged(key, value)

    def halved(self, factors):
        """GPUv2 and GPU2 at as many sizes, this factor apart."""
        return {
            ("path1", 1000 * (at + 1), variant, "find"): [factor if "v2" in variant else 1.0] * 6
            for at, factor in enumerate(factors)
            for variant in ("aGPU2+GPU2", "aGPU2+GPUv2")
        }

    def test_half_is_all_of_the_interval(self):
        for factors, verdict in (
            ((0.50, 0.51, 0.49), claims.HOLDS),
            ((0.62, 0.61, 0.60), claims.FAILS),
            ((0.40, 0.50, 0.60), claims.UNTESTED),  # 0.49, but its interval reaches past 0.55
            ((0.45, 0.60, 0.75), claims.UNTESTED),  # 0.59, likewise
            ((0.53, 0.55, 0.57), claims.UNTESTED),  # 0.55, within 0.50 and 0.60
            ((0.50,), claims.UNTESTED),
        ):
            self.assertEqual(self.judge("half", self.halved(factors)).verdict, verdict, factors)

    def race(self, *pairs):
        return {
            ("path1", 20000 + 1000 * at, variant, "build"): times
            for at, pair in enumerate(pairs)
            for variant, times in zip(("aGPU2+GPU2", "aCPU2+CPU2"), pair)
        }

    def test_quicker_at_every_size(self):
        one, two, either = [1.0, 1.1] * 3, [2.0, 2.1] * 3, [0.5, 4.0] * 3
        for pairs, verdict in (
            (((one, two),), claims.HOLDS),
            (((one, two), (two, one)), claims.FAILS),
            (((one, two), (either, two)), claims.UNTESTED),
            (((either, two), (two, one)), claims.FAILS),
        ):
            self.assertEqual(self.judge("build-20000", self.race(*pairs)).verdict, verdict)

    def growing(self, **exponents):
        return {
            (path, n, "aCPU2+CPU2", "build"): [n**exponent * 1e-4 * (1 + wave * (-1) ** at)] * 6
            for path, (exponent, wave) in exponents.items()
            for at, n in enumerate(made.SIZES)
        }

    def test_a_law_holds_on_both_paths_or_does_not(self):
        flat, steep, open_ = (1, 0), (2, 0), (1, 0.6)
        for exponents, verdict in (
            ({"path1": flat, "path2": flat}, claims.HOLDS),
            ({"path1": flat, "path2": steep}, claims.FAILS),
            ({"path1": open_, "path2": steep}, claims.FAILS),
            ({"path1": flat, "path2": open_}, claims.UNTESTED),
            ({"path2": steep}, claims.FAILS),
        ):
            self.assertEqual(self.judge("growth-aCPU2-nlogn", self.growing(**exponents)).verdict, verdict, exponents)

    def test_the_slowest_is_slower_beyond_the_intervals(self):
        others = {("path1", 1000, variant, "find"): [1.0] * 6 for variant in ("aCPU2+CPU2", "aGPU2+GPU2", "aGPU2+GPUv2")}
        for times, verdict in (([1.5, 1.6] * 3, claims.HOLDS), ([0.5, 2.0, 2.0] * 2, claims.FAILS), ([1.0] * 6, claims.FAILS), ([0.5] * 6, claims.FAILS)):
            found = self.judge("gpu1-slowest", {**others, ("path1", 1000, "GPU1", "find"): times})
            self.assertEqual(found.verdict, verdict, times)

    def test_1500_ms_are_the_lower_end(self):
        for times, verdict in (([1500] * 6, claims.HOLDS), ([1490, 1600, 1600] * 2, claims.FAILS)):
            self.assertEqual(self.judge("cpu1-slow", {("path1", 10000, "CPU1", "find"): times}).verdict, verdict)
            both = {("path1", 10000, "CPU1", "find"): [1500] * 6, ("path2", 10000, "CPU1", "find"): times}
            self.assertEqual(self.judge("cpu1-slow", both).verdict, verdict, "of both paths")

    def test_pairs_are_missed_by_whatever(self):
        value = made.run(repetitions=1)
        few = {"input": "b", "missing": 5, "lost_by_tree": 1, "parents": 9, "failing": 9}  # but all that it has
        none = {"input": "c", "missing": 3, "failing": 0}  # of decisions alone
        value["catena"]["examine"] += [{**value["catena"]["examine"][0], **other} for other in (few, none)]
        said = judged("encloses", value).evidence
        self.assertIn("2 chains of 3 have such parents, and 10 pairs in all are missed", said)
        self.assertIn("100 % of the parents of b do not", said)


class Committed(unittest.TestCase):
    def test_the_stored_verdicts_are_those_of_the_stored_runs(self):
        runs = [runfile.load(RESULTS / name) for name in ("h200_tables.json", "h200_quick.json.gz")]
        found = committed.verdicts_of(runs)
        if os.environ.get("CATENA_WRITE_GOLDEN"):
            committed.PATH.write_text(json.dumps(found, indent=1) + "\n")
        self.assertEqual(json.loads(committed.PATH.read_text()), found)

    def built(self, value):
        with tempfile.TemporaryDirectory() as folder:
            return section.build(report.Report([runfile.load(made.write(folder, value))]))

    def test_they_stand_beside_and_are_marked(self):
        value = made.run()
        value["benchmarks"] = [row for row in value["benchmarks"] if "GPU" not in row["name"]]
        blocks = self.built(value).blocks
        rows = [[cell.text for cell in row] for row in blocks[1].rows]
        marked = [row for row in rows if row[2].startswith("NVIDIA H200, committed")]
        stored = json.loads(committed.PATH.read_text())["claims"]
        self.assertEqual(len(marked), len(stored))
        self.assertTrue(any("GPU1 is the slowest" in row[0] for row in marked))
        self.assertTrue(all(row[3] != claims.UNTESTED for row in rows))
        places = [(row[2].startswith("NVIDIA H200, committed"), row[3] == claims.HOLDS) for row in rows]
        self.assertEqual(places, sorted(places))  # this page's first, and of each what does not hold
        self.assertEqual(len(set(places)), 4)
        self.assertEqual([block.folded for block in blocks if hasattr(block, "folded")], [False, True, True])
        self.assertIn("not measured here", blocks[0].text)
        self.assertTrue(blocks[2].folded)
        self.assertIn("that no run of this page can test", blocks[2].text)
        decided = [point for point in blocks[2].points if point.endswith("(decided by the committed run, above).")]
        self.assertEqual(len(decided), len({row[0] for row in marked} - {row[0] for row in rows if row not in marked}))

    def test_they_are_marked_where_there_are_no_others(self):
        value = made.run()
        value["benchmarks"] = []
        for key in ("keyframes", "animation", "examine"):
            value["catena"].pop(key, None)
        prose, table, *_ = self.built(value).blocks
        self.assertIn("No run of this page can test any.", prose.text)
        self.assertEqual({row[table.columns.index("run")].kind for row in table.rows}, {"committed"})

    def test_not_on_a_page_of_that_device(self):
        value = made.run()
        value["context"]["gpu"] = json.loads(committed.PATH.read_text())["device"]
        self.assertNotIn("committed", "".join(block.text for block in self.built(value).blocks if hasattr(block, "text")))


class OnThePage(unittest.TestCase):
    def verdicts(self, shown):
        return {row[0]: row[3] for row in shown.rows("claims") if row[2] == "a GPU"}

    def test_claims_follow_the_data(self):
        shown = pages.shown(made.run())
        verdicts = self.verdicts(shown)
        self.assertEqual(
            verdicts["Two threads per sphere (GPUv2) reduce the time of GPU2 by half."], "holds"
        )  # 5e-5 of 1e-4
        self.assertEqual(verdicts["Despite the GPU, GPU1 is the slowest traversal."], "holds")
        self.assertEqual(
            verdicts["GPU2 takes O(log n) time, since its n threads run in parallel."], "does not hold"
        )  # made linear
        self.assertEqual(verdicts["aCPU2 takes O(n log n) time."], "holds")
        self.assertEqual(verdicts["A parent encloses its two children."], "does not hold")
        self.assertNotIn("bGPU2 takes O(log n) time.", verdicts)
        self.assertIn("<strong>bGPU2 takes O(log n) time.</strong> bGPU2 was not timed at four sizes", shown.prose)

    def test_verdicts_turn_with_the_data(self):
        """Half the claim broken: with GPUv2 as slow as GPU2 the verdict must turn."""
        verdicts = self.verdicts(pages.shown(made.run(slower={("aGPU2+GPUv2", "find"): 2, ("GPU1", "find"): 0.01})))
        self.assertEqual(
            verdicts["Two threads per sphere (GPUv2) reduce the time of GPU2 by half."], "does not hold"
        )
        self.assertEqual(verdicts["Despite the GPU, GPU1 is the slowest traversal."], "does not hold")


class Evidence(unittest.TestCase):
    """The numbers beside a verdict, from the samples."""

    @classmethod
    def setUpClass(cls):
        cls.value = made.run()
        shown = pages.shown(cls.value)
        cls.evidence = {row[0]: row[4] for row in shown.rows("claims") if row[2] == "a GPU"}

    def median(self, path, n, variant, stage):
        name = f"{path}/n:{n}/{variant}/{stage}/manual_time"
        return plain.median(row["real_time"] for row in self.value["benchmarks"] if row["name"] == name)

    @recomputes("table:claims")
    def test_ratios_exponents_and_counts(self):
        ratios = [
            self.median(path, n, "aGPU2+GPUv2", "find") / self.median(path, n, "aGPU2+GPU2", "find")
            for path in made.SCENES
            for n in made.SIZES
        ]
        said = self.evidence["Two threads per sphere (GPUv2) reduce the time of GPU2 by half."]
        self.assertRegex(
            said,
            rf"takes {plain.geometric_mean(ratios):.2f} \[.* over {len(ratios)} cases\), between {min(ratios):.2f} and"
            rf" {max(ratios):.2f}",
        )
        said = self.evidence["CPU2 takes O(n log n) time."]
        for path in made.SCENES:
            x = [math.log(n) for n in made.SIZES]
            y = [math.log(self.median(path, n, "aCPU2+CPU2", "find")) for n in made.SIZES]
            law = [value - math.log(n * math.log2(n)) for n, value in zip(made.SIZES, y)]
            slope, over_law = (plain.linear_regression(x, values).slope for values in (y, law))
            self.assertIn(f"{path}, 1,000 to 100,000 spheres: time grows as n to the {slope:.2f} [", said)
            self.assertIn(f"time / (n log n) as n to the {over_law:.2f} [", said)
        row = self.value["catena"]["examine"][0]
        said = self.evidence["A parent encloses its two children."]
        self.assertIn(f"{100 * row['failing'] / row['parents']:.0f} % of the parents of {row['input']}", said)
        most = max(max(row["pairs"]) for row in self.value["catena"]["keyframes"])
        said = self.evidence["Both paths generate a maximum of 45 pairs of collisions."]
        self.assertIn(f"path1: at most {most} pairs in all 56 keyframes", said)
        self.assertIn("at 2 of 2 sizes from 20,000 on", self.evidence["aGPU2 is faster than aCPU2 from 20,000 spheres on."])


if __name__ == "__main__":
    unittest.main()
