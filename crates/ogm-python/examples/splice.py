"""Puts what was measured into a document, between its marks."""

from pathlib import Path


def splice(document: Path, name: str, table: str, command: str) -> None:
    begin, end = f"<!-- BEGIN: {name} -->", f"<!-- END: {name} -->"
    before, rest = document.read_text(encoding="utf-8").split(begin)
    after = rest.split(end)[1]
    text = f"{before}{begin}\n\nWritten by `{command}`:\n\n{table}\n\n{end}{after}"
    document.write_text(text, encoding="utf-8")
