"""What a page finds in its folder: a run.json that may be the only copy of what was measured."""
import contextlib
import io
import json
import pathlib
import tempfile
import unittest
import unittest.mock

import made
from catena_report import __main__ as command
from catena_report import checks, runfile


def run(seed):
    """With the number that Google Benchmark writes into a row of others' spread."""
    rows = [{"name": "a/n:1/GPU1/find", "real_time": seed}, {"name": "cv", "run_type": "aggregate", "transfer_ms": checks.CONSTANTS["NaN"]}]
    return {"context": {"cpu": "C"}, "benchmarks": rows, "catena": {"variants": {"GPU1": made.described("GPU1")}}}


def read(path):
    return json.loads(path.read_text(), parse_constant=checks.CONSTANTS.get)


class Kept(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.page = self.folder / "page"
        self.page.mkdir()
        self.file = {name: str(made.write(folder.name, run(seed), name)) for seed, name in enumerate(("a.json", "b.json"))}

    def page_of(self, *runs):
        """(exit code, what it says, the runs that it has beside it then) of a page made into the folder, but for what is
        drawn.
        """
        err = io.StringIO()
        contents = lambda report: {"run.json": json.dumps([run.raw for run in report.runs]), "index.html": ""}  # noqa: E731
        with unittest.mock.patch("catena_report.page._files", contents), contextlib.redirect_stderr(err):
            with contextlib.redirect_stdout(io.StringIO()):
                code = command.main(["--output", str(self.page), *map(str, runs)])
        return code, err.getvalue(), read(self.page / "run.json")

    def test_a_run_that_is_none_of_those_given_stays(self):
        held = made.write(self.page, run(3))
        (self.folder / "page-2").mkdir()
        for given in ([self.file["a.json"]], self.file.values()):
            code, said, kept = self.page_of(*given)
            self.assertEqual((code, kept), (2, run(3)))
            self.assertEqual([file.name for file in self.page.iterdir()], ["run.json"])
            self.assertIn(f"{held} holds a run that is none of those given", said)
            self.assertRegex(said, r"\A[^\n]*such as \S+/page-3\n\Z")
        held.write_text("7")  # whatever it was
        self.assertEqual(self.page_of(self.file["a.json"])[::2], (2, 7))

    def test_a_run_without_a_sample_has_no_page(self):
        """As catena_bench writes it when it is asked for means and medians alone."""
        empty = made.write(self.folder, run(0) | {"benchmarks": run(0)["benchmarks"][1:]}, "empty.json")
        err = io.StringIO()
        with contextlib.redirect_stderr(err):
            self.assertEqual(command.main(["--output", str(self.page), str(empty)]), 2)
        self.assertRegex(err.getvalue(), r"\A[^\n]*empty.json: holds no sample; give a file [^\n]*\n\Z")

    def test_a_run_that_is_given_twice_is_shown_once(self):
        """As where a page is made again of its own runs and the last of them."""
        a, b = self.file.values()
        together = made.write(self.folder, [run(0), run(1)], "together.json")
        code, said, kept = self.page_of(together, b, a)
        self.assertEqual((code, kept), (0, [run(0), run(1)]))
        self.assertEqual(said, "".join(
            f"catena report: {given} is a run that was given before, and is shown once\n" for given in (b, a)
        ))  # fmt: skip

    def test_the_list_that_a_page_of_several_has_beside_it_is_read_again(self):
        runs = [run(0), run(1)]
        self.assertEqual(self.page_of(*self.file.values()), (0, "", runs))
        held = self.page / "run.json"
        self.assertEqual(self.page_of(held), (0, "", runs))
        self.assertEqual(self.page_of(*self.file.values()), (0, "", runs))  # other copies of the same
        self.assertEqual(self.page_of(self.file["a.json"])[::2], (2, runs))
        third = made.write(self.folder, run(2), "c.json")
        self.assertEqual(self.page_of(held, third), (0, "", [*runs, run(2)]))
        with self.assertRaisesRegex(runfile.BadRunFile, "holds 3 runs, and one is wanted"):
            runfile.load(held)
        made.write(self.page, [run(0), run(1) | {"catena": []}])
        with self.assertRaisesRegex(runfile.BadRunFile, r"run.json: run 2: catena is not an object"):
            runfile.load_all(held)


if __name__ == "__main__":
    unittest.main()
