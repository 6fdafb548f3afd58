# SPDX-License-Identifier: Apache-2.0
"""scripts/get-corpus: fetches what is missing or damaged, and keeps nothing that has another hash."""

import hashlib
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(sys.argv.pop(1)) / "scripts/get-corpus"
FILES = {"obj/cube.obj": b"v 0 0 0\n", "a b/unit.json": b"{}"}


class GetCorpus(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        root = Path(self.temporary.name)
        self.mirror, self.corpus, self.manifest = root / "mirror", root / "corpus", root / "corpus.tsv"
        rows = [f"from\tobj/\t{self.mirror.as_uri()}/obj/"]
        for path, data in FILES.items():
            (self.mirror / path).parent.mkdir(parents=True)
            (self.mirror / path).write_bytes(data)
            rows.append(f"{path}\t{len(data)}\t{hashlib.sha256(data).hexdigest()}")
        self.manifest.write_text("# comment\n" + "\n".join(rows) + "\n")

    def get(self, *options):
        done = subprocess.run(
            [sys.executable, SCRIPT, self.corpus, "--manifest", self.manifest, *options],
            capture_output=True,
            text=True,
        )
        return done.returncode, done.stdout + done.stderr

    def test_what_is_missing_or_damaged_is_fetched(self):
        self.assertEqual(self.get("--check")[0], 4)
        self.assertFalse(self.corpus.exists())
        self.assertEqual(self.get("--mirror", self.mirror)[0], 0)
        self.assertEqual((self.corpus / "a b/unit.json").read_bytes(), b"{}")
        (self.corpus / "obj/cube.obj").write_bytes(b"v 0 0 1\n")
        status, text = self.get("--check")
        self.assertEqual(status, 4)
        self.assertIn("obj/cube.obj: another SHA-256", text)
        status, text = self.get("--only", "obj/")  # from the file's own address
        self.assertEqual(status, 0)
        self.assertIn("1 fetched", text)
        self.assertEqual(self.get("--check")[0], 0)

    def test_other_bytes_are_not_kept(self):
        (self.mirror / "obj/cube.obj").write_bytes(b"v 0 0 1\n")
        status, text = self.get("--mirror", self.mirror)
        self.assertEqual(status, 4)
        self.assertIn("obj/cube.obj: not kept: another SHA-256", text)
        self.assertFalse((self.corpus / "obj/cube.obj").exists())
        self.assertTrue((self.corpus / "a b/unit.json").exists())

    def test_no_network_is_said(self):
        status, text = self.get("--mirror", "http://127.0.0.1:9")
        self.assertEqual(status, 4)
        self.assertIn("not fetched", text)


if __name__ == "__main__":
    unittest.main()
