"""The options of functions as keywords, and their description."""
import difflib
import json

from . import _coastmesh
from ._errors import OptionError


FUNCTIONS = ("mesh", "cut", "remesh", "merge", "rivers")


def options(function="mesh"):
    """The options of a function, "mesh", "cut", "remesh", "merge" or "rivers": name as a keyword, and what
    `coastmesh mesh --json-usage` or that of the command of this name says of it."""
    if function not in FUNCTIONS:
        raise OptionError(f"function: {function!r} is none of {', '.join(FUNCTIONS)}")
    return {_keyword(option["name"]): option for option in json.loads(_coastmesh.usage(function))["options"]}


def vector_options(function):
    """The options of a function that name vector files, by keyword, also by their former ones: they take shapes as well."""
    return {name: option for name, option in _present_and_former(function).items() if option.get("role") == "vector"}


def _present_and_former(function):
    known = options(function)
    former = {_keyword(name): option for option in known.values() for name in list(option.get("former_names", {}))[:1]}
    return {**former, **known}


def _keyword(name):
    return name.lstrip("-").replace("-", "_")


def require_known(function, keywords):
    """Refuses what is no option, now or by its former name."""
    known = _present_and_former(function)
    for name in keywords:
        if name not in known:
            near = difflib.get_close_matches(name, options(function), 1)
            raise TypeError(f"{function}() has no option '{name}'" + (f"; did you mean '{near[0]}'?" if near else ""))


def _describe(option):
    label, said = option["label"], option["help"]
    said = label + said[len(label):] if said.lower().startswith(label.lower()) else f"{label}: {said}"
    unit = "FILE or shapes" if option.get("role") == "vector" else option.get("unit")
    default = option.get("default")
    bounds = [f"from {option['minimum']:g}" if "minimum" in option else "",
              f"above {option['exclusive_minimum']:g}" if "exclusive_minimum" in option else "",
              f"to {option['maximum']:g}" if "maximum" in option else ""]
    facts = [unit or "", *bounds, f"default {default}" if default is not None else ""]
    if "choices" in option:
        facts.insert(0, " | ".join(option["choices"]))
    facts = ", ".join(fact for fact in facts if fact)
    return f"{said} ({facts})" if facts else said


def options_text(function):
    """The options of a function for its docstring."""
    text, section = "", None
    for name, option in options(function).items():
        if option["section"] != section:
            section = option["section"]
            text += f"\n    {section}:\n"
        text += f"        {name}: {_describe(option)}\n"
    return text
