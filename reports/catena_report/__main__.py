"""python3 -m catena_report --output DIR RUN.json [...] | --compare OLD.json NEW.json"""
import argparse
import os
import signal
import sys

HEEDS_INTERRUPTS = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # not so under nohup
if __name__ == "__main__" and HEEDS_INTERRUPTS:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while packages are loaded: nothing is half written yet

from . import checks, compare, runfile

DESCRIBING = {"schema", "profile", "variants"}  # keys of `catena` that say nothing of what was measured


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message):
        self.exit(2, f"catena report: {message}; see --help\n")


def main(arguments=None):
    parser = Parser("catena_report", description="One page from run files, or two runs compared.")
    parser.add_argument(
        "runs", nargs="*", metavar="RUN.json", help="run files; those of several machines make one page"
    )
    parser.add_argument("--output", metavar="DIR", help="where index.html, figures/, tables/ and run.json go")
    parser.add_argument(
        "--compare",
        nargs=2,
        metavar=("OLD.json", "NEW.json"),
        help="exit code 1 when NEW is slower somewhere",
    )
    parser.add_argument(
        "--least-ratio",
        type=float,
        default=compare.LEAST_RATIO,
        metavar="R",
        help="the smallest ratio of medians that matters (default %(default)s)",
    )
    chosen = parser.parse_args(arguments)
    try:
        if chosen.compare:
            if chosen.runs or chosen.output:
                parser.error("--compare takes two run files and no --output")
            if not chosen.least_ratio > 1:
                parser.error(f"--least-ratio {chosen.least_ratio:g}: give a ratio above 1, such as 1.05")
            return _compared(*chosen.compare, chosen.least_ratio)
        if not chosen.runs or not chosen.output:
            parser.error("give --output DIR and at least one run file, or --compare OLD.json NEW.json")
        return _page(chosen.runs, chosen.output)
    except runfile.BadRunFile as error:
        print(f"catena report: {error}", file=sys.stderr)
        return 2


def _compared(old, new, least_ratio):
    try:
        return compare.main(old, new, least_ratio)
    except checks.UNEXPECTED as error:
        raise checks.unusable(f"{old} and {new}", "they cannot be compared", error) from error


def _each_once(given):
    """The page of several runs holds them all, so that it and one of them may be given together."""
    runs = []
    for run in given:
        if any(run.raw == other.raw for other in runs):
            print(f"catena report: {run.where} is a run that was given before, and is shown once", file=sys.stderr)
        else:
            runs.append(run)
    return runs


def _page(paths, output):
    runs = _each_once(run for path in paths for run in runfile.load_all(path))
    for run in runs:
        checks.drawable(run.where, run.inputs())
        if not (run.samples or run.refused or run.catena.keys() - DESCRIBING):
            raise runfile.BadRunFile(
                f"{run.where}: holds no sample; give a file of catena_bench without --benchmark_report_aggregates_only"
            )
    from . import page, report  # only now: reading two runs needs no plots

    try:
        path = page.write(report.Report(runs), output)
    except checks.UNEXPECTED as error:
        raise checks.unusable(", ".join(paths), "the page cannot be made", error) from error
    except OSError as error:
        own = str(error.filename).startswith(page.HERE.as_posix())
        advice = "install catena again" if own else "give --output a folder that can be written"
        raise runfile.BadRunFile(f"{error.filename}: {error.strerror}; {advice}") from None
    size = path.stat().st_size
    print(f"{path} ({size / 1e6:.1f} MB)")
    if size > page.LIMIT:
        print(
            f"catena report: the page is larger than {page.LIMIT / 1e6:.0f} MB; give it fewer runs",
            file=sys.stderr,
        )
    return 0


def written(work):
    """The exit code that `work` gives, once all that it printed is written; 2 when it cannot be."""
    try:
        code = work()
        sys.stdout.flush()
        return code
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or the interpreter fails again at its end
        if not isinstance(error, BrokenPipeError):
            print(f"catena report: cannot write the output: {error.strerror}", file=sys.stderr)
        return 2


def _ended(signal_number, _):
    """A polite kill cleans up, as Ctrl-C does."""
    sys.exit(128 + signal_number)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, _ended)
    if HEEDS_INTERRUPTS:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")  # a folder has what name it has, also in a locale without it
    try:
        sys.exit(written(main))
    except KeyboardInterrupt:  # what was half written is gone; now end as one who was interrupted
        print("catena report: interrupted; no page was written", file=sys.stderr)
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
