"""Nothing takes a variant's name apart: a page needs the run's own table."""
import dataclasses
import json
import pathlib
import tempfile
import unittest

import made
from catena_report import gate, paired, report, runfile, style, variant


class WithoutVariants(unittest.TestCase):
    def refused(self, variants):
        value = made.run()
        value["catena"]["variants"] = variants
        with tempfile.TemporaryDirectory() as folder:
            path = made.write(folder, value)
            with self.assertRaises(runfile.BadRunFile) as raised:
                report.Report([runfile.load(path)])
        return str(raised.exception)

    def test_one_line_says_what_to_do(self):
        full = made.run()["catena"]["variants"]
        less = {name: value for name, value in full.items() if name != "GPU1"}
        for variants, says in (
            (None, "no catena.variants"),
            (less, "does not have GPU1"),
            ({**full, "GPU1": {}}, "not as in reports/run_file.md"),
            ({**full, "GPU1": {**full["GPU1"], "stages": []}}, "not as in reports/run_file.md"),
            ([1], "not as in reports/run_file.md"),
        ):
            line = self.refused(variants)
            self.assertIn(says, line)
            self.assertIn("measure again", line)
            self.assertNotIn("\n", line)

    def test_two_runs_are_compared_all_the_same(self):
        value = made.run()
        del value["catena"]["variants"]
        run = runfile.Run("run.json", value)
        self.assertTrue(gate.decide(paired.cases(run, run))[0])

    def test_what_a_variant_is_comes_from_the_table_alone(self):
        value = made.run()
        text = json.dumps(value)
        for at, name in enumerate(sorted(value["catena"]["variants"], key=len, reverse=True)):
            text = text.replace(name, f"v{at}")
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "run.json").write_text(text)
            run = runfile.load(pathlib.Path(folder) / "run.json")
            pages = report.Report([run])
        self.assertEqual(len(run.recommended()), 5)
        self.assertEqual(sum(run.info(name).rounded for name in run.variants()), 1)

    def test_a_variant_is_of_one_memory_where_all_its_stages_are(self):
        def of(*places):
            stages = tuple(variant.Stage(f"s{at}", f"s{at}", False, place) for at, place in enumerate(places))
            return variant.Variant("v", stages, "robust", True, False, False)

        for places, host, device in (
            (("host",), True, False), (("device",), False, True), (("host", "host"), True, False),
            (("device", "device"), False, True), (("host", "device"), False, False), (("device", "host"), False, False),
        ):  # fmt: skip
            self.assertEqual((of(*places).host_only, of(*places).device_only), (host, device), places)

    def test_a_label_says_settings_and_arithmetic_where_they_matter(self):
        stages = variant.Stage("a@host(k=1)", "a", True, "host"), variant.Stage("b", "b", False, "host")
        exact, literal, peer = (
            variant.Variant("v", stages, arithmetic, arithmetic == "robust", arithmetic == "binary64", False)
            for arithmetic in ("robust", "literal", "binary64")
        )
        self.assertEqual(exact.algorithms, "a@host(k=1)+b")
        self.assertEqual([v.construction_label() for v in (exact, literal)], ["a@host(k=1)", "a@host(k=1)/literal"])
        self.assertEqual([(v.recommended, v.rounded) for v in (exact, literal, peer)], [(True, False), (False, True), (False, False)])
        looks = style.Looks([exact, literal])
        self.assertEqual([looks.construction(v).dash for v in (exact, literal)], ["solid", style.DASHES["literal"]])
        several = [dataclasses.replace(exact, stages=(variant.Stage(k, k, False, "host"), stages[1])) for k in "cdef"]
        self.assertEqual(len({style.Looks(several).variant(v).marker for v in several}), len(several))

    def test_a_mark_is_hollow_where_any_stage_is_a_devices_on_the_host(self):
        for at, on_host in enumerate(((False, False), (True, False), (False, True), (True, True))):
            stages = tuple(variant.Stage(f"s{k}", f"s{k}", own, "host") for k, own in enumerate(on_host))
            drawn = variant.Variant(f"v{at}", stages, "robust", True, False, False)
            self.assertEqual(style.Looks([drawn]).variant(drawn).hollow, any(on_host))


if __name__ == "__main__":
    unittest.main()
