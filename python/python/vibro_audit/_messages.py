"""Messages of the command line in Python's terms: the names of arguments in place of options."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from ._arguments import OPTIONS, ROW

_ARGUMENTS = {
    **{name: name for name in OPTIONS},
    **{name: f"add[{name!r}]" for name in ROW if name not in OPTIONS},
    "add": "add",
    "columns": "command",
    "explain": "label",
    "out": "directory",
    "rests-on": "add['rests_on']",
    "without-answers": "answers=False",
}
"""What options are called in Python. Others, such as `--bless`, are those of a command that one types."""

_OF_COMMAND = {
    "audit": {"SHEET": "sheet"},
    "check": {"DIR": "directory"},
    "score": {"FILE": "answers"},
    "trade": {"TASK": "task"},
    "stress": {"CASE": "case"},
}

_NAMES = "|".join(sorted(_ARGUMENTS, key=len, reverse=True))
_OPTION = rf"--(?P<option>{_NAMES})(?![\w-])(?: <[^>\n]+>)?"
_REPEATED = re.compile(
    rf"invalid value '(?P<value>.*?)' for '(?:{_OPTION}|[\[<](?P<input>[A-Z]+)[\]>](?:\.\.\.)?)'(?:: )?", re.S
)
_POSSIBLE = re.compile(r";?\s*\[possible values: (.*?)\]", re.S)
_NEEDED = re.compile(r"; (an? (?!.* is )[^,;]*number[^;]*?)(, as in [^;]*)?$")
_RANGE = re.compile(r"-?\d+ is not in (\d+)\.\.=(\d+)")
_TOGETHER = re.compile(
    r"the argument '([^']*)' cannot be used with:?\s*(?:'([^']*)'|one or more of the other specified arguments)"
)
_PHRASES = {
    "number too large to fit in target type": "it is too large",
    "invalid digit found in string": "a whole number that is not negative is needed",
    "invalid UTF-8 was detected in one or more arguments": "the path must be UTF-8",
    ", or `-` for stdin": "",
    "; must be": "; it must be",
    "write key=value, as in --set": "write --set",
    "`check DIR --add`": "`check(DIR, add={...})`",
}
"""Parts of messages that speak of a shell."""

_QUOTED = re.compile(r"`(?:vibro-audit )?([a-z]+)((?: [^`\n]*)?)`")
_COMMANDS = (
    *("audit", "basins", "branch", "check", "map", "merge", "optimise", "orbits", "plot", "problems", "run", "scenes"),
    *("score", "simulate", "stress", "sweep", "trade", "trajectory"),
)
_SET = re.compile(r"--set '?(?P<key>[A-Za-z_][\w.]*)=(?P<value>\[[^\]]*\]|\{[^}]*\}|[^\s';,:]+)'?")


def in_python(message: str, command: str, arguments: Iterable[str] = ()) -> str:
    """Returns a message of a command in Python's terms.

    Parameters
    ----------
    message : str
        The message.
    command : str
        The name of the command.
    arguments : list of str, optional
        The arguments that were given. A message repeats overrides of keys, `--set key=value`.
    """
    own = {**_ARGUMENTS, **_OF_COMMAND.get(command, {})}

    def name(option: str) -> str:
        return own.get(option, option.lower())

    for argument in sorted(arguments, key=len, reverse=True):
        if argument.startswith("--set="):
            key, _, value = argument.removeprefix("--set=").partition("=")
            message = message.replace(f"--set {key}={value}", f"set[{key!r}] = {value}")
    message = _REPEATED.sub(lambda found: _repeated(found, name(found["option"] or found["input"])), message)
    message = _POSSIBLE.sub(r"; choose \1", message)
    message = _RANGE.sub(r"a whole number from \1 to \2 is needed", message)
    message = re.sub(r"a value is required for '([^']*)' but none was supplied", r"\1 is empty", message)
    message = _NEEDED.sub(r"; \1 is needed\2", message)
    message = _TOGETHER.sub(lambda found: f"{found[1]} and {found[2] or 'others'} exclude each other", message)
    for of_shell, of_python in _PHRASES.items():
        message = message.replace(of_shell, of_python)
    message = _QUOTED.sub(lambda found: _quoted(found, own), message)
    message = re.sub(r"--expected ([a-z-]+)", r"add['expected'] = '\1'", message)
    message = _SET.sub(lambda found: f"set={{'{found['key']}': {found['value']}}}", message)
    # in quotes stand names of tables, such as "sweep --summary"
    message = re.sub(rf'(?<![\w"-]){_OPTION}(?!")', lambda found: name(found["option"]), message)
    message = re.sub(r"(?<!\w)[\[<](TASK|CASE|FILE|DIR|SCENE|SHEET)[\]>]", lambda found: name(found[1]), message)
    # what a message repeats of an input does nothing to a terminal
    return "".join(c if c.isprintable() or c == "\n" else ascii(c)[1:-1] for c in message)


def _repeated(found: re.Match[str], name: str) -> str:
    """Returns what an argument is, before what is needed."""
    value = found["value"]
    is_number = re.fullmatch(r"[-+]?(\d[\d.e+-]*|nan|inf)", value)
    return f"{name} is {value if is_number else repr(value)}; "


def _quoted(found: re.Match[str], own: Mapping[str, str]) -> str:
    """Returns a command of a message as a call, where all its options are those of a function."""
    command, rest = found[1], found[2]
    if command not in _COMMANDS:
        return found[0]
    if "--" not in rest:
        return f"`{command}{rest}`"
    rest = re.sub(r" --format \w+", "", rest)
    words = rest.split()
    arguments = []
    while words:
        word = words.pop(0)
        option = re.fullmatch(r"--([a-z-]+)", word)
        if option is None:
            arguments.append(word if word.isupper() else repr(word))
            continue
        if option[1] not in own:
            return f"`vibro-audit {command}{found[2]}`"
        name = own[option[1]]
        has_value = words and not words[0].startswith("--")
        arguments.append(name if "=" in name else f"{name}={words.pop(0) if has_value else True}")
    return f"`{command}({', '.join(arguments)})`" if arguments else f"`{command}`"
