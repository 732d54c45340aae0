"""output_digests.py TOOL [--quick] [FILE_OR_FOLDER ...]   the SHA-256 of every mesh that the command writes.

For a change that must not change results: run it for the build before and the build after, and compare what it
prints. A line has digest, exit code, connectivity, effort or other options, and input. The inputs are the artificial
meshes, the samples in data/ and all mesh files among those given, folders included. With --quick only the default
effort and no large meshes.
"""

import argparse
import concurrent.futures
import hashlib
import itertools
import pathlib
import subprocess
import sys
import tempfile

SAMPLES = pathlib.Path(__file__).parents[2] / "data"
SUFFIXES = {".obj", ".ply", ".off"}
FAMILIES = ["G1", "M1", "M2", "M3", "S1", "S2", "torus:10000"]
LARGE = 500_000  # bytes: left out by --quick
OTHERS = [["--integrator", "damped"], ["--paper"], ["--filter", "global"], ["--filter", "closest"],
          ["--feature-angle", "off"], ["--boundary", "fixed"], ["--sizing", "curvature"], ["--polish", "off"],
          ["--connectivity", "adapt", "-L", ".5x"], ["--connectivity", "adapt", "-L", "2x"]]


def files_in(paths):
    for path in map(pathlib.Path, paths):
        found = sorted(path.rglob("*")) if path.is_dir() else [path]
        yield from (f for f in found if f.suffix.lower() in SUFFIXES and f.is_file())


def digest(tool, source, options, folder, number):
    output = folder / ("%d%s" % (number, source.suffix.lower()))
    run = subprocess.run([tool, str(source), "-o", str(output), "-q", "-j", "1", *options], capture_output=True,
                         timeout=3600, check=False)
    data = output.read_bytes() if output.exists() else b""
    output.unlink(missing_ok=True)
    return "%s %3d  %-44s %s" % (hashlib.sha256(data).hexdigest(), run.returncode, " ".join(options), source.name)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("tool")
    parser.add_argument("inputs", nargs="*")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    args = parser.parse_intermixed_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for family in FAMILIES:
            subprocess.run([sys.executable, SAMPLES.parent / "tests/bench/artificial_meshes.py", family, "1",
                            folder / ("%s.off" % family.replace(":", ""))], check=True)
        sources = [*files_in([folder]), *files_in([SAMPLES, *args.inputs])]
        if args.quick:
            sources = [s for s in sources if s.stat().st_size < LARGE]
        efforts = ["default"] if args.quick else ["fast", "default", "thorough"]
        runs = [["--connectivity", mode, "--effort", effort]
                for mode, effort in itertools.product(["fixed", "flip", "adapt"], efforts)]
        work = [(s, r) for s in sources for r in runs] + [(s, r) for s in sources[:len(FAMILIES)] for r in OTHERS]
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            lines = pool.map(lambda item: digest(args.tool, *item[1], folder, item[0]), enumerate(work))
            for line in lines:
                print(line, flush=True)


if __name__ == "__main__":
    main()
