#!/usr/bin/python3
"""The Debian source package of the commit that is checked out: the same bytes twice, with nothing that lintian calls an error,
and by somebody who says who they are. scripts/make-deb makes the binary packages too; that takes a whole build.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(__file__).resolve().parent.parent.parent
for program in ("git", "dpkg-buildpackage", "dh", "lintian"):
    if not shutil.which(program):
        print(f"skipped: there is no {program}")
        sys.exit(77)
if subprocess.run(["git", "-c", "safe.directory=*", "rev-parse", "HEAD"], cwd=SOURCES, capture_output=True, check=False).returncode:
    print("skipped: this is no clone")
    sys.exit(77)


class SourcePackageTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder, True)

    def make(self, name, environment):
        kept = {key: value for key, value in os.environ.items() if not key.startswith("DEB") and key != "SOURCE_DATE_EPOCH"}
        return subprocess.run([SOURCES / "scripts/make-deb", self.folder / name, "-S", "-d", "-nc"], env={**kept, **environment},
                              capture_output=True, text=True, check=False)

    def test_nobody_is_invented(self):
        for environment in ({}, {"DEBFULLNAME": "Test"}, {"DEBEMAIL": "test@localhost.localdomain"}):
            done = self.make("none", environment)
            self.assertEqual(done.returncode, 2)
            self.assertIn("DEBEMAIL", done.stderr)
            self.assertFalse((self.folder / "none").exists())

    def test_the_same_twice_and_without_errors(self):
        # A non-existent address, because the package is not distributed.
        who = {"DEBFULLNAME": "Test", "DEBEMAIL": "test@localhost.localdomain"}
        for name in ("one", "two"):
            done = self.make(name, who)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        made = sorted(path.name for path in (self.folder / "one").iterdir() if path.suffix in (".xz", ".dsc"))
        self.assertEqual(len(made), 3)
        for name in made:
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes(), name)
        (description,) = (self.folder / "one").glob("*.dsc")
        # This test made up the address.
        said = subprocess.run(["lintian", "--allow-root", "--fail-on", "error", "--suppress-tags",
                               "bogus-mail-host,bogus-mail-host-in-debian-changelog", description],
                              capture_output=True, text=True, check=False)
        self.assertEqual(said.returncode, 0, said.stdout + said.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
