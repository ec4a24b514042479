

# --- files of proof data ---------------------------------------------------------------------------------------------

import contextlib  # noqa: E402
import re  # noqa: E402
import signal  # noqa: E402

SCHEMA = json.loads(
    r"""
@SCHEMA@"""
)
LARGEST_FILE = 1 << 26
LARGEST_MEMORY = 1 << 32
LONGEST = 120


def named(value):
    said = json.dumps(value)
    return said if len(said) <= 40 else said[:37] + "..."


def fit(value, schema, place):
    """Refuses what has another shape than the schema says, with its place. Of the schema language it knows what SCHEMA uses."""
    if "$ref" in schema:
        return fit(value, SCHEMA["$defs"][schema["$ref"].rpartition("/")[2]], place)
    if "oneOf" in schema:
        return fit(value, chosen(value, schema["oneOf"], place), place)
    if "const" in schema or "enum" in schema:
        wanted = schema.get("enum", [schema.get("const")])
        is_one = any(type(value) is type(own) and value == own for own in wanted)
        return require(is_one, "%s: %s where %s is to be" % (place, named(value), " or ".join(map(json.dumps, wanted))))
    kinds = {"object": dict, "array": list, "string": str, "integer": int}
    kind = schema.get("type")
    require(kind is None or type(value) is kinds[kind], "%s: %s is no %s" % (place, named(value), kind))
    if kind == "integer":
        require(schema["minimum"] <= value <= schema["maximum"], "%s: %s is out of range" % (place, named(value)))
    elif kind == "string":
        require(len(value) <= schema["maxLength"], "%s: a text of %d characters" % (place, len(value)))
        if "pattern" in schema:
            require(re.fullmatch(schema["pattern"], value), "%s: %s is no such text" % (place, named(value)))
            # numbers without value
            require(not re.search("/0*$", value), "%s: %s divides by 0" % (place, named(value)))
    elif kind == "array":
        first = schema.get("prefixItems", [])
        require(len(value) >= schema.get("minItems", 0), "%s: a list of %d is too short" % (place, len(value)))
        require(len(value) <= schema.get("maxItems", len(value)), "%s: a list of %d is too long" % (place, len(value)))
        for number, part in enumerate(value):
            fit(part, first[number] if number < len(first) else schema.get("items", {}), "%s[%d]" % (place, number))
    elif kind == "object":
        own = schema.get("properties", {})
        for name in schema.get("required", []):
            require(name in value, "%s: `%s` is missing" % (place, name))
        for name, part in value.items():
            require(name in own or schema["additionalProperties"], "%s: `%s` is not known" % (place, name))
            fit(part, own.get(name, schema["additionalProperties"]), "%s.%s" % (place, name))


def chosen(value, forms, place):
    """The form that a value is to have: that of its fields, its first word, its kind of symbol, or its length."""
    for form in forms:
        while "$ref" in form:
            form = SCHEMA["$defs"][form["$ref"].rpartition("/")[2]]
        if form["type"] == "object":
            is_it = isinstance(value, dict) and ("words" in value) == ("words" in form["properties"])
        else:
            items = form.get("prefixItems", [])
            words = [(n, item["const"]) for n, item in enumerate(items) if "const" in item]
            is_list = isinstance(value, list)
            is_it = is_list and all(len(value) > n and value[n] == word for n, word in words)
            is_it = is_it and (bool(words) or bool(value) == bool(items))
        if is_it:
            return form
    raise Refused("%s: %s has none of the forms that are known here" % (place, named(value)))


def once(pairs):
    names = [name for name, _ in pairs]
    require(len(set(names)) == len(names), "a field stands twice")
    return dict(pairs)


def check_file(path):
    """Checks the claim of one file of proof data."""
    with open(path, encoding="utf-8") as file:
        text = file.read(LARGEST_FILE + 1)
    require(len(text) <= LARGEST_FILE, "the file is longer than %d characters" % LARGEST_FILE)
    data = json.loads(text, object_pairs_hook=once)
    if data == SCHEMA:
        return "the schema of these files"
    require(isinstance(data, dict) and data.get("format") == "vibro-audit-proof", "this is no proof data of vibro-audit")
    require(data.get("version") == 1, "version %s: this program checks version 1" % named(data.get("version")))
    fit(data, SCHEMA, "data")
    with limited(LONGEST):
        return check(data)


@contextlib.contextmanager
def limited(seconds):
    """Refuses what is not done in time, where the system can tell."""

    def stop(*_):
        raise Refused("it takes longer than %d s" % seconds)

    if not hasattr(signal, "setitimer"):
        yield
        return
    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def serve():
    """Reads data, a line each; a line with `steps` is a proof in place of that of the last data."""
    data = None
    for line in sys.stdin:
        asked = json.loads(line)
        if "steps" in asked:
            broken = {**data["proof"], **asked}

            def follow():
                mpmath.mp.dps = DIGITS
                check_proof(Statement(data).copy(broken), broken)
                return "the claim follows"

            print(answer(follow), flush=True)
        else:
            data = asked
            print(answer(lambda: check(data)), flush=True)


def check_files(paths):
    """Says of each file whether it is accepted; ends with 1 where one is not."""
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (LARGEST_MEMORY, LARGEST_MEMORY))
    except (ImportError, ValueError, OSError):
        print("no limit of memory here", file=sys.stderr)
    said = [(path, answer(lambda path=path: check_file(path))) for path in paths]
    for path, own in said:
        print("%s: %s" % (path, own))
    sys.exit(0 if all(own.startswith("accepted") for _, own in said) else 1)


if __name__ == "__main__":
    check_files(sys.argv[1:]) if sys.argv[1:] else serve()
