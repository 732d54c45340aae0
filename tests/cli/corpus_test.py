"""corpus_test.py FOLDER LEAST [OPTION...]   a corpus of good and bad mesh files, judged by its own `run_corpus.py`.

Exits with 77 (skipped) where the corpus is not there; fails when fewer than LEAST cases pass.
Options go to the corpus's script, such as --asan for a binary built with sanitizers.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77


def main():
    corpus, least = Path(sys.argv[1]), int(sys.argv[2])
    script = corpus / "run_corpus.py"
    if not script.is_file():
        print("no corpus at %s: skipped" % corpus)
        return SKIPPED
    command = os.path.abspath(os.environ["HOOKE_REMESH"]) + " {in} -o {out}"
    with tempfile.TemporaryDirectory() as folder:  # the corpus itself may be read-only
        run = subprocess.run([sys.executable, script, "--corpus", corpus, "--formats", "obj,ply,off,stl",
                              *sys.argv[3:], command], cwd=folder, stdout=subprocess.PIPE,
                             text=True)
    print(run.stdout)
    total = re.search(r"^total +\d+ +(\d+)", run.stdout, re.MULTILINE)
    if not total:
        print("the corpus gave no total")
        return 1
    passed = int(total.group(1))
    print("%d passed, at least %d expected" % (passed, least))
    return 0 if passed >= least else 1


if __name__ == "__main__":
    sys.exit(main())
