"""Pages of the notebooks: their text, code and stored outputs as MyST Markdown.

`myst-nb` would show them too, but brings Jupyter's kernel, client and cache for notebooks that are
not run here: `python -m tools.notebooks` has stored what they show.
"""

import base64
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from tools import notebooks

INDEX: Final = "notebooks/index.md"
"""Page that lists the notebooks."""
FOLDER: Final = "notebooks"


def write(folder: Path) -> None:
    """Write the page of each notebook with its pictures, the files themselves, and an index.

    Args:
        folder: Folder of the pages, which is made.
    """
    folder.mkdir(parents=True, exist_ok=True)
    paths = notebooks.files()
    for path in paths:
        (folder / f"{path.stem}.md").write_text(page(path, folder))
        (folder / path.name).write_bytes(path.read_bytes())
    (folder / "index.md").write_text(index([path.stem for path in paths]))


def index(names: list[str]) -> str:
    """Return the page that lists the notebooks."""
    listed = "\n".join(names)
    return (
        "# Notebooks\n\n"
        "Each page has a file to open in Jupyter or in a hosted notebook; the first cell installs "
        "the package there. What the cells show was stored by `python -m tools.notebooks`, and "
        f"tests run every cell.\n\n```{{toctree}}\n{listed}\n```\n"
    )


def page(path: Path, pictures: Path) -> str:
    """Return a notebook as a page.

    Args:
        path: File of the notebook.
        pictures: Folder that its pictures are written into.
    """
    parts = []
    for number, cell in enumerate(notebooks.read(path)["cells"]):
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(source)
            continue
        parts.append(f"```python\n{source}\n```")
        name = f"{path.stem}-{number}.png"
        parts += (_output(output, pictures, name) for output in cell["outputs"])
        if len(parts) == 2:
            parts.append(f"Download {{download}}`{path.name}`.")
    return "\n\n".join(parts) + "\n"


def _output(output: Mapping[str, Any], folder: Path, name: str) -> str:
    """Richest stored form of what a cell has shown."""
    if output["output_type"] == "stream":
        return f"```text\n{output['text'].rstrip()}\n```"
    data = output["data"]
    if "image/png" in data:
        (folder / name).write_bytes(base64.b64decode(data["image/png"]))
        return f"![output]({name})"
    if "text/html" in data:
        return f"```{{raw}} html\n{data['text/html']}\n```"
    return f"```text\n{data['text/plain']}\n```"
