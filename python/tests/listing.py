"""What the package promises: every public name with what it takes and gives, read from the sources.

    python listing.py FILE        fails where FILE lists something else; with BLESS=1 writes it
"""

import ast
import difflib
import os
import sys
from pathlib import Path

PACKAGE = Path(__file__).parents[1] / "omni_gap"

MODULES = {
    "omni_gap": "__init__.py",
    "omni_gap.fleet": "fleet/__init__.py",
    "omni_gap.fleet.ray": "fleet/ray.py",
    "omni_gap.plot": "plot.py",
}

SHOWN = ("__init__", "__getitem__", "__len__", "__enter__", "__truediv__")
"""What is said by a sign or a statement."""


def parsed(path):
    """The statements of a module; of the compiled one, those of its stub."""
    there = path if path.exists() else path.with_suffix(".pyi")
    return ast.parse(there.read_text(encoding="utf-8")).body


def scope(path):
    """The names of a module, each with its definition and where that is; an import from the package is followed."""
    named = {}
    for node in parsed(path):
        if isinstance(node, ast.ImportFrom) and node.level and node.module:
            source = path.parents[node.level - 1] / f"{node.module.replace('.', '/')}.py"
            there = scope(source)
            named.update({alias.asname or alias.name: there[alias.name] for alias in node.names if alias.name in there})
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            named[node.name] = (node, path)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            target = node.targets[0] if isinstance(node, ast.Assign) else node.target
            named[target.id] = (node, path)
    return named


def promised(path):
    """The public names of a module: those it exports, or else those it defines."""
    named = scope(path)
    if "__all__" in named:
        return {name: named[name] for name in ast.literal_eval(named["__all__"][0].value)}
    return {name: of for name, of in sorted(named.items()) if of[1] == path and not name.startswith("_")}


def lines(prefix, node, path):
    """A name, and of a class what it has: its fields and public methods, those of its bases too."""
    if isinstance(node, ast.FunctionDef):
        kinds = [ast.unparse(decorator) for decorator in node.decorator_list]
        kind = "".join(f"@{kind} " for kind in kinds)
        gives = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        yield f"{kind}{prefix}({ast.unparse(node.args)}){gives}"
    elif isinstance(node, ast.ClassDef):
        bases = ", ".join(ast.unparse(base) for base in node.bases)
        yield f"class {prefix}({bases})"
        yield from members(prefix, node, path, set())
    elif isinstance(node, ast.AnnAssign):
        yield f"{prefix}: {ast.unparse(node.annotation)}"
    else:
        yield prefix


def members(prefix, node, path, seen):
    """What a class has, the nearest definition of each."""
    for part in node.body:
        name = getattr(part, "name", None) or getattr(getattr(part, "target", None), "id", None)
        if name and (not name.startswith("_") or name in SHOWN) and name not in seen:
            seen.add(name)
            yield from lines(f"{prefix}.{name}", part, path)
    for base in node.bases:
        inherited, where = scope(path).get(ast.unparse(base), (None, path))
        if inherited is not None:
            yield from members(prefix, inherited, where, seen)


def listing():
    """All of it, a name a line."""
    told = []
    for module, file in MODULES.items():
        for name, (node, path) in promised(PACKAGE / file).items():
            told += lines(f"{module}.{name}", node, path)
    return "".join(f"{line}\n" for line in told)


def main(file):
    now = listing()
    if os.environ.get("BLESS"):
        Path(file).write_text(now, encoding="utf-8")
    before = Path(file).read_text(encoding="utf-8")
    if now != before:
        differences = difflib.unified_diff(before.splitlines(), now.splitlines(), str(file), "now", lineterm="", n=0)
        sys.exit("\n".join(["what the package promises has changed; BLESS=1 lists it anew:", *differences]))
    print(f"{len(now.splitlines())} public names of Python are as listed.")


if __name__ == "__main__":
    main(*sys.argv[1:])
