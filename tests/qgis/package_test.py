#!/usr/bin/python3
"""The plugin as a plugin repository wants it: its metadata, and the script that makes the archive. Needs no QGIS.

usage: package_test.py SOURCES PLUGIN.zip
"""
import configparser
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

SOURCES, ZIP = (os.path.abspath(path) for path in sys.argv[1:3])
SCRIPT = os.path.join(SOURCES, "scripts", "package-qgis-plugin")
# Names that are reserved for examples.
WHO = {"email": "someone@example.org", "repository": "https://example.org/coastmesh", "tracker": "https://example.org/coastmesh/issues"}


def metadata_of(path):
    with zipfile.ZipFile(path) as archive:
        text = archive.read("coastmesh_qgis/metadata.txt").decode()
    said = configparser.ConfigParser()  # with interpolation, as in some readers
    said.read_string(text)
    return dict(said["general"].items())


class PackageTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.out = os.path.join(self.folder, "plugin.zip")

    def package(self, *more, archive=ZIP, **who):
        words = [word for name, value in who.items() for word in (f"--{name}", value)]
        return subprocess.run([sys.executable, SCRIPT, *words, *more, "-o", self.out, archive], capture_output=True,
                              text=True, check=False)

    def refused(self, run, *reasons):
        self.assertEqual(run.returncode, 1, run.stdout)
        for reason in reasons:
            self.assertIn(reason, run.stderr)
        self.assertFalse(os.path.exists(self.out))

    def test_metadata_of_the_build_is_complete_but_for_who_publishes_it(self):
        said = metadata_of(ZIP)
        for name in ("name", "qgisminimumversion", "description", "about", "version", "author", "license", "tags", "category",
                     "icon", "changelog", "experimental", "deprecated", "server"):
            self.assertTrue(said[name], name)
        for name in ("email", "repository", "tracker", "homepage"):
            self.assertEqual(said[name], "", "an address that nobody gave")
        self.assertEqual(said["hasprocessingprovider"], "yes")
        with open(os.path.join(SOURCES, "CITATION.cff"), encoding="utf-8") as file:
            cited = file.read()
        self.assertIn(f"\nversion: {said['version']}\n", cited)
        self.assertIn(f"\nlicense: {said['license']}\n", cited)
        with zipfile.ZipFile(ZIP) as archive:
            self.assertIn("coastmesh_qgis/" + said["icon"], archive.namelist())
            self.assertIn(b"GNU GENERAL PUBLIC LICENSE", archive.read("coastmesh_qgis/LICENSE"))

    def test_changes_are_those_of_this_version(self):
        said = metadata_of(ZIP)
        with open(os.path.join(SOURCES, "CHANGELOG.md"), encoding="utf-8") as file:
            section = re.search(rf"^## {re.escape(said['version'])}[^\n]*\n(.*?)(?=^## |\Z)", file.read(), re.M | re.S).group(1)
        words = re.sub(r"`|^#+", "", section, flags=re.M).replace("%", " per cent").split()
        self.assertEqual(said["changelog"].split(), [said["version"], *words])
        self.assertGreater(len(words), 40)
        self.assertNotIn("\n\n", said["changelog"])

    def test_without_who_publishes_it_nothing_is_made(self):
        self.refused(self.package(), "give --email", "give --repository", "give --tracker")
        for left_out in WHO:
            self.refused(self.package(**{name: value for name, value in WHO.items() if name != left_out}), f"give --{left_out}")

    def test_what_is_no_address_is_refused(self):
        self.refused(self.package(**{**WHO, "repository": "somewhere"}), "repository: 'somewhere'")
        self.refused(self.package(**{**WHO, "tracker": "https://localhost/issues"}), "tracker: ")
        self.refused(self.package(**{**WHO, "email": "someone at example.org"}), "email: ")
        self.refused(self.package(homepage="ftp://example.org", **WHO), "homepage: ")

    def test_what_is_given_stands_in_the_archive_and_nothing_else_changes(self):
        run = self.package("--experimental", homepage="https://example.org/coastmesh/", author="Some One", **WHO)
        self.assertEqual(run.returncode, 0, run.stderr)
        before, after = metadata_of(ZIP), metadata_of(self.out)
        given = {**WHO, "homepage": "https://example.org/coastmesh/", "author": "Some One", "experimental": "True"}
        self.assertEqual(after, {**before, **given})
        with zipfile.ZipFile(ZIP) as old, zipfile.ZipFile(self.out) as new:
            names = {name for name in old.namelist() if not name.endswith("/")}
            self.assertEqual(set(new.namelist()), names)
            for name in names - {"coastmesh_qgis/metadata.txt"}:
                self.assertEqual(new.read(name), old.read(name), name)
        # The same command makes the same archive; an existing one is kept.
        with open(self.out, "rb") as file:
            first = file.read()
        self.assertEqual(self.package(**WHO).returncode, 1)
        os.remove(self.out)
        self.package("--experimental", homepage="https://example.org/coastmesh/", author="Some One", **WHO)
        with open(self.out, "rb") as file:
            self.assertEqual(file.read(), first)

    def test_a_plugin_that_lacks_something_is_refused(self):
        for lost in ("icon.png", "LICENSE"):
            short = os.path.join(self.folder, "short.zip")
            with zipfile.ZipFile(ZIP) as old, zipfile.ZipFile(short, "w") as new:
                for name in old.namelist():
                    if not name.endswith(lost):
                        new.writestr(name, old.read(name))
            self.refused(self.package(archive=short, **WHO), "icon" if lost == "icon.png" else lost)
        self.refused(self.package(archive=os.path.join(self.folder, "none.zip"), **WHO), "scripts/build release qgis_plugin")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
