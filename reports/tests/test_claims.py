"""The paper's claims: verdicts that rest on all that they need, and the committed ones beside them."""
import json
import os
import tempfile
import unittest

import made
from catena_report import claims, committed, report, runfile
from catena_report.sections import claims as section

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
        for row in value["catena"]["keyframes"]:
            row["pairs"] = [44] * 56
        value["catena"]["scenes"] = []
        value["benchmarks"] = [{**row, "pairs": 44.0} for row in value["benchmarks"]]
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
        self.assertIn("not measured here", blocks[0].text)
        self.assertTrue(blocks[2].folded)
        self.assertIn("that no run of this page can test", blocks[2].text)

    def test_not_on_a_page_of_that_device(self):
        value = made.run()
        value["context"]["gpu"] = json.loads(committed.PATH.read_text())["device"]
        self.assertNotIn("committed", "".join(block.text for block in self.built(value).blocks if hasattr(block, "text")))


if __name__ == "__main__":
    unittest.main()
