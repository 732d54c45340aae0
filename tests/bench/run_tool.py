"""Runs the command on a mesh file and returns its report."""

import json
import subprocess
import time


def run_tool(tool, source, output, *options):
    """The report of a run; the run must succeed. Warnings are in the report."""
    command = [tool, source, "-o", output, "-q", "--report", "-", *options]
    run = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if run.returncode != 0:
        raise SystemExit("%s: exit %d\n%s" % (" ".join(map(str, command)), run.returncode, run.stderr))
    return json.loads(run.stdout)


def quality(measures):
    """Least angle in degrees and the edges' standard deviation over their mean, before or after a run."""
    return measures["min_angle"]["min"], measures["edge_length"]["std"] / measures["edge_length"]["mean"]


def timed_run(tool, source, output, *options):
    """Wall seconds and report of a run."""
    start = time.perf_counter()
    report = run_tool(tool, source, output, *options)
    return time.perf_counter() - start, report
