"""Runs the program and passes on to the user what it says."""
import json
import shlex

from qgis.core import QgsBlockingProcess, QgsProcessingException
from qgis.PyQt.QtCore import QProcess

# Where each phase lies on Processing's scale of 0 to 100.
PHASES = {"read": (0, 5), "refine": (5, 85), "finish": (85, 90), "write": (90, 100), "done": (100, 100)}
SHORT = 1  # exit code: done, but the result misses a requirement


class _Lines:
    """Cuts what comes in pieces into lines."""

    def __init__(self, take):
        self.take = take
        self.rest = b""

    def add(self, piece):
        *lines, self.rest = (self.rest + piece.data()).split(b"\n")
        for line in lines:
            self.take(line.decode("utf-8", "replace"))

    def finish(self):
        if self.rest:
            self.take(self.rest.decode("utf-8", "replace"))
        self.rest = b""


class _Talk:
    """What the program says, to the feedback of Processing."""

    def __init__(self, feedback, in_words):
        self.feedback = feedback
        self.in_words = in_words
        self.phase = None
        self.errors = []

    def out(self, line):
        if line.startswith('{"phase"'):
            try:
                self._progress(json.loads(line))
                return
            except (ValueError, KeyError):
                pass  # a line like any other
        self.feedback.pushInfo(self.in_words(line))

    def err(self, line):
        if not line.strip():
            return
        text = self.in_words(line)
        for prefix, report in (("coastmesh: warning: ", self.feedback.pushWarning), ("coastmesh: error: ", None)):
            if text.startswith(prefix):
                text = text[len(prefix):]
                if report is None:
                    self.errors.append(text)
                else:
                    report(text)
                return
        self.feedback.pushWarning(text[len("coastmesh: "):] if text.startswith("coastmesh: ") else text)

    def _progress(self, said):
        phase, share = said["phase"], float(said["share"])
        low, high = PHASES.get(phase, (None, None))
        if low is None:
            return
        if phase != self.phase and phase != "done":
            self.feedback.setProgressText(phase.capitalize())
        self.phase = phase
        self.feedback.setProgress(low + (high - low) * share)


def run_program(program, arguments, feedback, in_words):
    """Runs the program to its end; returns its exit code, 0 or 1, or None where the user cancelled.

    Raises QgsProcessingException with the program's own message on any other.
    """
    feedback.pushCommandInfo(in_words(shlex.join(["coastmesh", *arguments])))
    if feedback.isCanceled():
        return None
    talk = _Talk(feedback, in_words)
    out, err = _Lines(talk.out), _Lines(talk.err)
    process = QgsBlockingProcess(program, arguments)
    # QGIS holds no reference to a handler: these two names keep them alive.
    take_out, take_err = out.add, err.add
    process.setStdOutHandler(take_out)
    process.setStdErrHandler(take_err)
    code = process.run(feedback)
    out.finish()
    err.finish()
    if feedback.isCanceled() and (code != 0 or process.exitStatus() != QProcess.NormalExit):
        feedback.pushInfo("Cancelled; no file was written.")
        return None
    if process.processError() == QProcess.FailedToStart:
        raise QgsProcessingException(f"'{program}' cannot be started")
    if process.exitStatus() != QProcess.NormalExit:
        raise QgsProcessingException("coastmesh was ended from outside, perhaps for want of memory; no file was written")
    # SHORT comes with an error where nothing was meshed because the sizes require too many vertices.
    if code not in (0, SHORT) or talk.errors:
        raise QgsProcessingException("; ".join(talk.errors) or f"coastmesh ended with exit code {code}")
    return code
