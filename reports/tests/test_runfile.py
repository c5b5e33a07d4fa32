"""How a run file is read, and what is told of it by words alone."""
import json
import pathlib
import tempfile
import unittest

import made  # noqa: F401  (finds catena_report)
import shown_chains
from catena_report import runfile, statistics, words


def run(rows=(), **catena):
    benchmarks = [{"name": "path1/n:10/CPU1/find/manual_time", **row} for row in rows]
    return runfile.Run("run.json", {"context": {}, "benchmarks": benchmarks, "catena": catena})


CASE = ("path1/n:10", "CPU1", "find")


class Rows(unittest.TestCase):
    def test_a_time_is_in_the_unit_that_it_names_and_in_nanoseconds_without(self):
        rows = [{"real_time": 3e6}, {"real_time": 3, "time_unit": "ms"}, {"real_time": 0.003, "time_unit": "s"}]
        self.assertEqual([round(ms, 9) for ms in run(rows).samples[CASE]], [3, 3, 3])

    def test_rows_that_were_computed_of_others_are_no_samples(self):
        rows = [{"real_time": 1}, {"real_time": 2, "run_type": "aggregate"}, {"real_time": 0, "run_type": "iteration"}]
        self.assertEqual(len(run(rows).samples[CASE]), 2)

    def test_a_time_that_is_none_is_refused(self):
        for time in (-1, float("inf"), float("nan")):
            with self.assertRaisesRegex(runfile.BadRunFile, r"benchmarks\[1\] has the time"):
                run([{"real_time": 1}, {"real_time": time}])

    def test_a_refusal_is_a_fault_only_where_it_says_so(self):
        refused = run([{"error_occurred": True, "error_message": "too long"}])
        self.assertEqual((refused.refused, refused.faults, refused.samples), ({CASE: "too long"}, {}, {}))
        faulty = run([{"error_occurred": True, "error_message": "wrong", "at_fault": True}])
        self.assertEqual(faulty.faults, {CASE: "wrong"})
        self.assertEqual(run([{"error_occurred": True}]).refused, {CASE: "refused, no reason given"})
        self.assertEqual(faulty.named(), {"CPU1"})

    def test_what_moves_between_memories_is_nothing_where_none_is_told(self):
        self.assertEqual(run([{"real_time": 1}, {"real_time": 1, "transfer_ms": 2}]).moved[CASE], [0, 2])

    def test_inputs_come_by_scene_then_size(self):
        rows = [{"name": f"{input_}/CPU1/find", "real_time": 1} for input_ in ("b/n:5", "a/n:100", "a/n:20")]
        self.assertEqual(run(rows).inputs(), ["a/n:20", "a/n:100", "b/n:5"])

    def test_a_density_is_of_a_sphere(self):
        rows = [{"real_time": 1, "pairs": 99, "name": "path1/n:9/CPU1/find"}, {"real_time": 1, "pairs": 25}]
        self.assertEqual((run(rows).pairs("path1/n:10"), run(rows).density("path1/n:10")), (25, 2.5))
        self.assertEqual((run(rows).pairs("path1/n:8"), run(rows).density("path1/n:8")), (None, None))
        for pairs, density in ((0, 0), (40, 3)):  # what the scene says of itself leads
            one = run(rows, scenes=[{"input": "path1/n:10", "density": density, "pairs": pairs}])
            self.assertEqual((one.pairs("path1/n:10"), one.density("path1/n:10")), (pairs, density))

    def test_host_and_device_have_their_own_names(self):
        one = run()
        one.context.update(gpu="NVIDIA H200", cpu="Intel(R) Xeon(R)")
        self.assertEqual((one.device, one.host), ("NVIDIA H200", "Intel Xeon"))

    def test_a_variant_that_is_not_described_is_said(self):
        with self.assertRaisesRegex(runfile.BadRunFile, "no catena.variants"):
            run().info("CPU1")


class Files(unittest.TestCase):
    def refusal(self, value):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "run.json"
            path.write_text(json.dumps(value), encoding="utf-8")
            with self.assertRaises(runfile.BadRunFile) as raised:
                runfile.load(path)
        return str(raised.exception).partition(": ")[2]

    def test_what_is_no_run_file_is_said_of_the_place_where_it_is_none(self):
        whole = {"context": {}, "benchmarks": [], "catena": {}}
        self.assertIn("schema 2, this report reads 1", self.refusal({**whole, "catena": {"schema": 2}}))
        self.assertIn("benchmarks holds something else than objects", self.refusal({**whole, "benchmarks": [1]}))
        self.assertIn("catena.regret is not an array", self.refusal({**whole, "catena": {"regret": {}}}))
        self.assertIn("catena.steps holds something else", self.refusal({**whole, "catena": {"steps": [[]]}}))
        self.assertIn("catena is not an object", self.refusal({**whole, "catena": []}))

    def test_what_would_fail_later_is_refused_by_its_name(self):
        whole = {"context": {}, "benchmarks": [], "catena": {}}
        self.assertIn("context.date is not a text", self.refusal({**whole, "context": {"date": 5}}))
        self.assertIn("schema true, this report reads 1", self.refusal({**whole, "catena": {"schema": True}}))
        self.assertIn("catena.stopping is not an object", self.refusal({**whole, "catena": {"stopping": []}}))
        row = {"name": "path1/n:10/CPU1/find", "real_time": True}
        self.assertIn("benchmarks[0] has no real_time", self.refusal({**whole, "benchmarks": [row]}))

    def test_a_view_that_cannot_be_unpacked_is_refused(self):
        whole = {"context": {}, "benchmarks": []}
        good = shown_chains.views()[-1]
        frame = good["frames"][0]
        refused = lambda view: self.refusal({**whole, "catena": {"viewer": [good, view]}})  # noqa: E731
        for broken, said in (
            ({"spheres": "AAAA"}, "spheres is not base64 of one sphere"),
            ({"spheres": ""}, "spheres is not base64 of one sphere"),
            ({"spheres": "A"}, "spheres is not base64 of one sphere"),
            ({"pairs": "AAAA"}, "pairs is not base64 of pairs"),
            ({"frame": "0"}, "frame is no number"),
            ({"frame": 0.5}, "frame is no number"),
            ({"frame": True}, "frame is no number"),
            ({"box": [1, 2, 3]}, "box is no array of six numbers"),
        ):
            self.assertIn(f"catena.viewer[1].frames[0].{said}", refused({**good, "frames": [{**frame, **broken}]}))
        for broken, said in (
            ({"frames": []}, "frames is no array of one frame or more"),
            ({"levels": [{"level": 0}]}, "levels[0].spheres is not base64"),
            ({"wrong": [{"variant": "a", "frame": 0}]}, "wrong[0] lacks"),
        ):
            self.assertIn(f"catena.viewer[1].{said}", refused({**good, **broken}))
        self.assertIn("catena.viewer[1].frames is no array", refused({"input": "x/n:3"}))

    def test_a_variant_that_only_others_are_described_beside_is_said(self):
        stage = {"text": "CPU1", "algorithm": "CPU1", "on_host": False, "place": "host"}
        known = {"stages": [stage], "arithmetic": "robust", "exact": True, "peer": False, "all_pairs": True}
        one = run(variants={"CPU1": known})
        self.assertTrue(one.info("CPU1").recommended)
        with self.assertRaisesRegex(runfile.BadRunFile, "catena.variants does not have CPU2"):
            one.info("CPU2")


class Names(unittest.TestCase):
    def test_a_scene_is_known_without_its_n_alone(self):
        for input_, expected in (
            ("path1/n:30", ("path1", 30)),
            ("far:exponent=22/n:30", ("far:exponent=22", 30)),
            ("far:exponent=22,n=30", ("far:exponent=22", 30)),
            ("far:n=30,name=x", ("far:name=x", 30)),
            ("far:bin=3", ("far:bin=3", None)),
            ("neuron.swc", ("neuron.swc", None)),
        ):
            self.assertEqual(runfile.scene_and_n(input_), expected)

    def test_a_command_shows_the_chain_as_it_was_run(self):
        row = {"input": "far:exponent=3/n:30", "frame": 28, "frames": 56, "options": " --window 2"}
        one = run(scenes=[row], viewer=[{"input": "path1/n:10", "command": "catena detect path1:n=10"}])
        self.assertEqual(
            runfile.replay(one, "far:exponent=3/n:30", "CPU1"),
            "catena detect far:exponent=3,n=30 --window 2 --frame 28 --variant CPU1",
        )
        self.assertEqual(runfile.replay(one, "path1/n:10"), "catena detect path1:n=10")
        self.assertEqual(
            runfile.replay(one, "path1/n:10", "CPU1"), "catena detect path1:n=10 --variant CPU1"
        )
        row.update(frame=1, frames=2)  # the fewest of which one is told
        self.assertTrue(runfile.replay(one, "far:exponent=3/n:30").endswith(" --frame 1"))
        row.update(frames=1, spec="of a file")
        self.assertEqual(runfile.replay(one, "far:exponent=3/n:30"), "catena detect 'of a file' --window 2")


class Words(unittest.TestCase):
    def test_numbers_of_any_size_are_short(self):
        for value, text in ((1.2345e-12, "1.23e-12"), (1.2345e13, "1.23e+13"), (0.00012345, "0.000123"), (123456, "123,456")):
            self.assertEqual(words.significant(value, 3), text)

    def test_a_duration_has_the_unit_that_suits_it(self):
        for ms, text in ((0.0123, "12.3 µs"), (0.1, "0.100 ms"), (999, "999 ms"), (1000, "1.00 s")):
            self.assertEqual(words.duration(ms), text)

    def test_a_duration_and_its_interval_have_one_unit_and_digits_alike(self):
        for ends, text in (
            ((95, 90.1, 150.2), "95.0 [90.1, 150.2] ms"),
            ((0.0123, 0.0119, 0.2), "12.3 [11.9, 200.0] µs"),
            ((1200, 998, 1250.4), "1.20 [1.00, 1.25] s"),
            ((0, 0, 0), "0 [0, 0] µs"),
        ):
            self.assertEqual(words.duration_interval(statistics.Interval(*ends)), text)

    def test_all_and_none_are_said_of_no_other_share(self):
        for number, of, places, text in (
            (2050, 2050, 1, "100.0 %"), (2049, 2050, 1, "> 99.9 %"), (1, 2050, 1, "< 0.1 %"), (0, 2050, 1, "0.0 %"),
            (1999, 2000, 1, "> 99.9 %"), (1998, 2000, 1, "99.9 %"), (199, 200, 0, "> 99 %"), (1, 300, 0, "< 1 %"), (1, 3, 1, "33.3 %"),
        ):  # fmt: skip
            self.assertEqual(words.percent(number, of, places), text)

    def test_what_holds_commas_is_set_apart(self):
        self.assertEqual([words.apart("abc", most) for most in (3, 2)], ["a; b; c", "a; b; and 1 more"])

    def test_an_interval_has_digits_that_suit_it(self):
        for ends, text in (
            ((1.02, 0.98, 1.06), "1.02 [0.98, 1.06]"),
            ((1.02, 1.02, 1.02), "1.02"),
            ((0.0512, 0.0498, 0.0531), "0.0512 [0.0498, 0.0531]"),
            ((99.5, 98.25, 99.9), "99.50 [98.25, 99.90]"),
            ((150.2, 98.25, 200.4), "150 [98.2, 200]"),
            ((-0.02, -0.05, 0.01), "-0.02 [-0.05, 0.01]"),
        ):
            self.assertEqual(words.interval(statistics.Interval(*ends)), text)

    def test_many_names_are_counted(self):
        self.assertEqual(words.listed("abc", 3), "a, b and c")
        self.assertEqual(words.listed("abcd", 3), "a, b, c and 1 more")
        self.assertEqual(words.listed([]), "none")
        self.assertEqual([words.plural(k, "pair") for k in (0, 1, 2)], ["0 pairs", "1 pair", "2 pairs"])


if __name__ == "__main__":
    unittest.main()
