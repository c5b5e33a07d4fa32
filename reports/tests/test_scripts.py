"""The scripts of CI and of a machine with a GPU, run with stand-ins for what they call."""
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import made

ROOT = made.REPORTS.parent


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bin = self.folder / "bin"
        self.bin.mkdir()

    def stand_in(self, path, does=""):
        """A program that notes how it was called, then does this."""
        path = self.folder / path
        path.parent.mkdir(parents=True, exist_ok=True)
        # By one write, as some run at the same time.
        path.write_text(f'#!/bin/bash\necho "$(printf "%s" "{path.name}"; printf " %s" "$@")" >> "{self.folder}/calls"\n{does}\n')
        path.chmod(0o755)

    def run_script(self, script, *arguments):
        calls = self.folder / "calls"
        calls.write_text("")
        done = subprocess.run(
            ["bash", script, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder,
            env={"PATH": f"{self.bin}:/usr/bin:/bin", "HOME": str(self.folder)},
        )  # fmt: skip
        return done, calls.read_text().splitlines()


class Ci(Scripts):
    """README's own commands, in a folder that has nothing but README.md."""

    def setUp(self):
        super().setUp()
        (self.folder / ".ci").mkdir()
        for name in (".ci/run", "README.md"):
            (self.folder / name).write_text((ROOT / name).read_text())
        for name in ("apt-get", "cmake", "sudo"):
            self.stand_in(f"bin/{name}", 'exec "$@"' if name == "sudo" else "")
        for name in ("release/catena", "tsan/catena_library_threads_tests", "asan/catena", "asan/catena_search_tests"):
            self.stand_in(f"build/{name}")
        self.stand_in("bin/mpirun", "exit ${CATENA_RANK_FAULT:+2}")

    def test_it_runs_what_a_reader_is_told_to_then_the_sanitizers(self):
        done, calls = self.run_script(self.folder / ".ci/run")
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = [call for call in calls if not call.startswith(("apt-get", "sudo"))]
        calls, both, halves = calls[:-4], calls[-4:-2], calls[-2:]  # these two and two at the same time
        self.assertEqual(calls, [
            "cmake --preset release", "cmake --build --preset release --target catena_cli", "catena report",
            "cmake --workflow --preset release",
            "cmake --preset tsan -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
            "cmake --build --preset tsan --target catena_library_threads_tests", "catena_library_threads_tests ",
            "cmake --preset asan -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -DCATENA_BENCH=OFF -DCATENA_MUTANTS=OFF -DCATENA_TESTS=OFF",
            "cmake --build --preset asan --target catena_cli catena_search_tests",
            "mpirun --quiet --oversubscribe -n 3 build/asan/catena verify yarn:n=3000 hair:n=3000",
            "mpirun --quiet --oversubscribe -n 3 build/asan/catena detect yarn:n=3000",
        ])  # fmt: skip
        self.assertCountEqual(both, ["catena verify", "catena fuzz --seconds 60 --failures build/asan/failures"])
        self.assertEqual(halves, ["catena_search_tests --gtest_brief=1"] * 2)

    def test_whatever_fails_ends_it(self):
        for name in ("bin/cmake", "bin/apt-get", "build/release/catena", "build/tsan/catena_library_threads_tests"):
            self.stand_in(name, "exit 3")
            done, calls = self.run_script(self.folder / ".ci/run")
            self.assertNotEqual(done.returncode, 0, name)
            self.assertTrue(calls[-1].startswith(name.rpartition("/")[2]), calls)
            self.stand_in(name)
        for does in ("exit 1", "exit 0"):  # no answer; no end by an error of its own
            self.stand_in("bin/mpirun", does)
            self.assertEqual(self.run_script(self.folder / ".ci/run")[0].returncode, 1, does)

    def test_either_half_of_the_tests_of_searches_ends_it(self):
        for half in range(2):
            does = f'echo "$GTEST_SHARD_INDEX of $GTEST_TOTAL_SHARDS"; exit $((GTEST_SHARD_INDEX == {half}))'
            self.stand_in("build/asan/catena_search_tests", does)
            done, _ = self.run_script(self.folder / ".ci/run")
            self.assertEqual(done.returncode, 1, half)
            self.assertIn(f"{half} of 2", done.stdout)

    def test_what_verify_found_is_shown(self):
        self.stand_in("build/asan/catena", "[ $1 = fuzz ] || { echo WRONG here; exit 1; }")
        done, _ = self.run_script(self.folder / ".ci/run")
        self.assertEqual(done.returncode, 1)
        self.assertIn("WRONG here", done.stdout)


class OnGpu(Scripts):
    script = ROOT / "cuda" / "run_on_gpu.sh"

    def setUp(self):
        super().setUp()
        for name in ("cmake", "nvidia-smi"):
            self.stand_in(f"bin/{name}", f"echo {name}")
        (self.folder / "b" / "generated").mkdir(parents=True)
        (self.folder / "b" / "generated" / "commit.h").write_text('#define CATENA_COMMIT "0123456789ab"\n')
        self.stand_in("bin/ctest", "echo 'Test project /somewhere'; echo passed")
        self.stand_in("b/catena_bench", 'for a in "$@"; do case $a in --benchmark_out=*) echo {} > "${a#*=}";; esac; done; echo table')

    def test_it_builds_where_nothing_is_built_tests_and_measures(self):
        done, calls = self.run_script(self.script, self.folder / "b", self.folder / "r")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([call.split()[0] for call in calls], ["cmake", "cmake", "nvidia-smi", "ctest", "catena_bench"])
        self.assertIn("-DCATENA_CUDA=ON", calls[0])
        self.assertIn("-L gpu", calls[3])
        self.assertEqual((self.folder / "r" / "gpu_tests.txt").read_text(), "nvidia-smi\ncommit 0123456789ab\npassed\n")
        self.assertEqual((self.folder / "r" / "gpu_tables.json").read_text(), "{}\n")
        self.stand_in("b/catena_tests")
        _, calls = self.run_script(self.script, self.folder / "b")
        self.assertEqual(calls[0].split()[0], "nvidia-smi")
        self.assertTrue((self.folder / "b" / "results" / "gpu_tables.json").exists())

    def test_a_test_that_fails_is_kept_and_ends_it(self):
        self.stand_in("bin/ctest", "echo failed; exit 8")
        done, calls = self.run_script(self.script, self.folder / "b", self.folder / "r")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(calls[-1].split()[0], "ctest")
        self.assertIn("failed", (self.folder / "r" / "gpu_tests.txt").read_text())

    def test_what_is_measured_is_the_papers_tables_and_what_a_user_would_take(self):
        _, calls = self.run_script(self.script, self.folder / "b", self.folder / "r")
        wanted = re.compile(re.search(r"--benchmark_filter=(\S+)", calls[-1])[1])
        for name, measured in (
            ("path1/n:1000/GPU1/find/", True), ("path2/n:10000000/aGPU2+GPUv2/whole/", True),
            ("path1/n:1000/DeviceHybrid/resident/", True), ("path1/n:1000/bGPU2+GPU2/build/", True),
            ("path1/n:10000/bGPU2+GPU2/build/", False), ("path1/n:1000/aCPU2+CPU2/find/", True),
            ("path1/n:10000000/aCPU2+CPU2/find/", False), ("path1/n:150000/GPU1/literal/find/", True),
            ("path1/n:1000/GPU1/literal/find/", False), ("yarn/n:1000/GPU1/find/", False), ("yarn/n:150000/auto/whole/", True),
            ("path2/n:10000000/DeviceHybrid/whole/", True), ("yarn/n:3000000/DeviceGrid/resident/", True),
            ("path1/n:150000/EmbreeRebuild/whole/", True), ("path1/n:1000000/Embree/whole/", False),
        ):  # fmt: skip
            self.assertEqual(bool(wanted.search(name)), measured, name)


class Sanitize(Scripts):
    script = ROOT / "cuda" / "sanitize.sh"

    def setUp(self):
        super().setUp()
        self.stand_in("bin/compute-sanitizer")
        self.stand_in("catena", "echo '  aGPU2+GPU2   the best'")

    def test_every_device_strategy_is_under_the_tool(self):
        for tool in ("memcheck", "racecheck"):
            done, calls = self.run_script(self.script, tool, self.folder / "catena")
            self.assertEqual(done.returncode, 0, done.stderr)
            listed, pairs, evidence, rounds = calls
            self.assertEqual(listed, "catena list")
            for call in (pairs, evidence, rounds):
                self.assertTrue(call.startswith(f"compute-sanitizer --tool {tool} --error-exitcode 9 "), call)
                self.assertEqual("--leak-check full" in call, tool == "memcheck")
            self.assertIn("--certify", evidence)
            for file in (ROOT / "cuda").glob("*.cu"):
                if re.search(r"^const Register(Construction|Traversal|Variant)\b", file.read_text(), re.M):
                    self.assertRegex(pairs, rf"--variant (\S*\+)?{file.stem}\b")

    def test_a_fault_ends_it(self):
        self.stand_in("bin/compute-sanitizer", "exit 9")
        done, calls = self.run_script(self.script, "memcheck", self.folder / "catena")
        self.assertEqual((done.returncode, len(calls)), (9, 2))

    def test_it_is_skipped_with_the_reason(self):
        self.stand_in("catena", "echo '  aGPU2+GPU2   not available: no device'")
        done, _ = self.run_script(self.script, "memcheck", self.folder / "catena")
        self.assertEqual((done.returncode, done.stdout), (77, "skipped: no device\n"))
        (self.bin / "compute-sanitizer").unlink()
        done, _ = self.run_script(self.script, "memcheck", self.folder / "catena")
        self.assertEqual((done.returncode, done.stdout), (77, "skipped: compute-sanitizer is not on the PATH\n"))


class Roofline(Scripts):
    def setUp(self):
        super().setUp()
        spec = importlib.util.spec_from_file_location("roofline", ROOT / "cuda" / "roofline.py")
        self.roofline = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.roofline)
        metrics = [name for name, _ in self.roofline.METRICS.values()]
        row = lambda kernel, *numbers: ",".join(f'"{cell}"' for cell in ("0", kernel, *numbers))  # noqa: E731
        numbers = [f"{1000 + k:,}" for k in range(len(metrics))]
        lines = ["==PROF== Connected", row("Kernel Name", *metrics).replace('"0"', '"ID"'), row("", *metrics), row("find", *["7"] * 10),
                 row("probe", *numbers), row("build", *["", *numbers[1:]]), row("find", *numbers), '"cut short"']
        (self.folder / "log").write_text("\n".join(lines) + "\n")
        self.stand_in("bin/ncu", f'cat "{self.folder}/log"')
        self.stand_in("bin/nvidia-smi", "echo 'a GPU, 1.2'")
        self.stand_in("catena", "echo catena 0.1")

    def path(self):
        return unittest.mock.patch.dict(os.environ, {"PATH": f"{self.bin}:{os.environ['PATH']}"})

    def test_of_a_kernel_the_last_launch_in_the_units_that_its_key_says(self):
        keys = list(self.roofline.METRICS)
        last = {key: 1000 + k for k, key in enumerate(keys)} | {"us": 1.0}
        with self.path(), unittest.mock.patch.object(self.roofline, "copy_bytes_per_second", return_value=4.6e12):
            out = self.folder / "out.json"
            self.roofline.main(str(self.folder / "catena"), str(out), "DeviceHybrid", "path1:n=9", "DeviceLBVH", "yarn")
        found = json.loads(out.read_text())
        self.assertEqual([(run["variant"], run["input"]) for run in found["runs"]], [("DeviceHybrid", "path1:n=9"), ("DeviceLBVH", "yarn")])
        for run in found["runs"]:
            self.assertEqual(run["kernels"], {"find": last, "build": last | {"us": 0.0}})
        self.assertEqual([found[key] for key in ("gpu", "driver", "catena")], ["a GPU", "1.2", "catena 0.1"])
        self.assertEqual(found["ceilings"]["copy_bytes_per_second"], 4_600_000_000_000)

    def test_a_variant_without_its_input_is_refused(self):
        for arguments in ([], ["catena"], ["catena", "out.json", "GPU1"], ["catena", "out.json", "GPU1", "yarn", "GPU1"]):
            done = subprocess.run([sys.executable, ROOT / "cuda" / "roofline.py", *arguments], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertTrue(done.stderr.startswith("roofline.py CATENA OUT.json [VARIANT INPUT ...]"), done.stderr)


if __name__ == "__main__":
    unittest.main()
