"""Steps a sphere, computed a second time from the rows of the run."""
import json
import statistics as plain
import unittest

import made
from catena_report import report, runfile
from catena_report.sections import steps
from pages import recomputes


class Made(unittest.TestCase):
    def setUp(self):
        self.value = made.run()

    def table(self):
        run = runfile.Run("run.json", json.loads(json.dumps(self.value)))
        (table,) = steps.build(report.Report([run])).blocks
        return run, table

    @recomputes("table:steps")
    def test_a_sphere_takes_its_share(self):
        self.value["catena"]["steps"][-1]["steps"].append({"step": "visits", "times": 5})  # of one search alone
        run, table = self.table()
        self.assertEqual(table.columns[5:], ["rows", "tests", "visits"])
        self.assertEqual(len(table.rows), len(run.list("steps")))
        for row in table.rows:
            input_, variant = row[0].text, row[1].text
            n = int(input_.split(":")[1])
            given = next(r for r in run.list("steps") if (r["input"], r["variant"]) == (input_, variant))
            times = [
                r["real_time"] for r in run.raw["benchmarks"] if r["name"] == f"{input_}/{variant}/find/manual_time"
            ]
            ns = plain.median(times) / n
            self.assertAlmostEqual(row[2].raw, ns)
            (copies,) = [c["gb_s"] for c in run.catena["bandwidth"]["sizes"] if c["copied_bytes"] == 32 * n]
            self.assertAlmostEqual(row[3].raw, ns * plain.median(copies) / 32)  # 16 read and 16 written
            self.assertAlmostEqual(row[4].raw, given["pairs"] / n)
            taken = {step["step"]: step["times"] for step in given["steps"]}
            self.assertEqual([cell.raw for cell in row[5:]], [taken[s] / n if s in taken else "" for s in table.columns[5:]])

    def test_rows_are_by_scene_size_and_variant(self):
        self.value["catena"]["steps"].reverse()
        _, table = self.table()
        inputs = [row[0].text.split(":") for row in table.rows]
        keys = [(scene, int(n), row[1].text) for (scene, n), row in zip(inputs, table.rows)]
        self.assertGreater(len({n for _, n, _ in keys}), 1)
        self.assertEqual(keys, sorted(keys))

    def copies(self, gb_s):
        for copied in self.value["catena"]["bandwidth"]["sizes"]:
            copied["gb_s"] = [gb_s] * 6

    def takes(self, ns):
        """Every find takes so many ns a sphere."""
        for row in self.value["benchmarks"]:
            if "/find" in row["name"] and "real_time" in row:
                row["real_time"] = ns * int(row["name"].partition("/n:")[2].partition("/")[0])

    def test_a_chain_in_a_cache_is_not_held_against_memory_that_no_cache_holds(self):
        """A search that takes a tenth of a copy at the pace of an array of 268 MB is not bound by that memory."""
        self.takes(0.3)
        for cache_gb_s, says in (
            (400.0, "Reading the chain once takes at most half the time of all 16 searches"),
            (100.0, "what bounds them, memory or steps, is not known"),
        ):
            self.copies(cache_gb_s)
            _, table = self.table()
            self.assertIn(says, table.title)
            self.assertNotIn("Memory bounds", table.title)
            for row in table.rows:
                self.assertAlmostEqual(row[3].raw, 0.3 * cache_gb_s / 32)

    def test_the_title_says_how_many_take_two_copies(self):
        for gb_s in (10.0, 1.0, 0.2, 0.15, 0.001):
            self.copies(gb_s)
            _, table = self.table()
            sure = [row[3].raw for row in table.rows if row[3].raw >= 2]
            if not sure:
                self.assertIn("In the time of each of 16 searches the chain could be copied less than twice", table.title)
                continue
            self.assertIn(f"half the time of {'all 16' if len(sure) == 16 else f'{len(sure)} of 16'} searches", table.title)
            self.assertEqual(f"what bounds the other {16 - len(sure)}, memory or steps, is not known" in table.title, len(sure) < 16)

    def test_the_caption_says_what_copies_of_the_chains_carry(self):
        _, table = self.table()
        self.assertIn("20.0 to 80.0 GB/s", table.caption)
        self.assertNotIn("not measured", table.caption)

    def test_a_run_without_copies_of_that_size_says_so(self):
        """One from before they were measured, where no rate of another size stands in for them."""
        for gone in ("sizes", None):
            self.value["catena"]["bandwidth"].pop("sizes", None)
            if gone is None:
                del self.value["catena"]["bandwidth"]
            _, table = self.table()
            self.assertEqual(table.columns[:5], ["chain", "variant", "ns", "pairs", "rows"])
            self.assertIn("whether memory bounds them is not known", table.title)
            self.assertIn("Copies of arrays as long as the chains were not measured in this run", table.caption)
            self.assertEqual("Those of a longer one" in table.caption, gone is not None)
            self.assertNotIn("GB/s", table.caption)

    def test_chains_of_which_no_copy_was_measured_are_named(self):
        sizes = self.value["catena"]["bandwidth"]["sizes"]
        self.value["catena"]["bandwidth"]["sizes"] = [c for c in sizes if c["copied_bytes"] != 32 * 3000] + [
            {"copied_bytes": 32 * 3000, "gb_s": []}
        ]
        _, table = self.table()
        self.assertEqual({row[0].text for row in table.rows if row[3].raw == ""}, {"path1/n:3000", "path2/n:3000"})
        self.assertIn("of all 12 searches", table.title)
        self.assertIn("No copy as long as path1/n:3000 and path2/n:3000 was measured", table.caption)

    def test_a_chain_that_no_cache_holds_has_the_copy_of_the_long_array(self):
        bandwidth = self.value["catena"]["bandwidth"]
        bandwidth.update(copied_bytes=32 * 10_000, sizes=[c for c in bandwidth["sizes"] if c["copied_bytes"] < 32 * 10_000])
        run, table = self.table()
        for row in table.rows:
            n = int(row[0].text.split(":")[1])
            self.assertAlmostEqual(row[3].raw, row[2].raw * {1000: 80, 3000: 60}.get(n, 10) / 32)

    def test_a_chain_of_this_section_alone_brings_its_times(self):
        row = self.value["catena"]["steps"][0]
        self.value["catena"]["steps"].append({**row, "input": "path1/n:30000", "find_ms": [3.0, 9.0, 6.0]})
        self.value["catena"]["bandwidth"]["sizes"].append({"copied_bytes": 32 * 30_000, "gb_s": [16.0]})
        _, table = self.table()
        (own,) = [row for row in table.rows if row[0].text == "path1/n:30000"]
        self.assertAlmostEqual(own[2].raw, 200)
        self.assertAlmostEqual(own[3].raw, 100)

    def test_no_steps_no_section(self):
        del self.value["catena"]["steps"]
        run = runfile.Run("run.json", json.loads(json.dumps(self.value)))
        self.assertIsNone(steps.build(report.Report([run])))


if __name__ == "__main__":
    unittest.main()
