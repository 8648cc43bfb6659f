#!/usr/bin/python3
"""What has to agree in a release: its version wherever it stands, how to cite it, and that no contact is invented.

usage: release_test.py PROGRAM
"""
import pathlib
import re
import subprocess
import sys
import unittest

import yaml

PROGRAM = sys.argv[1]
SOURCES = pathlib.Path(__file__).resolve().parent.parent.parent
# Keys that the Citation File Format 1.2.0 requires and allows at the top level, and in references.
CFF_NEEDED = {"cff-version", "message", "title", "authors"}
CFF_KNOWN = CFF_NEEDED | {"abstract", "commit", "contact", "date-released", "doi", "identifiers", "keywords", "license",
                          "license-url", "preferred-citation", "references", "repository", "repository-artifact",
                          "repository-code", "type", "url", "version"}
PERSON = {"family-names", "given-names", "name-particle", "name-suffix", "alias", "affiliation", "orcid", "email", "website"}
ENTITY = {"name", "alias", "website", "email", "orcid", "date-start", "date-end", "location"}
PAPER_KNOWN = {"type", "title", "authors", "year", "month", "journal", "volume", "issue", "start", "end", "doi", "url",
               "collection-title", "conference", "publisher", "pages"}


def read(path):
    return (SOURCES / path).read_text(encoding="utf-8")


def version():
    return re.search(r"project\(coastmesh VERSION ([0-9.]+)", read("CMakeLists.txt"))[1]


class ReleaseTest(unittest.TestCase):
    def test_one_version_everywhere(self):
        said = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.strip(), f"coastmesh {version()}")
        self.assertEqual(re.search(r"^## ([0-9.]+)", read("CHANGELOG.md"), re.M)[1], version())
        self.assertEqual(yaml.safe_load(read("CITATION.cff"))["version"], version())
        minor = ".".join(version().split(".")[:2])
        self.assertEqual(set(re.findall(r"find_package\(coastmesh ([0-9.]+)", read("docs/stable.md"))), {minor})
        self.assertEqual(set(re.findall(r"find_package\(coastmesh ([0-9.]+)", read("tests/package/CMakeLists.txt"))), {minor})

    def test_versions_come_newest_first(self):
        versions = [tuple(map(int, v.split("."))) for v in re.findall(r"^## ([0-9.]+)", read("CHANGELOG.md"), re.M)]
        self.assertTrue(versions)
        self.assertEqual(versions, sorted(set(versions), reverse=True))

    def test_the_citation_is_one(self):
        citation = yaml.safe_load(read("CITATION.cff"))
        self.assertEqual(citation["cff-version"], "1.2.0")
        self.assertLessEqual(CFF_NEEDED, set(citation))
        self.assertLessEqual(set(citation), CFF_KNOWN)
        self.assertIn(citation["type"], ("software", "dataset"))
        self.assertIsInstance(citation["version"], str)
        for paper in citation["references"]:
            self.assertLessEqual({"type", "title", "authors"}, set(paper))
            self.assertLessEqual(set(paper), PAPER_KNOWN)
        for author in sum((work["authors"] for work in (citation, *citation["references"])), []):
            self.assertTrue(set(author) <= PERSON or set(author) <= ENTITY and "name" in author, author)

    def test_templates_have_what_forges_ask_for(self):
        templates = sorted((SOURCES / ".github/ISSUE_TEMPLATE").glob("*.md"))
        self.assertGreaterEqual(len(templates), 2)
        for path in templates:
            _, head, body = path.read_text(encoding="utf-8").split("---\n", 2)
            self.assertLessEqual({"name", "about"}, set(yaml.safe_load(head)))
            self.assertTrue(body.strip())

    def test_no_contact_is_invented(self):
        """An address that nobody reads is worse than none."""
        listed = subprocess.run([SOURCES / "scripts/list-files"], capture_output=True, text=True, check=True).stdout
        # Files that may contain such addresses.
        allowed = {"scripts/check-words", "tests/package/release_test.py", "tests/qgis/package_test.py"}
        found = []
        for name in set(listed.split("\n")) - allowed - {""}:
            try:
                text = read(name)
            except UnicodeDecodeError:
                continue
            if "example." not in text:  # the search takes seconds for long lines
                continue
            found += [f"{name}: {match}" for match in re.findall(r"\S*@(?:[\w-]+\.)*example\.\w+|\S*example\.(?:org|com|net)", text)]
        self.assertEqual(sorted(found), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
