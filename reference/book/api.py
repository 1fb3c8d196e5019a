"""The book's page of the Python package, from its docstrings: `reference/run api`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import griffe

REFERENCE = Path(__file__).resolve().parents[1]
PAGE = REFERENCE.parent / "docs" / "src" / "guide" / "python-api.md"
HEAD = """<!-- kind: reference -->
# The Python package, name by name

For whoever has read [From Python](python.md) and looks a name up: every name that the package
promises to keep, with its arguments. `reference/run api` writes this page from the docstrings.
"""
# Modules beside `lamina` itself, and their names; a module without any has its own text.
MODULES: dict[str, list[str]] = {
    "lamina": [],
    "lamina.atmosphere": ["above_canopy", "from_uvspec", "read_atmosphere", "top_of_atmosphere"],
    "lamina.report": ["report"],
    "lamina.noise": ["relative_error", "summary"],
    "lamina.denoise": [],
    "lamina.print": [],
    "lamina.scans": [],
    "lamina.usd": [],
    "lamina.eradiate": [],
    "lamina.mitsuba": [],
    "lamina.mitsuba.variant": ["choose"],
    "lamina.mitsuba.plugins": ["register"],
}


def page() -> str:
    """The whole page."""
    package = griffe.load("lamina", search_paths=[REFERENCE], resolve_aliases=True)
    parts = [HEAD]
    for path, names in MODULES.items():
        module = package[path.removeprefix("lamina").lstrip(".")] if path != "lamina" else package
        parts.append(f"## `{path}`\n\n{text_of(module)}")
        # By its import: a function may be called like its module.
        found = {str(name): module.imports[str(name)] for name in module.exports or []}
        found |= {name: f"{path}.{name}" for name in names}
        for name, place in sorted(found.items(), key=lambda item: item[0].lower()):
            parts += entries(package[place.removeprefix("lamina.")], f"{path}.{name}")
    return "\n".join(parts)


def entries(member: griffe.Object | griffe.Alias, path: str) -> list[str]:
    """A name, and those inside of it."""
    parts = [f"### `{path}`\n\n{code(member)}{text_of(member)}"]
    if member.is_class:
        fields = [field for field in members(member) if field.is_attribute and field.annotation]
        if fields:
            heads = "| field | type | what |\n| --- | --- | --- |\n"
            parts.append(heads + "".join(row(field) for field in fields))
        for method in members(member):
            if method.is_function:
                parts += entries(method, f"{path}.{method.name}")
    return parts


def members(of: griffe.Object | griffe.Alias) -> list[griffe.Object | griffe.Alias]:
    """Names of a class that are for others."""
    return [member for member in of.members.values() if member.is_public and not member.is_special]


def code(member: griffe.Object | griffe.Alias) -> str:
    """How a name is called, or what it is; nothing for a class, which nobody has to make."""
    if member.is_function:
        line = f"def {member.signature(return_type=True)}: ..."
    elif member.is_attribute:
        line = f"{member.name} = {member.value}"
    else:
        return ""
    ruff = [sys.executable, "-m", "ruff", "format", "--stdin-filename", REFERENCE / "signature.py"]
    done = subprocess.run(ruff, input=line, capture_output=True, text=True, check=True)
    return f"```python\n{done.stdout}```\n\n"


def row(field: griffe.Object | griffe.Alias) -> str:
    """A field in a table."""
    kind = str(field.annotation).replace("|", "\\|")
    return f"| `{field.name}` | `{kind}` | {' '.join(text_of(field).split())} |\n"


def text_of(member: griffe.Object | griffe.Alias) -> str:
    """A docstring as Markdown."""
    return f"{member.docstring.value}\n" if member.docstring else ""


def main() -> None:
    """Writes the page."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
