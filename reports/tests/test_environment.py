"""The environment's tables and the sentences of the first screen, each number counted from the raw run."""
import re
import statistics as plain
import unittest

import scipy.stats

import made
import pages
from catena_report.sections import environment
from pages import recomputes


class Environment(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.value = made.run()
        cls.shown = pages.shown(cls.value)
        cls.times = {}
        for row in cls.value["benchmarks"]:
            if "real_time" in row:
                cls.times.setdefault(row["name"], []).append(row["real_time"])

    @recomputes("table:environment")
    def test_what_the_run_recorded_of_itself(self):
        rows = dict(self.shown.rows("environment"))
        context = self.value["context"]
        for key in ("commit", "cpu", "gpu", "compiler", "flags", "date"):
            self.assertEqual(rows[key], context[key])
        self.assertEqual((rows["num_cpus"], rows["mhz_per_cpu"]), ("2", "2600"))
        self.assertEqual((rows["profile"], rows["measuring took, s"]), ("custom", "12.50"))
        dirty = next(row[1] for row in self.shown.tables["environment"].rows if row[0].text == "commit")
        self.assertEqual(dirty.kind, "bad")

    def test_each_run_has_a_column_of_its_own(self):
        other = made.run(repetitions=1)
        other["context"]["cpu"] = "another"
        other["catena"].update(profile="quick", seconds=7.25)
        rows = {name: texts for name, *texts in pages.Shown(pages.of(self.value), pages.of(other)).rows("environment")}
        self.assertEqual(rows["cpu"], [self.value["context"]["cpu"], "another"])
        self.assertEqual(rows["profile"], ["custom", "quick"])
        self.assertEqual(rows["measuring took, s"], ["12.50", "7.250"])

    def test_how_others_built_their_library_is_not_shown_as_how_catena_was_built(self):
        value = made.run()
        value["context"] |= {"build type": "Release", "library_build_type": "debug"}
        rows = dict(pages.shown(value).rows("environment"))
        self.assertEqual(rows["build type"], "Release")
        self.assertNotIn("debug", rows.values())

    def test_a_build_without_optimization_is_marked(self):
        for built, kind in (("DEBUG", "bad"), ("Release", "")):
            value = made.run()
            value["context"]["build type"] = built
            cell = next(row[1] for row in pages.shown(value).tables["environment"].rows if row[0].text == "build type")
            self.assertEqual((cell.text, cell.kind), (built, kind))

    @recomputes("table:scenes")
    def test_chains_that_were_run(self):
        keys = "input", "summary", "hash", "n", "frame", "frames", "pairs", "max_count", "density", "smallest_margin"
        self.assertEqual(
            self.shown.raw("scenes"), [[scene[key] for key in keys] for scene in self.value["catena"]["scenes"]]
        )

    def test_a_chain_in_a_box_is_shown_with_it(self):
        self.assertNotIn("box", self.shown.tables["scenes"].columns)
        value = made.run()
        value["catena"]["scenes"][0] |= {"box": "9,9,9,1,0,0", "images": 1234}
        shown = pages.shown(value)
        columns = shown.tables["scenes"].columns
        first, second = shown.raw("scenes")[:2]
        self.assertEqual([first[columns.index(name)] for name in ("box", "images")], ["9,9,9,1,0,0", 1234])
        self.assertEqual([second[columns.index(name)] for name in ("box", "images")], ["", ""])
        self.assertEqual(first[columns.index("n")], value["catena"]["scenes"][0]["n"])

    def test_when_measuring_stopped(self):
        stopping = self.value["catena"]["stopping"]
        self.assertIn(f"{stopping['narrow']} of {stopping['cases']} cases became that narrow", self.shown.prose)

    def test_how_narrow_it_became_and_what_was_not_reached(self):
        value = made.run()
        value["catena"]["stopping"] |= {"share": 0.05, "narrow": 1, "cases": 7, "not_reached": ["a", "b"]}
        prose = pages.shown(value).prose
        self.assertIn("was within 5 % of the median, at most 9 times and 90 s in all", prose)
        self.assertIn("1 of 7 cases became that narrow, 2 were not reached", prose)

    def test_what_was_measured_so_many_times_has_no_width_to_become(self):
        value = made.run()
        value["catena"]["stopping"] |= {"share": 0, "narrow": 0, "cases": 18, "most_samples": 3, "not_reached": []}
        for seconds, said in ((30, " where 30 s in all sufficed. Intervals"), (environment.UNLIMITED, ". Intervals")):
            value["catena"]["stopping"]["seconds"] = seconds
            prose = pages.shown(value).prose
            self.assertIn("each measured 3 times" + said, prose)
            self.assertNotIn("became that narrow", prose)

    def test_each_reason_for_a_refusal_is_told_of_those_that_gave_it(self):
        value = made.run()
        value["benchmarks"] = [row for row in value["benchmarks"] if not row.get("error_occurred")]
        for variant in ("bGPU2+GPU2", "bGPU2@host+GPU2"):
            for n in (3000, 10000):
                stage = variant.partition("+")[0]
                why = {"error_occurred": True, "error_message": f"{stage} takes at most 1536 spheres, got {n}"}
                value["benchmarks"].append({"name": f"path1/n:{n}/{variant}/whole", **why})
                value["catena"]["variants"][variant] = made.described(variant)
        self.assertIn(
            "<strong>Refused</strong>: 2 measurements of bGPU2+GPU2 (“bGPU2 takes at most 1536 spheres, got 3000”); 2"
            " measurements of bGPU2@host+GPU2 (“bGPU2@host takes at most 1536 spheres, got 3000”).",
            pages.shown(value).prose,
        )

    def test_false_alarms_are_a_share_of_the_cases_with_enough_samples(self):
        value = made.run(repetitions=8)
        for row in value["benchmarks"]:  # all of one variant's differ from one sample to the next, two have too few
            if "/GPU1/" in row["name"]:
                row["real_time"] *= 1 + row["repetition_index"] % 2
        value["benchmarks"] = [
            row for row in value["benchmarks"]
            if not ("/aCPU2+Dual/" in row["name"] and row.get("repetition_index", 0) > 5)
        ]
        told = re.search(r"samples of each of ([\d,]+) cases \(8 or more of each; ([\d,]+) were timed\).* calls (\d+) of them"
                         r" \(([\d.]+) %\) different", pages.shown(value).prose)
        cases, of, alarms = (int(told[k].replace(",", "")) for k in (1, 2, 3))
        names = {row["name"] for row in value["benchmarks"] if "real_time" in row}
        self.assertEqual((cases, of), (sum("aCPU2+Dual" not in name for name in names), len(names)))
        self.assertGreaterEqual(alarms, sum("/GPU1/" in name for name in names))
        self.assertEqual(told[4], f"{100 * alarms / cases:.1f}")

    def test_sizes_of_caches_and_what_was_built_with_changes(self):
        value = made.run(repetitions=1)
        value["context"]["caches"] = [
            {"type": "Data", "level": 1, "size": 48 * 1024}, {"type": "Unified", "level": 3, "size": 3 * 2**19}
        ]
        for commit, changed in (("0123", False), ("0123-dirty", True), ("0123+", True)):
            value["context"]["commit"] = commit
            rows = {row[0].text: row[1] for row in pages.shown(value).tables["environment"].rows}
            self.assertEqual(rows["caches"].text, "L1 data 48 KiB, L3 unified 1.5 MiB")
            self.assertEqual((rows["commit"].kind, bool(rows["commit"].hint)), ("bad", True) if changed else ("", False))

    def test_what_was_taken_out_is_said(self):
        value = made.run()
        value["catena"]["removed"] = ["auto/find: timed from memory"]
        self.assertIn("taken out: auto/find: timed from memory.", pages.shown(value).prose)
        self.assertNotIn("taken out", self.shown.prose)

    def test_what_was_compared_is_counted(self):
        names = {tuple(name.split("/")[:2]): 0 for name in self.times}
        variants = {re.sub(r"/(build|update|find|whole)/manual_time$", "", name.split("/", 2)[2]) for name in self.times}
        samples = sum(map(len, self.times.values()))
        ns = sorted(int(n.removeprefix("n:")) for _, n in names)
        self.assertIn(
            f"{len(variants)} variants on {len({scene for scene, _ in names})} scenes (path1 and path2) of"
            f" {ns[0]:,} to {ns[-1]:,} spheres; {samples:,} timed samples, in 12.5 s.",
            self.shown.prose,
        )

    def test_false_alarms_are_counted_over_even_and_odd_rounds(self):
        alarms = sum(
            scipy.stats.mannwhitneyu(times[::2], times[1::2]).pvalue < 0.05 for times in self.times.values()
        )
        cases = len(self.times)
        said = f"of {cases:,} cases set against themselves {alarms:,} ({100 * alarms / cases:.1f} %)"
        self.assertIn(said, self.shown.prose)

    def test_refusals_and_wrong_answers_are_counted(self):
        refused = [row for row in self.value["benchmarks"] if row.get("error_occurred")]
        self.assertIn(f"{len(refused)} measurement of bGPU2+GPU2", self.shown.prose)
        self.assertIn("<strong>No wrong answer</strong>", self.shown.prose)
        value = made.run()
        next(row for row in value["benchmarks"] if "/GPU1/find" in row["name"])["missing"] = 2.0
        value["benchmarks"].reverse()  # the last repetition of a case speaks for it
        self.assertIn("Wrong answers while timed", pages.shown(value).prose)

    def test_a_variant_that_threw_was_not_refused(self):
        value = made.run()
        value["benchmarks"].append(
            {
                "name": "path1/n:1000/GPU1/whole",
                "run_type": "iteration",
                "error_occurred": True,
                "error_message": "GPU1 threw: <out of memory>",
                "at_fault": True,
            }
        )
        prose = pages.shown(value).prose
        self.assertIn("a fault of its own</strong>: 1 measurement of GPU1 (“GPU1 threw: &lt;out of memory&gt;”)", prose)
        self.assertIn("<strong>Refused</strong>: 1 measurement of bGPU2+GPU2", prose)

    def test_the_right_pairs_on_stiff_scenes_are_counted(self):
        for arithmetic in ("robust", "literal"):
            lines = [line for line in self.value["catena"]["stability"] if line["arithmetic"] == arithmetic]
            right = sum(line["missing"] + line["invented"] == 0 for line in lines)
            self.assertIn(f"{arithmetic} arithmetic in {100 * right / len(lines):.1f} % of {len(lines)}", self.shown.prose)

    def test_the_least_mean_slowdown_is_the_headline(self):
        medians = {}
        for name, times in self.times.items():
            scene, n, variant = name.removesuffix("/manual_time").split("/", 2)
            if variant.endswith("/whole") and "literal" not in variant:
                medians.setdefault((scene, n), {})[variant.removesuffix("/whole")] = plain.median(times)
        means = {
            variant: plain.geometric_mean(row[variant] / min(row.values()) for row in medians.values())
            for variant in next(iter(medians.values()))
        }
        best = min(means, key=means.get)
        self.assertRegex(
            self.shown.prose,
            rf"Over all chains</strong></a> {re.escape(best)} takes {means[best]:.2f}( \[| times)",
        )


if __name__ == "__main__":
    unittest.main()
