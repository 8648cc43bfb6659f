"""The program: where it lies, and what it says of itself. Knows nothing of Processing's parameters."""
import json
import os
import shutil
import subprocess

PROGRAM_SETTING = "COASTMESH_PROGRAM"


class ProgramError(Exception):
    """The program is missing or is none; the text says what to do."""


def find_program():
    """The program's path: from the settings of Processing, the environment's COASTMESH_PROGRAM, or the PATH."""
    from processing.core.ProcessingConfig import ProcessingConfig

    chosen = ProcessingConfig.getSetting(PROGRAM_SETTING) or os.environ.get("COASTMESH_PROGRAM", "")
    found = shutil.which(chosen or "coastmesh")
    if found:
        return found
    if chosen:
        raise ProgramError(f"'{chosen}' is not a program: correct it in the settings of Processing, under coastmesh")
    raise ProgramError(
        "the program coastmesh is not on the PATH: install it, or name it in the settings of Processing, under coastmesh"
    )


def read_usage(program):
    """What `coastmesh --json-usage` says: commands with their options, and formats."""
    try:
        run = subprocess.run([program, "--json-usage"], capture_output=True, timeout=30, check=True)
        usage = json.loads(run.stdout)
        usage["commands"], usage["formats"]
        return usage
    except (OSError, subprocess.SubprocessError, ValueError, KeyError, TypeError) as error:
        raise ProgramError(f"'{program}' does not answer as coastmesh does: {error}") from error
