#!/usr/bin/python3
"""What the program shows on a terminal, in a log and in continuous integration; manual pages; completion in shells.

usage: terminal_test.py PROGRAM USAGE   (the program coastmesh, the folder of what was made from its usage)
"""
import fcntl
import json
import os
import pty
import re
import select
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import unittest

PROGRAM, USAGE = (os.path.abspath(path) for path in sys.argv[1:3])
SQUARE = {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]}


def on_a_terminal(command, columns=60, **variables):
    """What a terminal receives on stderr and stdout, and the exit code."""
    pid, terminal = pty.fork()
    if pid == 0:
        # Before the program starts: it may ask for the width at once.
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        environment = {k: v for k, v in os.environ.items() if k != "CI"}
        os.execve(command[0], command, {**environment, "TERM": "xterm", **variables})
    received = b""
    while select.select([terminal], [], [], 60)[0]:
        try:
            piece = os.read(terminal, 65536)
        except OSError:
            break
        if not piece:
            break
        received += piece
    return received.decode(), os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


def left_on_screen(text):
    """The lines that are seen in the end: after each return to the start of a line, what follows erases what was there."""
    return [re.sub(r".*\r(?:\x1b\[K)?", "", line.rstrip("\r")) for line in text.split("\n")]


class ProgressTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.input = os.path.join(self.folder, "square.geojson")
        with open(self.input, "w", encoding="utf-8") as file:
            json.dump(SQUARE, file)

    def command(self, *more):
        return [PROGRAM, "mesh", self.input, "-o", os.path.join(self.folder, "a.nc"), "--overwrite",
                "--size-max", "3000", *more]

    def test_on_a_terminal_a_bar_that_fits_and_leaves_nothing(self):
        for columns in (60, 25, 10):
            text, code = on_a_terminal(self.command(), columns)
            self.assertEqual(code, 0)
            self.assertIn("\r", text)
            shown = re.findall(r"\r((?:read|refine|write)[^\r\x1b]*)\x1b\[K", text)
            self.assertTrue(shown)
            self.assertLess(max(len(line) for line in shown), columns)
            self.assertFalse([line for line in left_on_screen(text) if "%" in line])
            self.assertTrue(any("wrote" in line for line in left_on_screen(text)))

    def test_no_bar_in_continuous_integration_nor_on_a_dumb_terminal(self):
        for variables in ({"CI": "true"}, {"TERM": "dumb"}):
            text, code = on_a_terminal(self.command(), **variables)
            self.assertEqual(code, 0)
            self.assertNotIn("\x1b", text)
            self.assertNotRegex(text, r"\r[^\n]")

    def test_into_a_file_nothing_but_whole_lines(self):
        run = subprocess.run(self.command(), capture_output=True, text=True, check=True)
        self.assertEqual(run.stderr, "")
        self.assertNotIn("\r", run.stdout)
        quiet = subprocess.run(self.command("--quiet"), capture_output=True, text=True, check=True)
        self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))

    def test_json_lines_are_whole_objects_with_shares_that_grow(self):
        run = subprocess.run(self.command("--progress", "json"), capture_output=True, text=True, check=True)
        said = [json.loads(line) for line in run.stdout.splitlines()]
        self.assertEqual(said[-1], {"phase": "done", "share": 1.0})
        for phase in ("read", "refine", "write"):
            shares = [s["share"] for s in said if s["phase"] == phase]
            self.assertEqual(shares, sorted(shares))
            self.assertEqual(shares[-1], 1.0)

    def test_alone_it_tells_what_to_type(self):
        run = subprocess.run([PROGRAM], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 2)
        self.assertIn("coastmesh mesh lake.geojson -o lake.gpkg", run.stdout)

    def test_examples_of_the_help_are_command_lines_that_parse(self):
        usage = json.loads(subprocess.run([PROGRAM, "--json-usage"], capture_output=True, check=True).stdout)
        for command in usage["commands"]:
            self.assertTrue(command.get("examples"), command["command"])
            options = {name for option in command["options"] for name in option["names"]}
            for example in command["examples"]:
                words = example["command"].split()
                self.assertEqual(words[:2], ["coastmesh", command["command"]])
                used = {word.split("=")[0] for word in words if re.match(r"--?[a-z]", word)}
                self.assertLessEqual(used, options, example["command"])


class ManualTest(unittest.TestCase):
    def test_every_option_is_in_its_page_and_pages_have_no_faults(self):
        usage = json.loads(subprocess.run([PROGRAM, "--json-usage"], capture_output=True, check=True).stdout)
        for command in usage["commands"]:
            path = os.path.join(USAGE, "man", f"coastmesh-{command['command']}.1")
            with open(path, encoding="utf-8") as file:
                page = file.read().replace("\\-", "-")
            at = 0
            for option in command["options"]:
                self.assertIn(f"\\fB{option['name']}\\fR", page)
                section = page.find(f"\n.SS {option['section']}\n")
                self.assertGreater(section, 0, option["section"])
                at = page.find("\n" + option["label"], max(at, section))
                self.assertGreater(at, 0, option["label"])
            self.assertNotRegex(page, r"repeated[^\n]*repeated")
        if not shutil.which("groff"):
            self.skipTest("there is no groff to look for faults")
        for name in os.listdir(os.path.join(USAGE, "man")):
            path = os.path.join(USAGE, "man", name)
            checked = subprocess.run(["groff", "-man", "-ww", "-Tutf8", path], capture_output=True, text=True, check=True)
            self.assertEqual(checked.stderr, "")
            self.assertIn("User Commands", checked.stdout)


class CompletionTest(unittest.TestCase):
    def bash(self, *words):
        script = f"""source {USAGE}/bash/coastmesh
COMP_WORDS=({' '.join(f"'{w}'" for w in words)}) COMP_CWORD={len(words) - 1}
_coastmesh; printf '%s\\n' "${{COMPREPLY[@]}}" """
        run = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(run.stderr, "")
        return run.stdout.split()

    def test_bash(self):
        self.assertEqual(self.bash("coastmesh", "mes"), ["mesh"])
        self.assertIn("--min-angle", self.bash("coastmesh", "mesh", "--mi"))
        self.assertEqual(self.bash("coastmesh", "mesh", "--algorithm", "re"), ["relocate"])
        self.assertEqual(self.bash("coastmesh", "mesh", "--target", "adcirc", "--target", "te"), ["telemac"])
        self.assertEqual(self.bash("coastmesh", "convert", "--format", "gmsh"), ["gmsh", "gmsh22"])
        self.assertNotIn("--min-angle", self.bash("coastmesh", "info", "--"))
        self.assertIn(USAGE, self.bash("coastmesh", "info", USAGE[:-1]))

    def test_fish(self):
        if not shutil.which("fish"):
            self.skipTest("there is no fish")

        def complete(line):
            script = f"source {USAGE}/fish/coastmesh.fish; complete -C '{line}'"
            run = subprocess.run(["fish", "--no-config", "-c", script], capture_output=True, text=True, check=True)
            self.assertEqual(run.stderr, "")
            return [row.split("\t")[0] for row in run.stdout.splitlines()]

        self.assertEqual(complete("coastmesh mes"), ["mesh"])
        self.assertIn("--min-angle", complete("coastmesh mesh --mi"))
        self.assertIn("relocate", complete("coastmesh mesh --algorithm re"))
        self.assertEqual(complete("coastmesh mesh --target adcirc --target te"), ["telemac"])
        self.assertEqual(complete("coastmesh convert --format gmsh"), ["gmsh", "gmsh22"])
        self.assertNotIn("--min-angle", complete("coastmesh info --"))

    def test_zsh(self):
        if not shutil.which("zsh"):
            self.skipTest("there is no zsh")
        # Requests completion at the prompt of an interactive shell.
        script = f"""zmodload zsh/zpty
zpty shell 'zsh -f -i'
zpty -w shell "PS1='READY> '; fpath=({USAGE}/zsh $fpath); autoload -Uz compinit; compinit -u -D; print LOADED"
zpty -r -m shell line '*LOADED*READY> '
zpty -w -n shell $'coastmesh mesh --algorithm rel\\t; print \\n'
zpty -r -m shell line '*relocate*'; print -r -- "$line"
"""
        run = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, timeout=60, check=False)
        self.assertIn("relocate", run.stdout, run.stderr)
        with open(os.path.join(USAGE, "zsh", "_coastmesh"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn(":value:(adcirc schism ", text)
        self.assertRegex(text, r"--format\[[^\]]*\]:value:\([a-z0-9_ ]*gmsh22[ )]")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
