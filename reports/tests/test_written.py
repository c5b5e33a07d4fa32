"""Files are written whole or not at all, and what cannot be written is said."""
import contextlib
import csv
import errno
import io
import os
import pathlib
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import made
import pages
from catena_report import __main__ as command
from catena_report import page, table, whole_file

ENVIRONMENT = {**os.environ, "PYTHONPATH": str(pathlib.Path(page.__file__).parents[1])}


def opened_once_read(fifo, reader):
    """To write into, once the process `reader` has opened it; an error where that ends before."""
    while reader.poll() is None:
        try:
            return os.open(fifo, os.O_WRONLY | os.O_NONBLOCK)
        except OSError as error:
            if error.errno != errno.ENXIO:  # else nobody reads yet
                raise
            time.sleep(0.01)
    raise AssertionError(f"ended with {reader.returncode}: {reader.stderr.read()}")


class Written(unittest.TestCase):
    def test_what_was_there_stays_until_all_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "link").symlink_to("a")
            whole_file.write(folder / "link", "old\r\n")
            with unittest.mock.patch("pathlib.Path.replace", side_effect=OSError(28, "No space left on device")):
                with self.assertRaises(OSError) as raised:
                    whole_file.write(folder / "a", b"new")
            self.assertEqual(raised.exception.filename, str(folder / "a"))
            self.assertEqual((folder / "a").read_bytes(), b"old\r\n")
            self.assertTrue((folder / "link").is_symlink())
            self.assertEqual({file.name for file in folder.iterdir()}, {"a", "link"})

    def test_a_table_keeps_every_digit_of_what_it_shows_in_few(self):
        text = table.Table("a", "", "", ["x", "y"], [["word, quoted", table.Cell("0.333", 1 / 3)]]).as_csv()
        self.assertEqual(list(csv.reader(io.StringIO(text, newline=""))), [["x", "y"], ["word, quoted", str(1 / 3)]])

    def test_what_says_more_than_its_number_stands_beside_it(self):
        cells = [table.Cell("1.58 [1.42, 1.85] times (LBVH)", 1.575), table.Cell("1,234 ms", 1234.5), table.Cell("none")]
        rows = [cells, [table.Cell("2.00", 2.0), table.Cell("< 0.1 %", 0.0005), table.Cell("auto, Grid")]]
        text = table.Table("a", "", "", ["next", "time", "as good"], rows).as_csv()
        self.assertEqual(list(csv.reader(io.StringIO(text, newline=""))), [
            ["next", "next: number", "time", "as good"],
            ["1.58 [1.42, 1.85] times (LBVH)", "1.575", "1234.5", "none"],
            ["2.00", "2.0", "0.0005", "auto, Grid"],
        ])  # fmt: skip

    def test_a_name_parts_no_cell_of_markdown_and_begins_no_html(self):
        text = table.Table("a", "", "", ["x|y", "n"], [["p|q <b> a_b *c* `d` \\ &", "1"]]).markdown()
        self.assertEqual(text.splitlines()[0], r"| x\|y | n |")
        self.assertEqual(text.splitlines()[2], r"| p\|q &lt;b&gt; a\_b \*c\* \`d\` \\ &amp; | 1 |")

    def test_what_a_folder_holds_of_earlier_reports_stays_listed(self):
        with tempfile.TemporaryDirectory() as folder:
            listed = pathlib.Path(folder) / ".catena-report"
            listed.write_text("report\nfigures/old.svg\n")
            page._list_files([], pathlib.Path(folder))
            self.assertEqual(listed.read_text().split()[:3], ["report", "figures/old.svg", "report"])

    def test_what_is_no_regular_file_is_written_through(self):
        with tempfile.TemporaryDirectory() as folder:
            # A device of its own: a fault may put a file in its place.
            device, full = pathlib.Path(folder) / "device", pathlib.Path(folder) / "full"
            try:
                os.mknod(device, stat.S_IFCHR | 0o600, os.makedev(1, 7))
                open(device, "wb").close()
            except OSError:
                if os.access("/dev", os.W_OK):
                    self.skipTest("no device can be made here, and /dev can be written")
                device = pathlib.Path("/dev/full")
            full.symlink_to(device)
            with self.assertRaises(OSError):
                whole_file.write(full, "text")
            self.assertTrue(full.is_symlink())

    def test_a_reader_that_left_is_no_news(self):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run(
            [sys.executable, "-m", "catena_report", "--compare", made.H200, made.H200],
            env=ENVIRONMENT,
            stdout=write, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (2, ""))

    def test_a_page_too_large_for_a_browser_is_said(self):
        with tempfile.TemporaryDirectory() as folder, pages.without_figures():
            run = str(made.write(folder, made.run(repetitions=1)))

            def told(limit):
                err = io.StringIO()
                with unittest.mock.patch("catena_report.page.LIMIT", limit), contextlib.redirect_stderr(err):
                    with contextlib.redirect_stdout(io.StringIO()):
                        self.assertEqual(command.main(["--output", folder + "/page", run]), 0)
                return err.getvalue()

            render = page._render

            def nothing_written_yet(*given):
                self.assertFalse(os.path.exists(folder + "/page"))
                return render(*given)

            with unittest.mock.patch("catena_report.page._render", nothing_written_yet):
                self.assertEqual(told(page.LIMIT), "")
            size = (pathlib.Path(folder) / "page" / "index.html").stat().st_size
            self.assertEqual(told(size), "")
            self.assertIn("larger than", told(size - 1))

    def test_a_folder_whose_name_the_locale_cannot_write_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            run = str(made.write(folder, made.run(repetitions=1)))
            done = subprocess.run(
                [sys.executable, "-c", "import pages, runpy\nwith pages.without_figures(): "
                 "runpy.run_module('catena_report', run_name='__main__', alter_sys=True)", "--output", folder + "/\u03b2", run],
                env={**ENVIRONMENT, "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii:strict",
                     "PYTHONPATH": os.pathsep.join([ENVIRONMENT["PYTHONPATH"], os.path.dirname(__file__)])},
                capture_output=True, text=True,
            )  # fmt: skip
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("/\\u03b2/index.html", done.stdout)

    def test_the_users_settings_of_matplotlib_change_no_figure(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "matplotlibrc").write_text("text.usetex: True\n")
            done = subprocess.run(
                [sys.executable, "-c", "from catena_report.drawn import static; import matplotlib; "
                 "print(matplotlib.rcParams['text.usetex'], matplotlib.get_backend())"],
                env={**ENVIRONMENT, "MPLCONFIGDIR": folder, "MPLBACKEND": "nowhere"},
                capture_output=True, text=True,
            )  # fmt: skip
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "False agg\n", ""))

    def test_figures_are_drawn_where_processes_can_share_nothing(self):
        figure = unittest.mock.Mock(key="a")
        with (
            unittest.mock.patch("concurrent.futures.ProcessPoolExecutor", side_effect=OSError),
            unittest.mock.patch("catena_report.page._draw", return_value="drawn"),
        ):
            self.assertEqual(page._draw_all([figure]), {"a": "drawn"})

    def test_who_is_interrupted_ends_so(self):
        for sent, ends, said in (
            (signal.SIGTERM, 128 + signal.SIGTERM, ""),
            (signal.SIGINT, -signal.SIGINT, "catena report: interrupted; no page was written\n"),
        ):
            with tempfile.TemporaryDirectory() as folder:
                run = os.path.join(folder, "run.json")
                os.mkfifo(run)
                with subprocess.Popen(
                    [sys.executable, "-m", "catena_report", "--output", folder + "/page", run],
                    env=ENVIRONMENT,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    text=True,
                    preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # else ignored under nohup
                ) as writer:
                    with open(opened_once_read(run, writer), "w"):  # it reads until this is closed
                        writer.send_signal(sent)
                        out, err = writer.communicate(timeout=60)
                self.assertEqual((writer.returncode, out, err), (ends, "", said))

    def test_who_is_interrupted_while_packages_are_loaded_shows_no_traceback(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "numpy.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n")
            done = subprocess.run(
                [sys.executable, "-m", "catena_report", "--output", folder + "/page", "run.json"],
                env={**ENVIRONMENT, "PYTHONPATH": os.pathsep.join([folder, ENVIRONMENT["PYTHONPATH"]])},
                capture_output=True, text=True,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            )  # fmt: skip
        self.assertEqual((done.returncode, done.stdout, done.stderr), (-signal.SIGINT, "", ""))

    def test_a_full_disk_under_the_output_is_said(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run(
                [sys.executable, "-m", "catena_report", "--compare", made.H200, made.H200],
                env=ENVIRONMENT,
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
            )
        said = "catena report: cannot write the output: No space left on device\n"
        self.assertEqual((done.returncode, done.stderr), (2, said))


if __name__ == "__main__":
    unittest.main()
